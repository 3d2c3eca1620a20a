"""Drawings put on paper: pages with views, dimensions and a title, and their files. Imports from ..drawing, ..solid."""
