"""The outline that is being edited: the one selected node, its curves, and which of its nodes are chosen."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any, Literal

from PySide6.QtCore import QObject, Signal

from ...model.document.document import Document
from ...model.document.errors import Refusal
from ...model.document.nodes import Broken, range_fault
from ...model.document.outlines import Bezier, BSpline, is_outline
from ...model.document.placement import IDENTITY, Placement
from ...model.document.resolve import Resolver
from ...model.document.tree import find, walk
from ...model.editing import echo
from ...model.operations.operations import OPERATIONS

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from ...model.document.nodes import Node
    from ...model.editing.session import Session, State
    from ...model.path.path import Path

    Floats = NDArray[np.float64]

Place = tuple[int, int]
Call = tuple[str, tuple[Any, ...], dict[str, Any]]
"""An operation on the node: its name, its arguments after the node's id, and the ones by name."""


class ActiveCurve(QObject):
    """Follows the session, previews included; `changed` tells that anything here is another now.

    `node` is the one selected node where that is an outline whose curves can be had, else None: as it stands in the
    document, expressions and all. `path` has its curves, resolved, in its own axes (before its placement); `frame`
    (3, 4) takes these to the world. `chosen` has nodes (contour, node); of Bezier curves and B-splines control points
    (0, number). `refused` carries the words of what could not be done.
    """

    changed = Signal()
    refused = Signal(str)

    def __init__(self, session: Session, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._session = session
        self._resolver = Resolver()
        self._document: Document = session.document
        self._seen: tuple[Document, tuple[str, ...]] | None = None
        self._forget()
        self.session_changed(session.state, session.state)

    def _forget(self) -> None:
        self.node: Node | None = None
        self.path: Path | None = None
        self.frame: Floats = IDENTITY
        self.chosen: frozenset[Place] = frozenset()
        self.fault = ""
        """Why the outline that is selected has no curves; "" where it has some, or none is selected."""
        self._resolved: Node | None = None
        self._points: tuple[Floats, list[Place]] | None = None
        self._counts: tuple[int, ...] = ()

    @property
    def document(self) -> Document:
        """The document without what is previewed: what operations begin from."""
        return self._document

    @property
    def by_points(self) -> bool:
        """Whether control points are what is chosen, as of Bezier curves and B-splines."""
        return isinstance(self.node, (Bezier, BSpline))

    @property
    def resolved(self) -> Node | None:
        """The node with numbers for its expressions."""
        return self._resolved

    # What is chosen.

    @property
    def places(self) -> Floats:
        """(k, d) all nodes, or all control points, in the node's own axes."""
        return self._numbered()[0]

    @property
    def rows(self) -> list[Place]:
        """What each of `places` is called in `chosen`."""
        return self._numbered()[1]

    def _numbered(self) -> tuple[Floats, list[Place]]:
        import numpy as np

        if self._points is None:
            if self.path is None:
                self._points = np.zeros((0, 2)), []
            elif isinstance(self._resolved, (Bezier, BSpline)):
                points = np.array(self._resolved.points, float)
                self._points = points, [(0, number) for number in range(len(points))]
            else:
                contours = self.path.contours
                rows = [(c, n) for c, contour in enumerate(contours) for n in range(len(contour.nodes))]
                places = [contour.places for contour in contours]
                self._points = np.concatenate(places) if places else np.zeros((0, 2)), rows
        return self._points

    def choose(self, places: Iterable[Place], mode: Literal["replace", "add", "toggle"] = "replace", /) -> None:
        """Choose nodes; those that the outline does not have are left out."""
        wanted = frozenset(
            (contour, number)
            for contour, number in places
            if 0 <= contour < len(self._counts) and 0 <= number < self._counts[contour]
        )
        if mode == "add":
            wanted |= self.chosen
        elif mode == "toggle":
            wanted ^= self.chosen
        if wanted != self.chosen:
            self.chosen = wanted
            self.changed.emit()

    # What is done.

    def do(self, name: str, *arguments: Any, label: str = "", **more: Any) -> bool:
        """An operation on the node as a step of the history; whether it could be done."""
        return self.do_all([(name, arguments, more)], label)

    def do_all(self, calls: list[Call], label: str = "") -> bool:
        """Several operations on the node, one after the other, as one step."""
        if self.node is None or not calls:
            return False
        node_id = self.node.id
        try:
            if len(calls) == 1:
                ((name, arguments, more),) = calls
                self._session.do(name, node_id, *arguments, label=label or None, **more)
            else:
                document, lines = self._document, []
                for name, arguments, more in calls:
                    after = OPERATIONS[name](document, node_id, *arguments, **more)
                    lines.append(echo.step(document, after, name, node_id, *arguments, **more))
                    document = after
                words = label or calls[-1][0].replace("_", " ").capitalize()
                self._session.commit(words, document, line="\n".join(lines))
        except Refusal as refusal:
            self._session.cancel()
            self.refused.emit(str(refusal))
            return False
        return True

    def preview(self, name: str, *arguments: Any, **more: Any) -> bool:
        """Show what an operation on the node would make of the document; whether it could be done."""
        try:
            self.preview_all([(name, arguments, more)])
        except Refusal as refusal:
            self.refused.emit(str(refusal))
            return False
        return True

    def preview_all(self, calls: list[Call]) -> None:
        """Show what operations make of the document, from the one that stands. Raises Refusal and then shows nothing
        else than before."""
        if self.node is None:
            return
        document = self._document
        for name, arguments, more in calls:
            document = OPERATIONS[name](document, self.node.id, *arguments, **more)
        self._session.preview(document)

    def cancel(self) -> None:
        """Forget what is previewed."""
        self._session.cancel()

    # What happens.

    def session_changed(self, before: State, after: State) -> None:
        document, selection = self._session.document, self._session.selection
        if not self._session.previewing:
            self._document = document
        if self._seen is not None and self._seen[0] is document and self._seen[1] == selection:
            return
        self._seen = document, selection
        node, frame_before, resolved_before, fault_before = self.node, self.frame, self._resolved, self.fault
        self.fault = ""
        try:
            self._follow(document, selection)
        except Refusal as refusal:
            self._forget()
            self.fault = str(refusal)
        if self.node is node is None and self.fault == fault_before:
            return
        same = self._resolved is resolved_before and self.node is node and self.fault == fault_before
        if not same or self.frame is not frame_before:
            self.changed.emit()

    def _follow(self, document: Document, selection: tuple[str, ...]) -> None:
        """Raises Refusal where the outline has no curves, or no place."""
        node = find(document, selection[0]) if len(selection) == 1 else None
        if node is None or not is_outline(node, document.definitions):
            self._forget()
            return
        import numpy as np

        from ...model.outline.frames import frame_of

        if self.node is not None and self.node.id != node.id:
            self._forget()
        resolved = self._resolve(document, node)
        if resolved is not self._resolved or self.path is None:
            self.path = _own(resolved)
            self._resolved, self._points = resolved, None
            counts = _counts(resolved, self.path)
            if counts != self._counts:
                self._counts, self.chosen = counts, frozenset()
        frame = frame_of(document, node.id)
        if not np.array_equal(frame, self.frame):
            self.frame = frame
        self.node = node

    def _resolve(self, document: Document, node: Node) -> Node:
        if not node.symbolic:
            return node
        resolved = self._resolver.resolve(document)
        return next((one for one in walk(*resolved.standing) if one.id == node.id), node)


def _own(node: Node) -> Path:
    """The curves of a resolved outline before its placement. Raises Refusal."""
    from ...model.outline.paths import own_path, path_of

    if node.children:
        return path_of(node.with_(placement=Placement()))
    fault = node.message if isinstance(node, Broken) else range_fault(node)
    if fault:
        raise Refusal(fault)
    return own_path(node)


def _counts(node: Node, path: Path) -> tuple[int, ...]:
    """How many nodes each contour has, or how many control points there are."""
    if isinstance(node, (Bezier, BSpline)):
        return (len(node.points),)
    return tuple(len(contour.nodes) for contour in path.contours)
