"""The way of a vertex to the screen, in NumPy: model, view and projection, clipping, division, viewport."""
