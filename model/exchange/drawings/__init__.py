"""Outlines in SVG and DXF files as shapes of commands that keep their curves, in millimetres."""
