"""The compiled code, of the .cpp files here: loaded through ctypes where it was built, and nothing elsewhere.

The environment variable SOLIDTREE_COMPILED=0 leaves it out. ctypes lets other threads run during its calls.
"""

from __future__ import annotations

import ctypes
import os
from collections.abc import Callable
from functools import cache
from importlib.machinery import EXTENSION_SUFFIXES
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike, DTypeLike, NDArray

from .faces import Faces, joined
from .tree import EPSILON, Tree, empty_tree

Numbers = NDArray[np.int64]

INTERFACE = 4
"""What bsp_interface answers; one that was left over from before is not used."""

_REPORT = ctypes.CFUNCTYPE(ctypes.c_int32, ctypes.c_int64, ctypes.c_int64)
_FAILURES = {
    1: (MemoryError, "there is not enough memory for the BSP tree"),
    2: (OverflowError, "the faces cut one another into more pieces than a BSP tree can number"),
    4: (ValueError, "the nodes of this BSP tree go in a circle"),
}
_ADDRESS, _NUMBER, _COUNT = ctypes.c_void_p, ctypes.c_int32, ctypes.c_int64


class _Faces(ctypes.Structure):
    _fields_ = (
        *((name, _ADDRESS) for name in ("points", "corners", "starts", "planes", "plane_of", "group", "side")),
        *((name, _COUNT) for name in ("points_count", "count")),
    )


class _Tree(ctypes.Structure):
    _fields_ = (
        *((name, _ADDRESS) for name in ("points", "corners", "starts", "source", "plane")),
        *((name, _ADDRESS) for name in ("front", "back", "first", "count", "kind")),
        *((name, _COUNT) for name in ("points_count", "fragments", "nodes", "root")),
    )


class _Order(ctypes.Structure):
    _fields_ = (
        *((name, _ADDRESS) for name in ("nodes", "starts", "planes", "plane_of")),
        *((name, _COUNT) for name in ("planes_count", "count", "root")),
    )


_LINKS = ("front", "back", "first", "count", "kind")
_NODE = np.dtype([("plane", np.float64, 4), *((name, np.int32) for name in _LINKS), ("unused", np.int32, 3)])


def available() -> bool:
    """Whether the extension is there and wanted."""
    return _library() is not None


def describe() -> str:
    """Which of the two builders is in use, for people: "BSP: compiled" or "BSP: NumPy"."""
    return "BSP: compiled" if available() else "BSP: NumPy"


@cache
def _library() -> ctypes.CDLL | None:
    if os.environ.get("SOLIDTREE_COMPILED") == "0":
        return None
    for suffix in EXTENSION_SUFFIXES:
        path = Path(__file__).with_name(f"bsp{suffix}")
        if not path.is_file():
            continue
        try:
            found = ctypes.CDLL(str(path))
            if found.bsp_interface() == INTERFACE:
                return _declared(found)
        except (OSError, AttributeError):
            continue
    return None


def _declared(compiled: ctypes.CDLL) -> ctypes.CDLL:
    faces, tree, order = ctypes.POINTER(_Faces), ctypes.POINTER(_Tree), ctypes.POINTER(_Order)
    handle = ctypes.POINTER(_ADDRESS)
    for name, result, arguments in (
        ("bsp_build", _NUMBER, (faces, ctypes.c_double, _REPORT, handle)),
        ("bsp_insert", _NUMBER, (faces, tree, _NUMBER, _COUNT, ctypes.c_double, handle)),
        ("bsp_sizes", None, (_ADDRESS, _ADDRESS)),
        ("bsp_copy", None, (_ADDRESS,) * 11),
        ("bsp_free", None, (_ADDRESS,)),
        ("bsp_order", _COUNT, (order, _ADDRESS, _NUMBER, _NUMBER, _ADDRESS, _COUNT)),
        ("bsp_first_hits", _NUMBER, (*6 * (_ADDRESS,), _COUNT, ctypes.c_double, _ADDRESS, _ADDRESS)),
        ("bsp_fans", None, (_ADDRESS, _COUNT, _ADDRESS, _ADDRESS)),
        ("proximity_build", _COUNT, (_ADDRESS, _COUNT, _ADDRESS, _ADDRESS, _ADDRESS)),
        ("proximity_distance", _NUMBER, (_ADDRESS, _ADDRESS, _ADDRESS, ctypes.c_double, _ADDRESS, _ADDRESS)),
        ("proximity_near", _NUMBER, (*4 * (_ADDRESS,), _COUNT, _ADDRESS, _ADDRESS)),
        ("proximity_nearest", _NUMBER, (_ADDRESS, _ADDRESS, _COUNT, ctypes.c_double, _ADDRESS, _ADDRESS, _ADDRESS)),
        ("proximity_pieces", None, (_ADDRESS, _COUNT, _COUNT, _ADDRESS)),
        ("proximity_sweep", _NUMBER, (*5 * (_ADDRESS,), ctypes.c_double, _ADDRESS, _ADDRESS)),
        ("proximity_windings_of", None, (_ADDRESS, _ADDRESS, _COUNT, _ADDRESS)),
        ("proximity_windings", _NUMBER, (_ADDRESS, _ADDRESS, _COUNT, _ADDRESS)),
    ):
        function = getattr(compiled, name)
        function.restype, function.argtypes = result, arguments
    return compiled


