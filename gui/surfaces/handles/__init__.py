"""Handles in the picture: lights moved and turned, textures placed."""
