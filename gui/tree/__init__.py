"""The model as rows and as a diagram: model tree, drag and drop, search. Imports Qt; no VTK."""
