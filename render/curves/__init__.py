"""Curves in the picture: outlines, their nodes and handles, combs and constructions. Imports VTK, no Qt."""
