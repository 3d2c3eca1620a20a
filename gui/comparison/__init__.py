"""The window that shows one model under several shadings side by side."""
