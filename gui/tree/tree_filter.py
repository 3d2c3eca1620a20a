"""Rows that a search leaves out: hidden in the view, while the model stays as it is."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ...model.document.query import Query
from .tree_rows import Row

if TYPE_CHECKING:
    from .tree import Tree


class TreeFilter:
    """Keeps the rows that answer to a query and those above them, and opens what is closed over them."""

    def __init__(self, tree: Tree) -> None:
        self._tree = tree
        self._query = Query("")
        self._hidden: dict[int, Row] = {}
        self._opened: set[str] = set()
        self.matches: list[str] = []
        """Ids, from the top of the tree to its foot."""
        self.opening = False
        """Whether rows are being opened or closed by the search rather than by the user."""

    @property
    def active(self) -> bool:
        return bool(self._query.tests)

    def apply(self, query: Query) -> None:
        self._query = query
        self.refresh()

    def refresh(self) -> None:
        """Search again, after the document has changed."""
        if not self.active and not self._hidden and not self.matches:
            return
        nodes, problems = self._tree.nodes, self._tree.nodes.problems
        found: list[Row] = []
        kept: set[int] = set()
        if self.active:
            found = [row for row in nodes.rows() if self._query.matches(row.node, problems)]
        for row in found:
            above: Row | None = row
            while above is not None and above.key not in kept:
                kept.add(above.key)
                above = above.parent
        self.matches = [row.node.id for row in found]
        nodes.matches = frozenset(self.matches)
        self._tree.viewport().update()  # one signal for each row would take long
        self._hide({row.key: row for row in self._left_out(kept)} if self.active else {})
        self._open(kept)

    def _left_out(self, kept: set[int]) -> list[Row]:
        """The rows to hide: with one goes all that is below it."""
        left: list[Row] = []
        stack = list(self._tree.nodes.top_rows())
        while stack:
            row = stack.pop()
            if row.key in kept:
                stack += row.children
            else:
                left.append(row)
        return left

    def _hide(self, hidden: dict[int, Row]) -> None:
        tree, nodes = self._tree, self._tree.nodes
        before, self._hidden = self._hidden, hidden
        tree.setUpdatesEnabled(False)
        try:
            for rows, hide in ((before.items() - hidden.items(), False), (hidden.items() - before.items(), True)):
                for _, row in rows:
                    index = nodes.index_of_row(row) if nodes.holds(row) else None
                    if index is not None:
                        tree.setRowHidden(index.row(), index.parent(), hide)
        finally:
            tree.setUpdatesEnabled(True)

    def _open(self, kept: set[int]) -> None:
        """Open what is closed over a match; when the search ends, close it again unless it holds what is selected."""
        tree, nodes = self._tree, self._tree.nodes
        self.opening = True
        try:
            if self.active:
                stack = list(nodes.top_rows())
                while stack:
                    row = stack.pop()
                    inner = [child for child in row.children if child.key in kept]
                    index = nodes.index_of_row(row) if inner else None
                    if index is not None and not tree.isExpanded(index):
                        tree.expand(index)
                        self._opened.add(row.node.id)
                    stack += inner
            else:
                around = nodes.above(tree.selected)
                for node_id in self._opened - around:
                    tree.collapse(nodes.index_of(node_id))
                self._opened.clear()
        finally:
            self.opening = False
