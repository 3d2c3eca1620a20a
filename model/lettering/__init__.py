"""Fonts, shaping, layout: text as outlines that keep their curves. Imports nothing but `model`."""
