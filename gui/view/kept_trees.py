"""The BSP trees of what was shown last, and what can be made of them while a picture waits."""

from __future__ import annotations

from collections import OrderedDict
from dataclasses import dataclass
from time import perf_counter, thread_time
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ...model.partition.insertion import Moving
    from ...model.partition.tree import Tree
    from ...model.solid.display import DisplayMesh

MOST_PIECES = 2_000_000
"""Fragments of all trees that are kept, a hundred bytes or two each; the newest tree stays however large it is."""
AT_ONCE = 0.02
"""Seconds that a picture may wait for its tree."""

FEW = 500
"""Triangles below which the time says nothing about their number."""

Shown = tuple[tuple[str, "DisplayMesh"], ...]
"""Solids by id. Meshes are compared by identity."""


class _Pace:
    """How long work on triangles takes here, judged by the better one of the last two times it was done.

    It is the processor's time that counts: where others want it too, pictures take longer by as much.
    """

    def __init__(self, usual: float) -> None:
        """`usual` in seconds a triangle, for as long as nothing has been done."""
        self._usual = usual
        self.start_again()

    def start_again(self) -> None:
        self._last = [self._usual, self._usual]

    def fits(self, triangles: int, seconds: float) -> bool:
        return triangles * min(self._last) <= seconds

    def took(self, triangles: int, seconds: float) -> None:
        self._last = [self._last[1], max(seconds / max(triangles, FEW), 0.25 * self._usual)]


@dataclass(frozen=True, slots=True)
class Found:
    """A tree of the shown solids, which are the solids of its faces in this order; `built` as a whole, not put together
    from a tree and what it lacked."""

    tree: Tree
    solid_ids: tuple[str, ...]
    built: bool


class KeptTrees:
    """Trees by the solids whose triangles they hold. Nothing here takes longer than a picture may wait."""

    def __init__(self) -> None:
        self._trees: OrderedDict[Shown, Tree] = OrderedDict()
        self._seconds: dict[Shown, float] = {}
        self._moving: tuple[Shown, Moving] | None = None
        # Seconds a triangle on crossing parts, the slowest that were measured: compiled, and by NumPy.
        self._building = {True: _Pace(5e-6), False: _Pace(5e-5)}
        self._inserting = _Pace(5e-6)

    def __contains__(self, shown: Shown) -> bool:
        return shown in self._trees

    def keep(self, shown: Shown, tree: Tree, seconds: float) -> None:
        """Take a tree that was built, in this time."""
        self._trees[shown] = tree
        self._trees.move_to_end(shown)
        self._seconds[shown] = seconds
        held = sum(len(kept.source) for kept in self._trees.values())
        while held > MOST_PIECES and len(self._trees) > 1:
            oldest, tree = self._trees.popitem(last=False)
            del self._seconds[oldest]
            held -= len(tree.source)

    def clear(self) -> None:
        """Let go of all trees, and of the meshes that they are of."""
        self._trees.clear()
        self._seconds.clear()
        self._moving = None

    def seconds(self, tree: Tree | None) -> float | None:
        """How long it took to build a tree that is kept; None for others."""
        return next((self._seconds[shown] for shown, kept in self._trees.items() if kept is tree), None)

    def find(self, shown: Shown) -> Found | None:
        """A tree of exactly these solids, if there is one, or one can be put together at once. Raises as `build`."""
        wanted = set(shown)
        fitting = [kept for kept in self._trees if wanted.issuperset(kept)]
        if not fitting:
            return None
        best = max(fitting, key=triangles)
        self._trees.move_to_end(best)
        held = set(best)
        rest = tuple(entry for entry in shown if entry not in held)
        if not rest:
            return Found(self._trees[best], _ids(best), True)
        if not self.fits_in(rest):
            return None
        return self._put_together(best, rest)

    def fits(self, shown: Shown, seconds: float = AT_ONCE) -> bool:
        """Whether a tree of these can be built here within this time."""
        return self._building[self.quick].fits(triangles(shown), seconds)

    def fits_in(self, moving: Shown) -> bool:
        """Whether these can be put into a tree at once."""
        return self.quick and self._inserting.fits(triangles(moving), AT_ONCE)

    def start_again(self) -> None:
        """Forget that putting in was slow: what moves next is something else."""
        self._inserting.start_again()

    @property
    def quick(self) -> bool:
        """Whether the compiled extension is there."""
        from ...model.partition import native

        return native.available()

    def build(self, shown: Shown, keep: bool = True) -> Found:
        """Build a tree here and now. Raises as `partition.build.build`."""
        from ...model.partition.build import build
        from ...model.partition.faces import faces_of_meshes

        begin, start = perf_counter(), thread_time()
        tree = build(faces_of_meshes(meshes(shown)))
        self._building[self.quick].took(triangles(shown), thread_time() - start)
        if keep:
            self.keep(shown, tree, perf_counter() - begin)
        return Found(tree, _ids(shown), True)

    def _put_together(self, best: Shown, rest: Shown) -> Found:
        from ...model.partition.faces import faces_of_meshes
        from ...model.partition.insertion import Moving

        start = thread_time()
        if self._moving is None or self._moving[0] != best:
            self._moving = best, Moving(self._trees[best])
        tree = self._moving[1].with_faces(faces_of_meshes(meshes(rest)))
        self._inserting.took(triangles(rest), thread_time() - start)
        return Found(tree, _ids(best) + _ids(rest), False)


def meshes(shown: Shown) -> tuple[DisplayMesh, ...]:
    return tuple(mesh for _, mesh in shown)


def triangles(shown: Shown) -> int:
    return sum(len(mesh.triangles) for _, mesh in shown)


def _ids(shown: Shown) -> tuple[str, ...]:
    return tuple(solid_id for solid_id, _ in shown)
