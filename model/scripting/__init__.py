"""What scripts write, in parts; ..script is all of it. Imports nothing but `model`."""
