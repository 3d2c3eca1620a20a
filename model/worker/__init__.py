"""The worker process, and the lane that feeds it. Imports from ..document, ..solid and ..exchange."""
