"""The Faults panel: what is wrong with meshes and drawings, where, and what mends it."""
