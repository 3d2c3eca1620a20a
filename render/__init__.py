"""Model values as pictures. Imports `model` and VTK, neither Qt nor `gui`."""
