"""Faults of meshes and of drawings within a tolerance, each with its place, and repairs that say what they changed.

May import `document.errors`, nothing else of the model.
"""
