"""Paths as areas: offsets, strokes, booleans. Imports manifold3d."""