def library() -> ctypes.CDLL:
    """What was compiled; only where it is `available`."""
    found = _library()
    if found is None:
        raise RuntimeError("the compiled BSP builder is not here")
    return found


def build(faces: Faces, progress: Callable[[int, int], None] | None = None) -> Tree:
    """The tree of the faces; see `build.build`.

    Raises ValueError for faces whose arrays do not fit together or hold something else than numbers, MemoryError, and
    OverflowError where there are more than 2³¹ pieces. What `progress` raises stops the work and is raised again.
    """
    compiled = library()
    if not faces.count:
        return empty_tree(faces)
    raised: list[BaseException] = []

    def report(done: int, total: int) -> int:
        try:
            if progress is not None:
                progress(done, total)
        except BaseException as error:  # ctypes would print it and go on
            raised.append(error)
        return len(raised)

    view, held = _faces_view(faces)
    epsilon = EPSILON * faces.size
    if progress is not None:
        progress(0, faces.count)
    callback = _REPORT(report) if progress is not None else _REPORT()
    handle = _ADDRESS()
    try:
        status = compiled.bsp_build(view, epsilon, callback, ctypes.byref(handle))
        if raised:
            raise raised[0]
        check(status)
        tree = _taken(compiled, handle, faces, epsilon, None)
    finally:
        compiled.bsp_free(handle)
        del held
    if progress is not None:
        progress(len(tree.source), len(tree.source))
    return tree


def insert(tree: Tree, moving: Faces) -> Tree:
    """The tree with the faces `moving` put in; see `insertion.Moving.with_faces`. Raises as `build`."""
    compiled = library()
    faces = joined((tree.faces, moving))
    faces_view, faces_held = _faces_view(faces)
    before, tree_held = tree_view(tree)
    handle = _ADDRESS()
    try:
        check(
            compiled.bsp_insert(
                faces_view, before, tree.faces.count, len(tree.faces.points), tree.epsilon, ctypes.byref(handle)
            )
        )
        return _taken(compiled, handle, faces, tree.epsilon, tree)
    finally:
        compiled.bsp_free(handle)
        del faces_held, tree_held


class Order:
    """The painter's order of one tree, as `order.Sorter` has it. Raises ValueError for a tree that cannot be one."""

    def __init__(self, tree: Tree) -> None:
        tree_view(tree)  # which looks at every number that is followed
        room = np.empty((len(tree.kind) + 1) * _NODE.itemsize, np.int8)
        nodes = room[-room.ctypes.data % _NODE.itemsize :][: len(tree.kind) * _NODE.itemsize].view(_NODE)
        for name in ("plane", *_LINKS):
            nodes[name] = getattr(tree, name)
        planes, starts = _plain(tree.faces.planes, np.float64), _plain(tree.starts, np.int32)
        of_fragments = _plain(tree.faces.plane_of[tree.source], np.int32)
        self.fans, self.fragment_of = _fans(starts)
        of_triangles = of_fragments[self.fragment_of]
        self._held = nodes, planes, starts, of_fragments, of_triangles
        sizes = (len(planes), len(nodes), tree.root)
        self._fragments = _Order(nodes.ctypes.data, None, planes.ctypes.data, of_fragments.ctypes.data, *sizes)
        self._triangles = _Order(
            nodes.ctypes.data, starts.ctypes.data, planes.ctypes.data, of_triangles.ctypes.data, *sizes
        )

    def fragments(self, eye: ArrayLike, parallel: bool, front_first: bool) -> Numbers:
        return self._ordered(self._fragments, len(self._held[3]), eye, parallel, front_first)

    def triangles(self, eye: ArrayLike, parallel: bool, front_first: bool) -> Numbers:
        return self._ordered(self._triangles, len(self._held[4]), eye, parallel, front_first)

    def _ordered(self, view: _Order, room: int, eye: ArrayLike, parallel: bool, front_first: bool) -> Numbers:
        towards = _plain(np.asarray(eye, float).reshape(3), np.float64)
        out = np.empty(room, np.int64)
        count = library().bsp_order(view, towards.ctypes.data, parallel, front_first, out.ctypes.data, room)
        check(-min(count, 0))
        return out[:count]


def _fans(starts: NDArray[np.int32]) -> tuple[Numbers, Numbers]:
    """The triangles (t, 3) that fragments are fanned into, as places in the corners, and the fragment (t,) of each."""
    fragments = len(starts) - 1
    count = int(starts[-1]) - 2 * fragments
    triangles, fragment_of = np.empty((count, 3), np.int64), np.empty(count, np.int64)
    library().bsp_fans(starts.ctypes.data, fragments, triangles.ctypes.data, fragment_of.ctypes.data)
    return triangles, fragment_of


