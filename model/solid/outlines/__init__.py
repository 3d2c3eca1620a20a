"""Solids that outlines make, and the areas that outlines enclose."""
