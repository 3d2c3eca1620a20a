"""What the page of the model's tree shows and does: it follows the tree, the camera, and what the user chooses."""

from __future__ import annotations

import math
from dataclasses import asdict
from typing import TYPE_CHECKING

import numpy as np
from PySide6.QtCore import QObject, QTimer

from .inks import inks_now
from .makers import Makers, node_words
from .model_page import LEGEND, ModelPage
from .probe_tool import ProbeTool
from .tree_source import TreeSource

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ...model.partition.order import Sorter
    from ...model.partition.report import Report
    from ...model.partition.tree import Tree
    from ...render.camera import Camera
    from ...render.ghosts.partition_marks import PartitionMarks, Tints
    from ...render.viewer import Viewer
    from ..window import MainWindow


class Explorer(QObject):
    """Works while it is active, and leaves the picture as it was when it no longer is."""

    def __init__(self, window: MainWindow, page: ModelPage, probe: ProbeTool, parent: QObject) -> None:
        super().__init__(parent)
        self._window, self._viewport, self._page, self._probe = window, window.viewport, page, probe
        self.source = TreeSource(window, self)
        self.names: list[str] = []
        self._makers: Makers | None = None
        self._sorter: Sorter | None = None
        self._ordered: tuple[Camera, NDArray[np.int64]] | None = None
        self._seen: tuple[Tree, Camera, tuple[float, float]] | None = None
        self._node_seen = np.zeros(0, bool)
        self._marks: PartitionMarks | None = None
        self._active = False
        self._steps = -1
        self._look = QTimer(self)
        self._look.setSingleShot(True)
        self._look.timeout.connect(self._follow_camera)
        self.source.changed.connect(self._follow_tree)
        self.source.outdated.connect(self._forget)
        window.viewport.view_changed.connect(self._later)
        window.viewport.ready.connect(self._follow_tree)
        window.theme.changed.connect(self._retint)
        page.builder_chosen.connect(self.source.set_builder)
        page.sort_asked.connect(lambda: window.actions_.run("hidden_surface_bsp"))
        page.picture.chosen.connect(self.choose)
        page.table.chosen.connect(self.choose)
        page.order.stepped.connect(self._step)
        page.probed.connect(self.probe)
        page.probe_asked.connect(lambda wanted: probe.start() if wanted else probe.end())
        probe.probed.connect(self.probe)
        probe.active_changed.connect(page.pick.setChecked)
        page.show_builder(self.source.builder)

    def set_active(self, active: bool) -> None:
        if active == self._active:
            return
        self._active = active
        if not active:
            self._probe.end()
        self.source.set_active(active)
        if active:
            self._follow_tree()
        else:
            self._viewport.change(self._leave)

    def _leave(self, viewer: Viewer) -> None:
        viewer.set_painted(None)
        if self._marks is not None:
            self._marks.clear()

    # What is shown.

    def _forget(self) -> None:
        """Nothing is said any more about what the picture shows."""
        self._page.order.stop()
        self._sorter = self._makers = self._ordered = self._seen = None
        self._steps = -1
        self._viewport.change(self._leave)

    def _follow_tree(self) -> None:
        """Another tree, or none."""
        page, source, viewer = self._page, self.source, self._viewport.viewer
        tree = source.tree
        self._forget()
        page.picture.show_tree(None)
        page.show_point(None)
        page.table.hide()
        if not self._active:
            return
        meshes = {} if viewer is None else viewer.scene.solid_meshes
        triangles = sum(len(meshes[one].triangles) for one in source.solid_ids if one in meshes)
        if viewer is None or tree is None or source.report is None or triangles != tree.faces.count:
            words = source.words or "There is nothing to sort."
            if source.off:
                words = (
                    "The picture is drawn with the z-buffer. Sorted by a BSP tree, it shows here how the tree cuts and "
                    "orders the faces."
                )
            page.say(words, source.off)
            page.order.set_total(0)
            return
        from ...model.partition.order import Sorter

        page.say("", False)
        self._makers = Makers(tree, self._window.session.document, meshes, source.solid_ids)
        self._sorter = Sorter(tree)
        self.names = names_of(tree)
        self._marks_of(viewer).set_tree(tree)
        page.counts.setText(count_words(source.report))
        page.picture.show_tree(tree, self.names)
        page.order.set_total(source.report.counts.fragments)
        self.choose(-1)
        self._later()

    def choose(self, node: int) -> None:
        """Show a node of the tree in the picture and in words; -1 none."""
        page, viewer, makers = self._page, self._viewport.viewer, self._makers
        page.picture.choose(node)
        if makers is None or viewer is None:
            return
        from ...model.partition.descent import below, owned
        from ...model.partition.tree import INNER

        tree = makers.tree
        marks = self._marks_of(viewer)
        if node < 0:
            page.node.setText(LEGEND)
            marks.show_node(None)
        else:
            page.node.setText(node_words(makers, self.names, node))
            own = owned(tree, np.array([node]))
            if self._steps >= 0:  # there is nothing behind what has not been drawn
                marks.show_node(tree.plane[node] if tree.kind[node] == INNER else None, tints=_tints())
            elif tree.kind[node] == INNER:
                front, back = (owned(tree, below(tree, int(child[node]))) for child in (tree.front, tree.back))
                marks.show_node(tree.plane[node], own, front, back, _tints())
            else:
                marks.show_node(None, own, tints=_tints())
        self._grey()
        self._viewport.refresh()

    def _retint(self) -> None:
        if self._active and self._makers is not None:
            self.choose(self._page.picture.node)
            self._step(self._steps)

    def _marks_of(self, viewer: Viewer) -> PartitionMarks:
        if self._marks is None:
            from ...render.ghosts.partition_marks import PartitionMarks

            self._marks = PartitionMarks(viewer)
        return self._marks

    # The painter's order.

    def _step(self, count: int) -> None:
        """Draw so many fragments, and show the last of them; -1 draws all."""
        viewer, makers = self._viewport.viewer, self._makers
        began_or_ended = (count < 0) != (self._steps < 0)
        self._steps = count
        if began_or_ended:
            self.choose(self._page.picture.node)
        if viewer is None or makers is None:
            return
        viewer.set_painted(None if count < 0 else count)
        page, marks = self._page, self._marks_of(viewer)
        order = self._order(viewer)
        if 0 < count <= len(order):
            fragment = int(order[count - 1])
            node = int(makers.node_of[fragment])
            marks.show_step(fragment, _tints())
            page.picture.show_step(node)
            name = self.names[node]
            in_leaf = "alone in its leaf" if name == "1" else f"in a leaf of {name}"
            where = f"in the plane of {name}" if name.startswith("h") else in_leaf
            page.order.say(f"{count:,} of {len(order):,}: {makers.words(fragment)}, {where}.")
        else:
            marks.show_step(None)
            page.picture.show_step(-1)
            page.order.say("" if count < 0 else f"0 of {len(order):,}")
        self._viewport.refresh()

    def _order(self, viewer: Viewer) -> NDArray[np.int64]:
        """The fragments from back to front for the picture's camera."""
        camera = viewer.camera
        if self._ordered is None or self._ordered[0] != camera:
            assert self._sorter is not None
            eye = np.subtract(camera.position, camera.target) if camera.parallel else np.array(camera.position)
            self._ordered = camera, self._sorter.fragments(eye, camera.parallel)
        return self._ordered[1]

    # The camera.

    def _later(self) -> None:
        if self._active and self._makers is not None and not self._look.isActive():
            self._look.start(30)

    def _follow_camera(self) -> None:
        """What the view cone prunes now; and which fragment is now the last one drawn."""
        from ...model.partition.cone import prune
        from ...render.view_cone import camera_cone

        viewer, makers = self._viewport.viewer, self._makers
        if viewer is None or makers is None or not self._active:
            return
        self._marks_of(viewer).follow_sections()
        self._viewport.refresh()
        state = makers.tree, viewer.camera, viewer.size
        if self._seen == state:
            return
        self._seen = state
        points = makers.tree.faces.points
        box = np.array([points.min(axis=0), points.max(axis=0)])
        found = prune(makers.tree, camera_cone(viewer.camera, viewer.size, box))
        report = self.source.report
        if report is not None:
            gone = report.counts.nodes - found.nodes, report.counts.fragments - found.fragments
            self._page.seen.setText(
                f"The view cone prunes {gone[0]:,} of {report.counts.nodes:,} nodes with "
                f"{gone[1]:,} of {report.counts.fragments:,} fragments, in {len(found.cut):,} sub-trees."
                if len(found.cut)
                else "The view cone prunes nothing: it reaches over every plane."
            )
        self._node_seen = found.seen
        self._grey()
        if self._steps >= 0:
            self._step(self._steps)

    def _grey(self) -> None:
        if self._seen is not None:
            seen, picture = self._node_seen, self._page.picture
            picture.show_pruned(frozenset(i.node for i in picture.items if i.node >= 0 and not seen[i.node]))

    # The probe.

    def probe(self, point: tuple[float, float, float] | None) -> None:
        """Walk the tree down to a point; None takes the last one back."""
        from ...model.partition.descent import way_down

        page, viewer, makers = self._page, self._viewport.viewer, self._makers
        if viewer is None or makers is None:
            return
        page.show_point(point)
        way = () if point is None else way_down(makers.tree, point)
        page.picture.show_way([step.node for step in way])
        page.table.show_way(way, self.names)
        page.table.setVisible(point is not None)
        self._marks_of(viewer).show_point(None if point is None else np.array(point), _tints())
        self._grey()
        self._viewport.refresh()


