"""Bitmaps: header, depths, pitch and key, files in and out, tiled arrays, heights to normals. Imports NumPy, Pillow."""
