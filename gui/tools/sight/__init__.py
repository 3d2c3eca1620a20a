"""Lines of sight, gap and wall of a face, what is seen from here and from a point. May import ..render and ..model."""
