"""Bezier curves as arrays of control points. NumPy; of the model `document.errors` alone."""
