"""The docks of the window: properties, parameters, problems, script. Imports Qt; no VTK."""
