"""What a document holds and what can be done to it. Imports neither Qt nor VTK, neither `render` nor `gui`."""
