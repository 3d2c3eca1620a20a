"""File formats in and out, one file a format. Imports nothing but `model`."""
