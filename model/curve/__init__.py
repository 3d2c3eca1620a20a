"""Curves as arrays: Bezier, B-spline, paths. NumPy alone; may import nothing of the model but `document.errors`."""
