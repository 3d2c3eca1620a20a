"""The Mesh panel: the lists and the winged edge of a solid, its elements chosen in tables and in the picture."""
