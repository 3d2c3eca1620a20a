"""The tool that edits an outline in the picture: what is caught, dragged, and typed."""
