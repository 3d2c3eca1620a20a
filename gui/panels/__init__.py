"""The docks of the window: tree, properties, parameters, problems, script. Imports Qt; no VTK."""
