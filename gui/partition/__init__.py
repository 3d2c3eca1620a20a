"""The BSP panel: the tree, its planes, the painter's order step by step."""
