"""Parts of the command line with options of their own. Imports no Qt."""
