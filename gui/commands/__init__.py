"""The window's tables of commands, and the actions, menus and tool bar made from them. Imports Qt; no VTK."""
