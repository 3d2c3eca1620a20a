"""Outline nodes as paths, and paths as outline nodes. Imports document, path, spline and curve."""
