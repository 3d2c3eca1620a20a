"""Operands that a result does not show, drawn faintly through it. VTK, no Qt."""
