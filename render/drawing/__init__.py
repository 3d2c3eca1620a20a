"""Drawings in two dimensions, written as SVG and DXF. Imports `model`, neither VTK nor Qt."""
