"""The B-spline page of the Curve panel: knots, weights, degree."""
