"""What can be measured on solids and their meshes, and plane sections. Imports nothing but `model`."""
