"""Faces for the tests of the BSP tree: solids made by script, meshes without provenance, polygons made by hand."""

import dataclasses

import numpy as np

from solidtree.model.document.tree import numbered
from solidtree.model.partition.faces import Faces, faces_of_meshes, faces_of_polygons
from solidtree.model.script import box, cylinder, halfspace, sphere, torus, union
from solidtree.model.solid.display import DisplayMesh
from solidtree.model.solid.evaluate import Evaluator
from solidtree.model.solid.results import display_of, result_of


def mesh_of(node) -> DisplayMesh:
    (root,) = numbered([node])
    evaluator = Evaluator()
    return display_of(result_of(root, evaluator.evaluate(root)), evaluator)


def faces_of(*nodes) -> Faces:
    return faces_of_meshes([mesh_of(node) for node in nodes])


def part(segments=24):
    """A rounded cube with two drillings through each other."""
    drill = cylinder(2, 20, segments=segments, centred=True)
    return (box(8, centred=True) & sphere(5.5, segments=segments)) - drill - drill.turned(x=90)


def dumbbell(segments=24):
    balls = sphere(10, segments=segments).at(-20), sphere(10, segments=segments).at(20)
    bar = cylinder(4, 40, segments=segments).turned(y=90).at(-20)
    return (union(*balls) + bar) & halfspace(normal=(0, 0, 1), point=(0, 0, -7))


def plate(holes=4, segments=16):
    drills = [
        cylinder(3, 10, segments=segments).at(10 * i + 5, 10 * j + 5, -2) for i in range(holes) for j in range(holes)
    ]
    return box(10 * holes, 10 * holes, 5) - union(*drills)


def sponge(depth=2):
    """Menger's."""
    cuts = []
    for level in range(1, depth + 1):
        w = 27 / 3**level
        for i in range(3 ** (level - 1)):
            for j in range(3 ** (level - 1)):
                a, b = (3 * i + 1) * w, (3 * j + 1) * w
                cuts += [box(w, w, 29).at(a, b, -1), box(w, 29, w).at(a, -1, b), box(29, w, w).at(-1, a, b)]
    return box(27) - union(*cuts)


def crossing(count=6, segments=16, reach=9.0):
    """Parts that go through one another, each a solid of its own."""
    rng = np.random.default_rng(count)
    shape = part(segments)
    return [shape.turned(*rng.uniform(0, 360, 3)).at(*rng.uniform(-reach, reach, 3)) for _ in range(count)]


def loose(faces: Faces) -> Faces:
    """The same without provenance, as an import has it."""
    return dataclasses.replace(faces, group=np.full(faces.count, -1, np.int32), side=np.zeros(faces.count, np.int8))


def moved(faces: Faces, shift=(0.0, 0.0, 0.0), scale=(1.0, 1.0, 1.0)) -> Faces:
    """Scaled along the axes (a normal goes by the inverse), then shifted."""
    normals = faces.planes[:, :3] / np.array(scale)
    lengths = np.linalg.norm(normals, axis=1)
    normals /= lengths[:, None]
    planes = np.column_stack((normals, faces.planes[:, 3] / lengths + normals @ np.array(shift)))
    return dataclasses.replace(faces, points=faces.points * np.array(scale) + np.array(shift), planes=planes)


def bars() -> Faces:
    """Four bars of which each lies on the next, all around: no order without a cut."""
    flat = np.array([[-6.0, 1, 0], [6, 1, 1], [6, 3, 1], [-6, 3, 0]])
    turns = [np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]]) for c, s in ((1, 0), (0, 1), (-1, 0), (0, -1))]
    return faces_of_polygons([flat @ turn.T for turn in turns])


def soup(count=40, size=1.5, seed=3) -> Faces:
    """Triangles that cross wherever they like."""
    rng = np.random.default_rng(seed)
    return faces_of_polygons(list(rng.uniform(-2, 2, (count, 1, 3)) + size * rng.normal(size=(count, 3, 3))))


def disc(corners: int, radius=1.0, height=0.0) -> np.ndarray:
    angles = 2 * np.pi * np.arange(corners) / corners
    return np.column_stack((radius * np.cos(angles), radius * np.sin(angles), np.full(corners, height)))


def open_sheets() -> Faces:
    """A tube without ends inside a bowl without a lid: both show their insides."""
    tube, bowl = faces_of(cylinder(3, 10, segments=20)), faces_of(sphere(6, segments=20))
    kept = []
    for faces in (tube, bowl):
        normals = faces.planes[faces.plane_of, 2]
        middles = faces.points[faces.corners.reshape(-1, 3)].mean(axis=1)[:, 2]
        kept.append(faces.points[faces.corners.reshape(-1, 3)[(np.abs(normals) < 0.99) & (middles < 9)]])
    return faces_of_polygons(list(np.concatenate((kept[0], kept[1][kept[1][:, :, 2].mean(axis=1) < 2]))))


SCENES = {
    "a CSG part": lambda: faces_of(part()),
    "a dumbbell": lambda: faces_of(dumbbell()),
    "a plate with holes": lambda: faces_of(plate()),
    "crossing parts": lambda: faces_of(*crossing(4)),
    "crossing spheres": lambda: faces_of(*(sphere(5, segments=16).at(x, x / 2, 0) for x in (0, 3, 6))),
    "touching cubes": lambda: faces_of(*(box(2).at(2 * i, 2 * j, 2 * k) for i, j, k in np.ndindex(3, 3, 2))),
    "identical cubes": lambda: faces_of(*[box(4)] * 4),
    "coincident caps": lambda: faces_of(
        *(cylinder(r, 5, segments=16).at(0, 0, z) for r, z in ((3, 0), (2, 5), (3, 5)))
    ),
    "cyclic bars": bars,
    "open sheets": open_sheets,
    "a soup": soup,
    "a torus": lambda: faces_of(torus(10, 3, segments=24)),
    "a part without provenance": lambda: loose(faces_of(part())),
    "a dumbbell without provenance": lambda: loose(faces_of(dumbbell(16))),
    "far away": lambda: moved(faces_of(part()), shift=(1e5, -1e5, 3e4)),
    "flattened": lambda: moved(faces_of(part()), scale=(1, 1, 1e-4)),
    "drawn out": lambda: moved(faces_of(part()), scale=(1, 1, 1e4)),
}
