"""Which node of the document a picked face belongs to, and how that is said."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ...model.document.document import Document
from ...model.document.tree import walk
from ...model.editing.session import Session

if TYPE_CHECKING:
    from ...render.pick import Pick

Path = tuple[str | int, ...]


class Pointed:
    """Answers for one session; the labels of a document's nodes are collected once."""

    def __init__(self, session: Session) -> None:
        self._session = session
        self._labels: tuple[Document, dict[str, str]] | None = None

    def labels(self) -> dict[str, str]:
        """The labels of all nodes by id."""
        document = self._session.document
        if self._labels is None or self._labels[0] is not document:
            self._labels = (document, {node.id: node.label for node in walk(*document.roots)})
        return self._labels[1]

    def owner(self, pick: Pick | None) -> str | None:
        """The deepest node of the picked face's path that stands in the document."""
        known = self.labels()
        path = () if pick is None else pick.path
        return next((part for part in reversed(path) if isinstance(part, str) and part in known), None)

    def path(self, pick: Pick | None) -> Path | None:
        """The picked face's path as far as `owner`."""
        owner = self.owner(pick)
        return None if pick is None or owner is None else pick.path[: len(pick.path) - pick.path[::-1].index(owner)]

    def words(self, pick: Pick | None) -> str:
        """The names on the way to the face, and its facet; "" for nothing."""
        path, labels = self.path(pick), self.labels()
        if pick is None or path is None:
            return ""
        names = " › ".join(labels[part] for part in path if isinstance(part, str) and part in labels)  # noqa: RUF001
        return f"{names} — facet {pick.facet}{', left by a subtracted part' if pick.subtracted else ''}"
