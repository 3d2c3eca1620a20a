"""The BSP tree (Fuchs, Kedem and Naylor 1980): hidden surfaces, rays, lines of sight. NumPy, and one optional C++ file.

May import `solid.display` for types and `document.errors`, nothing else of the model.
"""
