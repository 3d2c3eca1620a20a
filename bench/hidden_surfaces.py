"""The BSP tree side by side with others, in one run on the same meshes: gl2ps, manifold3d, vtkDepthSortPolyData.

Every time is the least of some rounds taken turn by turn. The status is 1 when a bound is missed.
"""

from __future__ import annotations

import ctypes
import gc
import os
import sys
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
import vtkmodules
import vtkmodules.vtkRenderingOpenGL2  # gl2ps refers to it
from manifold3d import Manifold, OpType
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkFiltersHybrid import vtkDepthSortPolyData
from vtkmodules.vtkRenderingCore import vtkCamera

from solidtree.model.document.nodes import Node
from solidtree.model.document.tree import numbered
from solidtree.model.partition import native
from solidtree.model.partition.build import build
from solidtree.model.partition.faces import Faces, faces_of_meshes
from solidtree.model.partition.insertion import Moving
from solidtree.model.partition.order import Sorter
from solidtree.model.script import box, cylinder, sphere, union
from solidtree.model.solid.display import DisplayMesh
from solidtree.model.solid.evaluate import Evaluator
from solidtree.model.solid.results import display_of, result_of

EYES = 300 * np.array([[1.7, -2.3, 1.3], [-1, 0.7, 2.7], [0.1, 3, -0.2], [2, 0.1, -1], [-2, -2, 0.5], [0.2, -1, 2]])
HAS_NATIVE = native.available()
missed: list[str] = []


def row(what: str, mine: float, other: float, bound: float) -> None:
    """A line of the table; seconds, and how many times faster than the other one it has to be."""
    ratio = other / mine
    if ratio < bound:
        missed.append(what)
    print(
        f"{what:58} {1e3 * mine:9.2f} ms {1e3 * other:9.2f} ms {ratio:8.1f} x  at least {bound:5.1f} x"
        f"{'' if ratio >= bound else '   MISSED'}",
        flush=True,
    )


def bounded(what: str, seen: float, most: float) -> None:
    if seen > most:
        missed.append(what)
    print(f"{what:58} {seen:9.3f}   at most {most:g}{'' if seen <= most else '   MISSED'}", flush=True)


def seconds(function: Callable[[], object]) -> float:
    gc.collect()
    start = time.perf_counter()
    function()
    return time.perf_counter() - start


def least(rounds: int, *functions: Callable[[], object]) -> list[float]:
    """The least time of each, taken turn by turn, so that a noisy machine troubles all alike."""
    return np.min([[seconds(function) for function in functions] for _ in range(rounds)], axis=0).tolist()


def mesh_of(node: Node) -> DisplayMesh:
    (root,) = numbered([node])
    evaluator = Evaluator()
    mesh = display_of(result_of(root, evaluator.evaluate(root)), evaluator)
    assert mesh is not None
    return mesh


