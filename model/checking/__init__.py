"""What is wrong with the things of a document. Imports from ..document, ..solid, ..mesh and ..operations."""
