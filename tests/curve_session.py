"""Sessions with an outline or more, and what tests ask of them."""

import pytest

from solidtree.model.document.document import Document
from solidtree.model.document.errors import Refusal
from solidtree.model.document.outlines import BSpline
from solidtree.model.document.tree import find
from solidtree.model.editing.session import Session
from solidtree.model.operations.curves.addressing import plain_values
from solidtree.model.operations.curves.deviations import deviation
from solidtree.model.outline.paths import own_path

LEAF = "M 0 0 C 10 0 20 10 20 20 C 20 30 10 40 0 30 L -10 10 Q -8 0 0 0 Z"


def session(*profiles, solids=(), **more):
    return Session(Document(solids=solids, profiles=profiles, **more))


def one(node, **more):
    """A session with one outline, n1."""
    return session(node.with_(id="n1", name=node.name or node.title), **more)


def curves(work, node_id="n1"):
    return own_path(plain_values(work.document, find(work.document, node_id)))


def contour(work, number=0):
    return curves(work).contours[number]


def moved_by(before, work, node_id="n1"):
    return deviation(before, plain_values(work.document, find(work.document, node_id)))


def refused(work, words, *arguments, **more):
    before = work.document
    with pytest.raises(Refusal, match=words):
        work.do(*arguments, **more)
    assert work.document is before


OPEN = BSpline(points=((0, 0), (5, 9), (12, 1), (20, 4), (30, 0), (33, 8)))
RATIONAL = OPEN.with_(weights=(1, 2, 1, 0.5, 1, 1), knots=(0, 0, 0, 0, 0.3, 0.3, 1, 1, 1, 1))
CLOSED = OPEN.with_(closed=True)
OWN_TURN = OPEN.with_(closed=True, degree=2, knots=(2, 3, 3.5, 5, 7, 8, 10), weights=(1, 2, 1, 0.5, 1, 1))
SPLINES = [OPEN, RATIONAL, CLOSED, OWN_TURN]