def dumbbell(segments: int) -> Node:
    ends = sphere(10, segments=segments).at(-20) + sphere(10, segments=segments).at(20)
    return ends + cylinder(radius=4, height=40, segments=segments // 2).turned(y=90).at(-20)


def plate(holes: int = 20, segments: int = 64) -> Node:
    drills = [
        cylinder(3, 7, segments=segments).at(5 + 10 * i, 5 + 10 * j, -1) for i in range(holes) for j in range(holes)
    ]
    return box(10 * holes, 10 * holes, 5) - union(*drills)


def bare_plate(holes: int = 20, segments: int = 64) -> Manifold:
    drill = Manifold.cylinder(7, 3, 3, segments)
    drills = [drill.translate((5 + 10 * i, 5 + 10 * j, -1)) for i in range(holes) for j in range(holes)]
    solid = Manifold.batch_boolean([Manifold.cube((10 * holes, 10 * holes, 5)), *drills], OpType.Subtract)
    solid.to_mesh64()
    return solid


def crossing_parts(count: int = 20) -> list[DisplayMesh]:
    """Parts of 1,768 triangles, box, ball and hole, of which seventeen of twenty go through another."""
    rng = np.random.default_rng(6)
    part = box(4, 4, 4, centred=True) + sphere(2.6, segments=48) - cylinder(1, 8, segments=64).at(0, 0, -4)
    places = rng.uniform(-10, 10, (count, 3)).tolist()
    turns = rng.uniform(0, 360, (count, 3)).tolist()
    return [mesh_of(part.turned(*turn).at(*place)) for turn, place in zip(turns, places, strict=True)]


# gl2ps, as it comes with VTK


class _Vertex(ctypes.Structure):
    _fields_ = (("xyz", ctypes.c_float * 3), ("rgba", ctypes.c_float * 4))


def gl2ps_sorter(mesh: DisplayMesh) -> Callable[[], float] | None:
    """Sorts a mesh by gl2ps's BSP tree and tells how long; what it writes goes nowhere. None where it is not there."""
    found = sorted(Path(vtkmodules.__path__[0]).glob("libvtkgl2ps*.so*"))
    if not found or not Path("/dev/null").exists():
        return None
    gl2ps, libc = ctypes.CDLL(str(found[0])), ctypes.CDLL(None)
    begin, end = gl2ps.vtkgl2ps_gl2psBeginPage, gl2ps.vtkgl2ps_gl2psEndPage
    add = gl2ps.vtkgl2ps_gl2psAddPolyPrimitive
    begin.argtypes = (
        *[ctypes.c_char_p] * 2, ctypes.POINTER(ctypes.c_int32), *[ctypes.c_int32] * 5, ctypes.c_void_p,
        *[ctypes.c_int32] * 4, ctypes.c_void_p, ctypes.c_char_p,
    )  # fmt: skip
    add.restype = None
    add.argtypes = (
        ctypes.c_int16, ctypes.c_int16, ctypes.c_void_p, ctypes.c_int32, ctypes.c_float, ctypes.c_float,
        ctypes.c_uint16, ctypes.c_int32, ctypes.c_float, ctypes.c_int32, ctypes.c_int32, ctypes.c_char,
    )  # fmt: skip
    libc.fopen.restype, libc.fclose.argtypes = ctypes.c_void_p, (ctypes.c_void_p,)

    low, high = mesh.bounds
    scaled = (mesh.vertices - low) * (1000 / float((high - low).max()))  # its depths go to 1,000, as its pixels do
    vertices = np.ones((len(mesh.corners), 3, 7), np.float32)
    vertices[:, :, :3] = scaled[mesh.corners]
    assert vertices.strides[1] == ctypes.sizeof(_Vertex)
    silent, no_blending, no_context = 1 << 2, 1 << 11, 1 << 13
    triangle, svg, bsp_sort, rgba = 5, 4, 3, 0x1908

    def sort() -> float:
        stream = libc.fopen(b"/dev/null", b"w")
        viewport = (ctypes.c_int32 * 4)(0, 0, 1000, 1000)
        options = silent | no_blending | no_context
        begin(b"", b"", viewport, svg, bsp_sort, options, rgba, 0, None, 0, 0, 0, 0, stream, b"")
        for number in range(len(vertices)):
            address = vertices.ctypes.data + number * vertices.strides[0]
            add(triangle, 3, address, 0, 0.0, 0.0, 0, 0, 1.0, 0, 0, b"\0")
        took = seconds(end)
        libc.fclose(stream)
        return took

    return sort


# vtkDepthSortPolyData


def depth_sorter(meshes: list[DisplayMesh]) -> Callable[[], object]:
    """Sorts the triangles of meshes by their distance from all of the eyes, one after the other."""
    points, triangles, count = [], [], 0
    for mesh in meshes:
        points.append(mesh.points)
        triangles.append(mesh.triangles.astype(np.int64) + count)
        count += len(mesh.points)
    data, cells, place = vtkPolyData(), vtkCellArray(), vtkPoints()
    place.SetData(numpy_to_vtk(np.concatenate(points), deep=True))
    joined = np.concatenate(triangles)
    starts = np.arange(0, joined.size + 1, 3, dtype=np.int64)
    cells.SetData(numpy_to_vtkIdTypeArray(starts, deep=True), numpy_to_vtkIdTypeArray(joined.ravel(), deep=True))
    data.SetPoints(place)
    data.SetPolys(cells)
    camera, sorter = vtkCamera(), vtkDepthSortPolyData()
    sorter.SetInputData(data)
    sorter.SetCamera(camera)
    sorter.SetDirectionToBackToFront()

    def sort() -> None:
        for eye in EYES:
            camera.SetPosition(eye)
            sorter.Modified()
            sorter.Update()

    return sort


def builds(name: str, mesh: DisplayMesh, rounds: int = 5) -> tuple[Faces, float, float | None, float]:
    """The faces, and the least seconds of the preparation, the compiled build and NumPy's; prints a line of its own."""
    faces = faces_of_meshes([mesh])
    work = [lambda: faces_of_meshes([mesh]), lambda: build(faces, compiled=False)]
    if HAS_NATIVE:
        work.append(lambda: native.build(faces))
    preparation, by_numpy, *compiled = least(rounds, *work)
    tree = build(faces)
    print(
        f"{name:24} {faces.count:7,} faces  preparation {1e3 * preparation:7.2f} ms  "
        f"compiled {1e3 * compiled[0] if compiled else np.nan:7.2f} ms  NumPy {1e3 * by_numpy:7.2f} ms  "
        f"fragments per face {tree.fragments / faces.count:.3f}  nodes {tree.nodes:,}  depth {tree.depth}",
        flush=True,
    )
    return faces, preparation, compiled[0] if compiled else None, by_numpy


def fragments_per_face(name: str, faces: Faces, most: float) -> None:
    for kind in (True, False) if HAS_NATIVE else (False,):
        tree = build(faces, compiled=kind)
        bounded(f"fragments per face, {name}, {'compiled' if kind else 'NumPy'}", tree.fragments / faces.count, most)


def orders(name: str, meshes: list[DisplayMesh], compiled: float, by_numpy: float) -> None:
    """The order for some eyes in a row, as in an orbit, against vtkDepthSortPolyData."""
    tree = build(faces_of_meshes(meshes))
    other = depth_sorter(meshes)
    for kind, bound in ((True, compiled), (False, by_numpy)):
        if kind and not HAS_NATIVE:
            continue
        sorter = Sorter(tree, compiled=kind)
        ours, theirs = least(15, lambda s=sorter: [s.triangles(eye) for eye in EYES], other)
        row(f"order, {name}, {'compiled' if kind else 'NumPy'}", ours / len(EYES), theirs / len(EYES), bound)


def main() -> int:
    print(f"{native.describe()}, {os.cpu_count()} cores\n")
    small = mesh_of(dumbbell(96))
    faces, preparation, compiled, by_numpy = builds("dumbbell", small)
    fragments_per_face("dumbbell", faces, 1.25)
    gl2ps = gl2ps_sorter(small)
    if gl2ps is None:
        print("gl2ps is not in this VTK: skipped")
    else:
        took = gl2ps()
        if compiled is not None:
            row("dumbbell with preparation, compiled, against gl2ps", preparation + compiled, took, 200)
        row("dumbbell with preparation, NumPy, against gl2ps", preparation + by_numpy, took, 40)

    print()
    large = mesh_of(plate())
    faces, preparation, compiled, _ = builds("plate of 20 x 20 holes", large)
    (manifold,) = least(3, bare_plate)
    if compiled is not None:
        row("plate with preparation, compiled, against manifold3d", preparation + compiled, manifold, 1)
    fragments_per_face("plate", faces, 1.25)
    orders("plate", [large], 20, 5)

    print()
    ball = mesh_of(sphere(10, segments=448))
    faces, *_ = builds("sphere", ball, 3)
    bounded("depth of the sphere's tree", build(faces).depth, 1)

    print()
    part = box(4, 4, 4, centred=True) + sphere(2.6, segments=32) - cylinder(1, 8, segments=32).at(0, 0, -4)
    little, *_ = builds("one part", mesh_of(part))
    fragments_per_face("one part below 5,000 triangles", little, 1.5)

    print()
    parts = crossing_parts()
    crossing = faces_of_meshes(parts)
    print(f"twenty crossing parts: {crossing.count:,} faces")
    fragments_per_face("crossing parts", crossing, 2)
    orders("crossing parts", parts, 8, 1.5)
    if HAS_NATIVE:
        moving = Moving(native.build(faces_of_meshes(parts[:-1])))
        arriving = faces_of_meshes(parts[-1:])
        shifts = iter(np.linspace(0, 6, 400).tolist())

        def dragged() -> None:
            shift = np.array([next(shifts), 0.0, 0.0])
            planes = arriving.planes.copy()
            planes[:, 3] += planes[:, :3] @ shift
            moving.with_faces(moved(arriving, shift, planes))

        ours, theirs = least(15, dragged, lambda: native.build(crossing))
        row("one of the parts put in, against the full build", ours, theirs, 10)

    print(f"\nmissed: {', '.join(missed)}" if missed else "\nall bounds are kept")
    return int(bool(missed))


def moved(faces: Faces, shift: np.ndarray, planes: np.ndarray) -> Faces:
    return Faces(faces.points + shift, faces.corners, faces.starts, planes, faces.plane_of, faces.group, faces.side)


if __name__ == "__main__":
    sys.exit(main())
