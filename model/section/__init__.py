"""Plane sections of meshes and solids: outlines, areas, hatching. Imports nothing but `model`."""