def names_of(tree: Tree) -> list[str]:
    """(k,) h1, h2, ... for planes, level by level from the root; how many fragments it has for a leaf."""
    from ...model.partition.tree import INNER

    names = [""] * len(tree.kind)
    planes = 0
    for level in tree.levels():
        for node in level.tolist():
            if tree.kind[node] == INNER:
                planes += 1
                names[node] = f"h{planes}"
            else:
                names[node] = f"{int(tree.count[node]):,}"
    return names


def count_words(report: Report) -> str:
    """The tree's figures, as rich text."""
    counts = report.counts
    built = "put together from another tree" if math.isnan(report.build_seconds) else milliseconds(report.build_seconds)
    return (
        f"<b>{counts.nodes:,}</b> nodes ({counts.leaves:,} leaves), <b>{counts.depth:,}</b> deep; "
        f"<b>{counts.fragments:,}</b> fragments of {counts.faces:,} faces, "
        f"{counts.fragments_per_face:.2f} per face, {counts.splits:,} splits.<br>"
        f"Built: {built} ({report.builder}). Order: {milliseconds(report.order_seconds)}."
    )


def milliseconds(seconds: float) -> str:
    return f"{seconds:.3g} s" if seconds >= 1.0 else f"{1000.0 * seconds:.3g} ms"


def _tints() -> Tints:
    from ...render.ghosts.partition_marks import Tints

    return Tints(**asdict(inks_now()))
