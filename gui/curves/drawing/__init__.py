"""Tools that draw outlines on a work plane, and what they snap to."""
