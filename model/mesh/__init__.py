"""Vertex, normal and face lists, and their repair. Imports nothing but `model`."""
