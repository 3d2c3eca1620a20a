"""What can be done to a document, and the session that does it. Imports from ..document."""
