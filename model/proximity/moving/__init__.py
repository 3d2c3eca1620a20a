"""Solids on their way: poses, first contacts, and motions of a document step by step."""
