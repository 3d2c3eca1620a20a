"""Icons, styles and examples, read with `importlib.resources`. Imports nothing."""
