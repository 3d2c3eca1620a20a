"""B-splines: knots, degree, fitting, conversion to Bezier curves and back. May import `curve`."""
