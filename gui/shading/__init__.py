"""Windows that show how light and bitmaps meet surfaces: the light of one point, and the unwrapped triangles."""
