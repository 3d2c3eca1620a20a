"""Moving parts: further faces are put into the tree of those that stay, instead of building all of it anew.

Going back is free, because the tree of what stays is never changed. (Chrysanthou and Slater 1992 take the faces of the
moving part out again.)
"""

from __future__ import annotations

from . import native
from .build import build
from .faces import Faces, joined
from .tree import Tree


class Moving:
    """The tree of what stays, and what it is with something put in."""

    def __init__(self, tree: Tree) -> None:
        self.tree = tree

    @property
    def quick(self) -> bool:
        """Whether faces are put in; without the compiled extension everything is built anew each time."""
        return native.available()

    def with_faces(self, faces: Faces) -> Tree:
        """The tree of what stays and of `faces`; its own `faces` are those of the first, then those of the second.

        Where it is quick, points and fragments begin with those of the tree of what stays, unchanged; then come the
        points of `faces` and those of new cuts. Fragments that had to be cut again, or that share a node with arrivals,
        stay there too, without a node that owns them. Raises as `build.build`.
        """
        if not faces.count:
            return self.tree
        if self.tree.root < 0 or not native.available():
            return build(joined((self.tree.faces, faces)))
        return native.insert(self.tree, faces)
