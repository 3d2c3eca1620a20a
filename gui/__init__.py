"""The two faces of the program: the window and the command line. May import all packages.

Only here is PySide6 allowed, and only in the modules of the window: importing `solidtree.gui` loads no Qt.
"""
