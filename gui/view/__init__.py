"""The picture in the window: viewport, navigation, what the pointer is on. May import ..render and ..model."""
