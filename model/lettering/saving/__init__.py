"""Changed fonts written as TrueType, OpenType and Type 1 files. Imports nothing but `model` and fontTools."""
