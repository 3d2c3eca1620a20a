"""Small display meshes that the tests of `render` know by formula."""

import itertools

import manifold3d
import numpy as np

from solidtree.model.solid.display import DisplayMesh, display_mesh

FACES = ((-1, 0), (1, 0), (-1, 1), (1, 1), (-1, 2), (1, 2))  # sign and axis


def box(lower=(0, 0, 0), upper=(10, 10, 10), root="box") -> DisplayMesh:
    """A box of 12 triangles, two owners: ("root", "a") for the faces across x, ("root", "b") for the others."""
    bounds = np.array([lower, upper], float)
    points, normals, triangles, facet = [], [], [], []
    for number, (sign, axis) in enumerate(FACES):
        u, v = (axis + 1) % 3, (axis + 2) % 3
        for a, b in ((0, 0), (1, 0), (1, 1), (0, 1)):
            corner = np.empty(3)
            corner[axis], corner[u], corner[v] = bounds[(sign + 1) // 2, axis], bounds[a, u], bounds[b, v]
            points.append(corner)
            normals.append(sign * np.eye(3)[axis])
        quad = np.arange(4 * number, 4 * number + 4)[:: 1 if sign > 0 else -1]
        triangles += [quad[[0, 1, 2]], quad[[0, 2, 3]]]
        facet += [number, number]
    corners = np.array(list(itertools.product(*bounds.T)))
    sides = [(i, j) for i in range(8) for j in range(i) if (corners[i] != corners[j]).sum() == 1]
    places = np.array(points)[np.array(triangles)]
    touching = [[t for t in range(12) if {*map(tuple, corners[[i, j]])} <= {*map(tuple, places[t])}] for i, j in sides]
    return DisplayMesh(
        points=np.array(points, np.float32),
        normals=np.array(normals, np.float32),
        triangles=np.array(triangles, np.int32),
        owner=np.array([0] * 4 + [1] * 8, np.int32),
        owners=((root, "a"), (root, "b")),
        subtracted=np.zeros(12, bool),
        facet=np.array(facet, np.int32),
        edge_points=corners.astype(np.float32),
        edges=np.array(sides, np.int32),
        edge_sides=np.array(touching, np.int32),
        bounds=bounds,
        vertices=np.array(points),
        corners=np.array(triangles, np.int32),
        convex=np.zeros(2, bool),
    )


def drilled(segments=64, size=20.0, root="part") -> DisplayMesh:
    """A cube about the origin less a cylinder along z: owners (root, "cube") and the subtracted (root, "drill")."""
    cube = manifold3d.Manifold.cube([size] * 3, True)
    drill = manifold3d.Manifold.cylinder(2 * size, 0.3 * size, 0.3 * size, segments, True)
    mesh = (cube - drill).to_mesh64()
    owner = np.array([0 if original == cube.original_id() else 1 for original in mesh.run_original_id], np.int32)
    return display_mesh(mesh, owner, ((root, "cube"), (root, "drill")))


def ball(segments=96, radius=10.0, root="ball") -> DisplayMesh:
    sphere = manifold3d.Manifold.sphere(radius, segments)
    return display_mesh(sphere.to_mesh64(), np.zeros(1, np.int32), ((root,),))
