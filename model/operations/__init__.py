"""What can be done to a document: plain functions, document in, document out. Imports nothing but `model`."""
