"""What a part meets while it is dragged: shown, and if the user likes the drag stops there or slides along."""

from __future__ import annotations

from collections.abc import Callable, Collection
from typing import TYPE_CHECKING, Literal
from weakref import WeakKeyDictionary

from PySide6.QtCore import QObject, Signal

from ...model.document.tree import homes
from ...model.measuring.elements import short
from .handle_drags import MoveDrag, TurnDrag

if TYPE_CHECKING:
    from ...model.document.document import Document
    from ...model.document.errors import Refusal
    from ...model.document.nodes import Node
    from ...model.proximity.live import Contact, LiveContacts
    from ...model.proximity.parts import Part
    from ...model.solid.display import DisplayMesh
    from ...render.handles.contact_marks import ContactMarks
    from ...render.viewer import Viewer
    from ..background import Background
    from ..settings import Settings
    from .handle_drags import Drag, Floats

Mode = Literal["show", "stop", "slide", "off"]
MODES: tuple[Mode, ...] = ("show", "stop", "slide", "off")

REACH = 40.0  # logical pixels within which parts are told of
AT_ONCE = 100_000  # triangles that are made ready while the pointer waits
MOST_WORDS = 3  # contacts that are named beside the pointer


class DragContacts(QObject):
    """Of one drag at a time. `mode_changed` tells of another choice; `ready` that what took long is there now."""

    mode_changed = Signal()
    ready = Signal()

    def __init__(
        self, settings: Settings, background: Background, settled: Callable[[], bool], parent: QObject
    ) -> None:
        """`settled` tells whether the meshes that are shown are those of the document."""
        super().__init__(parent)
        self._settings, self._background, self._settled = settings, background, settled
        self.mode: Mode = settings.choice("contacts", MODES)  # type: ignore[assignment]
        self._viewer: Viewer | None = None
        self._marks: ContactMarks | None = None
        self._parts: WeakKeyDictionary[DisplayMesh, Part] = WeakKeyDictionary()
        self._document: Document | None = None
        self._moved: Collection[str] = ()
        """The roots that are dragged, or whose nodes are."""
        self._rigid = False
        """Whether they are dragged as they are, so that their first meshes serve for all of the drag."""
        self._live: LiveContacts | None = None
        self._rest: tuple[Document | None, dict[str, DisplayMesh]] = (None, {})
        """What was shown of which document when all of it was."""
        self._meshes: dict[str, DisplayMesh] = {}
        self._drag: Drag | None = None
        self._place: Floats | float | None = None
        """Where the drag has come to: a way (3,) in mm, or an angle in degrees."""
        self.found: tuple[Contact, ...] = ()

    def set_mode(self, mode: Mode) -> None:
        self.mode = mode
        self._settings.set_choice("contacts", mode)
        self.mode_changed.emit()

    def attached(self, viewer: Viewer) -> None:
        from ...render.handles.contact_marks import ContactMarks

        self._viewer, self._marks = viewer, ContactMarks(viewer)
        viewer.overlay.add(self._marks)

    def closing(self) -> None:
        self.end()
        self._viewer = self._marks = None

    def begin(self, document: Document, ids: Collection[str], drag: Drag) -> None:
        """A drag of these nodes begins."""
        if self.mode == "off" or self._viewer is None:
            return
        self._document, self._drag = document, drag
        self._moved = tuple(homes(document, ids))
        roots = {root.id for root in document.solids}
        self._rigid = set(ids) <= roots and drag.pose() is not None
        self._make()

    def end(self) -> None:
        self._document = self._drag = self._live = self._place = None
        self._meshes, self.found = {}, ()
        if self._marks is not None:
            self._marks.show()

    def shown(self) -> None:
        """Other meshes are in the picture. Parts that are dragged as they are keep the first ones."""
        if self._document is not None and not self._rigid:
            self._make()
            self.follow()

    def rest(self, document: Document) -> None:
        """No drag is under way, and the meshes in the picture may be those of this document."""
        if self._viewer is not None and self._settled():
            self._rest = document, self._viewer.scene.solid_meshes

    def hold(self) -> None:
        """Take the drag back to where it does not overlap, where the user wants that."""
        import numpy as np

        drag, live = self._drag, self._live
        if live is None or not self._rigid or self.mode not in ("stop", "slide"):
            return
        if isinstance(drag, MoveDrag):
            start = self._place if isinstance(self._place, np.ndarray) else np.zeros(3)
            way = drag.way() - start
            if self.mode == "slide":
                gone, stop = live.slid(start, way, drag.span)
            else:
                gone, stop = live.stopped(start, way)
            if stop is not None:
                drag.hold(start + gone)
            self._place = drag.way()
        elif isinstance(drag, TurnDrag):
            angle = drag.angle()
            before = self._place if isinstance(self._place, float) else 0.0
            free = live.turned(drag.turned, before, angle, drag.origin)
            if free != angle:
                drag.hold(free, before)
            self._place = drag.angle()

    def follow(self) -> None:
        """Show what is met where the drag is now."""
        import numpy as np

        live, drag = self._live, self._drag
        if live is None or drag is None:
            return
        pose = drag.pose() if self._rigid else np.eye(4)
        self.found = () if pose is None else live.contacts(pose)
        live.came_apart(self.found)
        self._mark()

    def words(self) -> str:
        """What is met, in a line for each."""
        if self._document is None or not self.found:
            return ""
        names = {root.id: root.label for root in self._document.solids}
        told: list[str] = []
        for contact in self.found:
            name = names.get(contact.standing.key, "")
            if contact.kind in ("overlaps", "touches"):
                told.append(f"{contact.kind} “{name}”")
            else:
                told.append(f"{short(contact.gap)} mm to “{name}”")
        more = len(told) - MOST_WORDS
        return "\n ".join(told[:MOST_WORDS] + ([f"and {more} more"] if more > 0 else []))

    def _make(self) -> None:
        """Get the parts ready: at once, or where they are large in the background."""
        viewer, document, drag = self._viewer, self._document, self._drag
        if viewer is None or document is None:
            return
        self._meshes = shown = viewer.scene.solid_meshes
        parts: dict[str, Part] = {}
        for root in document.solids:
            if root.visible and root.id in shown:
                part = self._standing_at(root) if self._rigid else self._part(root.id, shown[root.id])
                if part is not None and not part.empty:
                    parts[root.id] = part
        raw = [part for part in parts.values() if "tree" not in part.__dict__]

        def use() -> None:
            if self._drag is drag and self._meshes is shown:
                self._use(parts)
                self.ready.emit()

        def work() -> None:
            for part in raw:
                part.prepare()

        def refused(refusal: Refusal) -> None:
            """There is nothing to refuse."""

        if sum(len(part.triangles) for part in raw) > AT_ONCE:
            self._live = None
            self._background.run("Getting ready for contacts", work, lambda _: use(), refused)
        else:
            self._use(parts)

    def _use(self, parts: dict[str, Part]) -> None:
        from ...model.proximity.live import LiveContacts
        from ...render.handles.drag import pixel_length

        viewer, document, drag = self._viewer, self._document, self._drag
        if viewer is None or document is None or drag is None:
            return
        dragged = [part for key, part in parts.items() if key in self._moved]
        standing = [part for key, part in parts.items() if key not in self._moved]
        if not dragged or not standing:
            self._live = None
            return
        checks = document.checks
        own = {pair.ends: pair for pair in checks.pairs}

        def clearance(one: str, other: str) -> float:
            pair = own.get((min(one, other), max(one, other)))
            if pair is None:
                return checks.clearance
            if pair.touching:
                return 0.0
            return checks.clearance if pair.clearance is None else pair.clearance

        middle = dragged[0].bounds.mean(axis=0)
        reach = REACH * pixel_length(viewer.camera, middle, viewer.size)
        self._live = LiveContacts(standing, dragged, clearance, reach)
        if self.mode != "show":
            self._live.begin()

    def _part(self, key: str, mesh: DisplayMesh) -> Part:
        from ...model.proximity.parts import Part

        part = self._parts.get(mesh)
        if part is None or part.key != key:
            part = self._parts[mesh] = Part(key, mesh.vertices, mesh.corners)
        return part

    def _standing_at(self, root: Node) -> Part | None:
        """A root where the document has it, which the picture may not show yet; None where it has another shape."""
        import numpy as np

        from ...model.document.document import parameter_values
        from ...model.document.placement import inverse, product
        from ...model.proximity.parts import Part

        before, meshes = self._rest
        document = self._document
        if document is None or before is None:
            return None
        if root.id not in meshes:
            return self._part(root.id, self._meshes[root.id])
        mesh = meshes[root.id]
        known = next((one for one in before.solids if one.id == root.id), None)
        same = before.parameters == document.parameters and before.definitions == document.definitions
        if known is None or not same or known.shape_digest != root.shape_digest:
            return None
        if known.placement == root.placement:
            return self._part(root.id, mesh)
        values = parameter_values(document.parameters)[0]
        old, new = (one.placement.resolve(values).matrix() for one in (known, root))
        moved = product(new, inverse(old))
        corners = mesh.corners if np.linalg.det(moved[:, :3]) > 0.0 else mesh.corners[:, ::-1]
        return Part(root.id, mesh.vertices @ moved[:, :3].T + moved[:, 3], corners)

    def _mark(self) -> None:
        if self._marks is None:
            return
        from ...render.handles.contact_marks import MarkedContact

        marked = []
        for number, contact in enumerate(self.found):
            mesh = self._meshes.get(contact.standing.key)
            apart = contact.kind in ("close", "near")
            if mesh is not None and (not apart or number < MOST_WORDS):
                text = f"{short(contact.gap)} mm" if apart else ""
                marked.append(MarkedContact(mesh, contact.kind, contact.points, text))
        self._marks.show(marked)
