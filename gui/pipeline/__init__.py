"""The Pipeline panel: a vertex on its way to its pixel, the frustum, the matrices, and counts at each stage."""
