"""Drawings: solids projected with hidden faces and lines removed, as pages of paths and text. Neither Qt nor VTK."""
