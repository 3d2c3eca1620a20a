"""What a document is made of: nodes, placement, expressions, trees, tables. Imports nothing but `model`."""