def check(status: int) -> None:
    """Raises what a status of the compiled code stands for."""
    if status:
        kind, words = _FAILURES[status]
        raise kind(words)


def _plain(array: NDArray, dtype: DTypeLike) -> NDArray:
    return np.ascontiguousarray(array, dtype)


def _faces_view(faces: Faces) -> tuple[_Faces, tuple[NDArray, ...]]:
    """The faces as C has them, after a look at every number that is followed there, and what must live as long."""
    points, planes = _plain(faces.points, np.float64), _plain(faces.planes, np.float64)
    corners, starts = _plain(faces.corners, np.int32), _plain(faces.starts, np.int32)
    plane_of, group = _plain(faces.plane_of, np.int32), _plain(faces.group, np.int32)
    side = _plain(faces.side, np.int8)
    count = faces.count
    if not (np.isfinite(points).all() and np.isfinite(planes).all()):
        raise ValueError("a face has a corner or a plane that is not a finite number")
    if not len(plane_of) == len(group) == len(side) == count or planes.shape[1:] != (4,) or points.shape[1:] != (3,):
        raise ValueError("the arrays of the faces do not fit together")
    if starts[0] != 0 or starts[-1] > len(corners) or (count and np.diff(starts).min() < 3):
        raise ValueError("a face has fewer than three corners")
    if not (_within(corners, len(points)) and _within(plane_of, len(planes))):
        raise ValueError("a face refers to a point or a plane that is not there")
    held = (points, corners, starts, planes, plane_of, group, side)
    return _Faces(*(array.ctypes.data for array in held), len(points), count), held


def tree_view(tree: Tree) -> tuple[_Tree, tuple[NDArray, ...]]:
    """The tree as C has it, after a look at every number that is followed there, and what must live as long."""
    points, plane = _plain(tree.points, np.float64), _plain(tree.plane, np.float64)
    corners, starts, source = (_plain(array, np.int32) for array in (tree.corners, tree.starts, tree.source))
    links = tuple(_plain(array, np.int32) for array in (tree.front, tree.back, tree.first, tree.count))
    kind = _plain(tree.kind, np.int8)
    front, back, first, count = links
    nodes, fragments = len(kind), len(source)
    if not (
        {len(array) for array in (plane, *links)} == {nodes}
        and len(starts) == fragments + 1
        and starts[0] == 0
        and starts[-1] == len(corners)
        and (np.diff(starts) >= 3).all()
        and (_within(corners, len(points)) and _within(source, tree.faces.count))
        and _within(tree.faces.plane_of, len(tree.faces.planes))
        and (_within(front, nodes, -1) and _within(back, nodes, -1) and -1 <= tree.root < nodes)
        and (_within(first, fragments + 1) and _within(count, fragments + 1) and _within(first + count, fragments + 1))
    ):
        raise ValueError("the arrays of this BSP tree do not fit together")
    held = (points, corners, starts, source, plane, *links, kind)
    return _Tree(*(array.ctypes.data for array in held), len(points), fragments, nodes, tree.root), held


def _within(numbers: NDArray[np.int32], count: int, least: int = 0) -> bool:
    return not len(numbers) or bool(numbers.min() >= least and numbers.max() < count)


def _taken(compiled: ctypes.CDLL, handle: ctypes.c_void_p, faces: Faces, epsilon: float, before: Tree | None) -> Tree:
    """The tree in the handle: what is new in it, after the points and fragments of the tree `before`."""
    sizes = np.zeros(5, np.int64)
    compiled.bsp_sizes(handle, sizes.ctypes.data)
    new_points, new_corners, new_fragments, nodes, root = sizes.tolist()
    known = (
        (before.points, before.corners, before.starts, before.source)
        if before is not None
        else (faces.points, np.zeros(0, np.int32), np.zeros(1, np.int32), np.zeros(0, np.int32))
    )
    added = (new_points, new_corners, new_fragments, new_fragments)
    points, corners, starts, source = (_longer(old, more) for old, more in zip(known, added, strict=True))
    plane, kind = np.empty((nodes, 4)), np.empty(nodes, np.int8)
    front, back, first, count = (np.empty(nodes, np.int32) for _ in range(4))
    tails = [array[len(old) :] for array, old in zip((points, corners, starts, source), known, strict=True)]
    compiled.bsp_copy(handle, *(array.ctypes.data for array in (*tails, plane, front, back, first, count, kind)))
    return Tree(faces, epsilon, points, corners, starts, source, plane, front, back, first, count, kind, root)


def _longer(old: NDArray, more: int) -> NDArray:
    """A copy of the rows of `old` with room for `more` after them."""
    made = np.empty((len(old) + more, *old.shape[1:]), old.dtype)
    made[: len(old)] = old
    return made
