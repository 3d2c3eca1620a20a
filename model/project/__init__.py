"""Project files and the assets they carry. Imports from ..document."""
