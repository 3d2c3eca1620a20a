"""Elements of a mesh in the picture: vertices, edges and faces marked and picked, an edge with its wings. No Qt."""
