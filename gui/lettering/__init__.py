"""Fonts in a window of their own: glyphs in a grid, their control points, running text, fonts side by side."""
