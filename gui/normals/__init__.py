"""Normals in the window: shown as needles, and the angle at which faces stop to look smooth."""
