"""The panel of the document's parameters, a customizer. Imports Qt; no VTK."""
