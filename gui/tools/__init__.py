"""What the pointer does to the model in the viewport: handles, measuring, sections. May import ..render and ..model."""
