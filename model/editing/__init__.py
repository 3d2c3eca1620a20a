"""The session that changes a document, the commands that do it, and the lines of Python they echo."""
