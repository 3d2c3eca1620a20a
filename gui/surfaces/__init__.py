"""Materials, how bitmaps lie, and lights: their panel, their rows in the properties, their handles in the picture."""
