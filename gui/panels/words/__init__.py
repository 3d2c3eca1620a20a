"""The rows of forms for what is written or chosen in words, those of lettering among them. Imports Qt; no VTK."""
