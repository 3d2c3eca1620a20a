"""Nodes, placement, tree surgery, parameters, history, session, project files. Imports nothing but `model`."""
