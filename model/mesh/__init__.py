"""Meshes as data structures: lists of vertices, normals and faces, edges, and the winged edge with its walks."""
