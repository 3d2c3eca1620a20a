"""Curves in the window: the outline being edited, the tools that draw and edit it, and the panel beside them."""
