"""What a picture shows, ray by ray in NumPy: triangles that rays meet first, and the light that comes from there."""

import numpy as np

from solidtree.model.surface.intensity import Eye, terms
from solidtree.render.camera import frame, ray


def rays(camera, size):
    """Origins and directions (n, 3) through the middles of all pixels, row by row."""
    found = [ray(camera, x + 0.5, y + 0.5, size) for y in range(size[1]) for x in range(size[0])]
    return np.array([origin for origin, _ in found]), np.array([direction for _, direction in found])


def first_hits(mesh, camera, size):
    """(n,) the triangle that each pixel's ray meets first, -1 for none; (n, 3) where on it; (n,) whether no other
    triangle is seen in the eight pixels around it."""
    origins, directions = rays(camera, size)
    corners = mesh.points[mesh.triangles].astype(float)
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    nearest = np.full(len(origins), np.inf)
    triangle = np.full(len(origins), -1)
    shares = np.zeros((len(origins), 3))
    for i in range(len(corners)):  # Möller and Trumbore 1997
        edge, other = b[i] - a[i], c[i] - a[i]
        p = np.cross(directions, other)
        det = p @ edge
        with np.errstate(divide="ignore", invalid="ignore"):
            t = origins - a[i]
            u = np.einsum("ij,ij->i", t, p) / det
            q = np.cross(t, edge)
            v = np.einsum("ij,ij->i", directions, q) / det
            distance = (q @ other) / det
            hit = (u >= 0) & (v >= 0) & (u + v <= 1) & (distance > 1e-9) & (distance < nearest)
        nearest[hit], triangle[hit] = distance[hit], i
        shares[hit] = np.column_stack((1 - u - v, u, v))[hit]
    grid = np.pad(triangle.reshape(size[1], size[0]), 1, mode="edge")
    alone = np.ones((size[1], size[0]), bool)
    for dy in (0, 1, 2):
        for dx in (0, 1, 2):
            alone &= grid[dy : dy + size[1], dx : dx + size[0]] == grid[1:-1, 1:-1]
    return triangle, shares, alone.reshape(-1)


def lit(mesh, camera, size, material, colour, lights, shading):
    """(height, width, 3) grey levels from 0 to 255 by the intensity equation, and (height, width) where they count:
    away from the borders of triangles."""
    triangle, shares, alone = first_hits(mesh, camera, size)
    axes = frame(camera)
    eye = Eye(np.array(camera.position, float), axes, camera.parallel)
    seen = np.flatnonzero((triangle >= 0) & alone)
    corners, normals = mesh.points[mesh.triangles].astype(float), mesh.normals[mesh.triangles].astype(float)
    at, weight = triangle[seen], shares[seen]
    place = np.einsum("ij,ijk->ik", weight, corners[at])
    if shading == "phong":
        normal = np.einsum("ij,ijk->ik", weight, normals[at])
        value = terms(place, normal, eye, material, colour, lights).clamped
    elif shading == "flat":
        normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])[at]
        value = terms(place, normal, eye, material, colour, lights).clamped
    else:
        shines = shading == "gouraud"
        vertices = terms(corners.reshape(-1, 3), normals.reshape(-1, 3), eye, material, colour, lights, specular=shines)
        value = np.clip(np.einsum("ij,ijk->ik", weight, vertices.sum.reshape(-1, 3, 3)[at]), 0.0, 1.0)
    picture = np.zeros((size[1] * size[0], 3))
    picture[seen] = 255.0 * value
    counts = np.zeros(size[1] * size[0], bool)
    counts[seen] = True
    return picture.reshape(size[1], size[0], 3), counts.reshape(size[1], size[0])
