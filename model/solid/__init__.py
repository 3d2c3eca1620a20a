"""A node as a manifold3d solid: one small function a kind, memo, measures. Imports nothing but `model`."""
