"""Faces drawn from back to front in the order of a BSP tree, without a depth test. VTK, no Qt."""
