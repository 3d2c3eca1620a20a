"""Finding commands, and the keys that run them: palette, shortcuts, the sheet of keys. Imports Qt; no VTK."""
