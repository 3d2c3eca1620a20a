"""Handles to drag in a picture: their shapes, what a drag of them means, and what they snap to. VTK, no Qt."""
