"""Which nodes of the document a picked face belongs to, and how that is said."""

from __future__ import annotations

from html import escape
from typing import TYPE_CHECKING

from ...model.document.document import Document
from ...model.document.from_outlines import FROM_OUTLINES
from ...model.document.nodes import Node
from ...model.document.outlines import Lettering, Stencil, TextOnPath, is_outline
from ...model.document.resolve import Resolver
from ...model.document.tree import walk
from ...model.editing.session import Session

if TYPE_CHECKING:
    from ...model.solid.roles import Role
    from ...render.pick import Pick

Path = tuple[str | int, ...]

LEVELS = 6
"""Names of a chain that are told; of a longer one those in the middle are left out."""
NEGLIGIBLE = 1e-9
"""Millimetres that are told as 0."""
ARROW = " › "  # noqa: RUF001


class Pointed:
    """Answers for one session; a document's nodes are collected once."""

    def __init__(self, session: Session) -> None:
        self._session = session
        self._nodes: tuple[Document, dict[str, Node]] | None = None
        self._resolver = Resolver()

    def nodes(self) -> dict[str, Node]:
        """All nodes by id."""
        document = self._session.document
        if self._nodes is None or self._nodes[0] is not document:
            self._nodes = (document, {node.id: node for node in walk(*document.roots)})
        return self._nodes[1]

    def chain(self, pick: Pick | None) -> tuple[str, ...]:
        """The makers of the face, and before a solid of letters the text itself: what clicks go through."""
        made = self.makers(pick)
        text = self._text_of(made[0]) if made else None
        return made if text is None else (text, *made)

    def makers(self, pick: Pick | None) -> tuple[str, ...]:
        """The nodes from the one that made the face up to the solid, as far as they stand in the document."""
        known = self.nodes()
        path = () if pick is None else pick.path
        return tuple(dict.fromkeys(part for part in reversed(path) if isinstance(part, str) and part in known))

    def _text_of(self, node_id: str) -> str | None:
        """The lettering that a solid is made of, as it is, set along a curve or held by bridges."""
        node = self.nodes()[node_id]
        if not isinstance(node, FROM_OUTLINES) or len(node.children) != 1:
            return None
        outline = node.children[0]
        while isinstance(outline, TextOnPath | Stencil):
            outline = outline.children[0]
        return outline.id if isinstance(outline, Lettering) else None

    def owner(self, pick: Pick | None) -> str | None:
        """The deepest node of the picked face's path that stands in the document."""
        return next(iter(self.makers(pick)), None)

    def path(self, pick: Pick | None) -> Path | None:
        """The picked face's path as far as `owner`."""
        owner = self.owner(pick)
        return None if pick is None or owner is None else pick.path[: len(pick.path) - pick.path[::-1].index(owner)]

    def role(self, path: Path) -> Role:
        """What becomes of the occurrence in its solid."""
        from ...model.solid.roles import role_of

        return role_of(self._resolver.resolve(self._session.view).solids, path)

    def words(self, pick: Pick | None) -> str:
        """The names on the way to the face, selected ones in brackets, what made it, where it is; "" for nothing."""
        path = self.path(pick)
        if pick is None or path is None:
            return ""
        x, y, z = (f"{0.0 if abs(value) < NEGLIGIBLE else value:.4g}" for value in pick.point)
        return f"{self._trail(path)} — {self._kind(pick, path)} — ({x}, {y}, {z})"

    def tip(self, pick: Pick | None) -> str:
        """The same in short, as rich text in two lines."""
        path = self.path(pick)
        if pick is None or path is None:
            return ""
        return f"<b>{escape(self.nodes()[str(path[-1])].label)}</b><br>{escape(self._kind(pick, path))}"

    def entry(self, pick: Pick) -> str:
        """The face's owner and its role, for a list of what lies under the pointer."""
        path = self.path(pick)
        if path is None:
            return ""
        role, label = self.role(path), self.nodes()[str(path[-1])].label
        return f"{label} ({role})" if role else label

    def _trail(self, path: Path) -> str:
        nodes, chosen = self.nodes(), self._session.selection
        names: list[str] = []
        for part in path:
            if isinstance(part, int):
                if names:
                    names[-1] += f" #{part + 1}"  # the copy of an array
            elif part in nodes:
                label = nodes[part].label
                names.append(f"[{label}]" if part in chosen else label)
        if len(names) > LEVELS:
            names[2 : len(names) - LEVELS + 3] = ["…"]
        return ARROW.join(names)

    def _kind(self, pick: Pick, path: Path) -> str:
        role = self.role(path)
        parts = [self.nodes()[str(path[-1])].title.lower(), *([str(role)] if role else [])]
        if not is_outline(self.nodes()[str(path[0])], self._session.document.definitions):
            parts.append("cut face" if pick.facet < 0 else f"facet {pick.facet}")
        return ", ".join(parts)
