import numpy as np
import pytest

from solidtree.gui.curves.active import ActiveCurve
from solidtree.model.document.document import Document
from solidtree.model.document.from_outlines import Revolve
from solidtree.model.document.outlines import BSpline, Path, Rectangle
from solidtree.model.document.primitives import Box
from solidtree.model.editing.session import Session

CORNERS = ((0.0, 0.0), (10.0, 0.0), (10.0, 5.0), (0.0, 5.0))
SQUARE = Path(name="Square", points=CORNERS, segments="MLLLl")
WAVE = BSpline(name="Wave", points=tuple((10.0 * i, float(i % 2)) for i in range(6)))


@pytest.fixture
def session() -> Session:
    session = Session(Document())
    session.do("insert", Box(name="Box"))
    session.do("insert", SQUARE.at(1, 2, 3))
    session.do("insert", WAVE)
    return session


@pytest.fixture
def active(session: Session, qapp) -> ActiveCurve:
    active = ActiveCurve(session)
    session.on_change(active.session_changed)
    return active


def id_of(session: Session, name: str) -> str:
    return next(root.id for root in session.document.roots if root.name == name)


def test_follows_the_selection(session: Session, active: ActiveCurve) -> None:
    heard = []
    active.changed.connect(lambda: heard.append(active.node))
    session.select([id_of(session, "Square")])
    assert active.node is session.document.profiles[0] and heard == [active.node]
    assert active.path is not None and np.array_equal(active.places, CORNERS)
    assert active.rows == [(0, 0), (0, 1), (0, 2), (0, 3)]
    assert np.array_equal(active.frame[:, 3], [1, 2, 3])
    session.select([id_of(session, "Wave")])
    assert active.by_points and len(active.places) == 6
    for others in ([id_of(session, "Box")], [root.id for root in session.document.profiles], []):
        session.select(others)
        assert active.node is None and active.path is None and not active.chosen
    assert heard[-1] is None


def test_outline_inside_a_solid_is_where_the_solid_has_it(session: Session, active: ActiveCurve) -> None:
    session.do("insert", Revolve(name="Ring", children=(SQUARE.at(20),)).at(z=7))
    inner = session.document.solids[-1].children[0]
    session.select([inner.id])
    assert active.node is inner
    assert np.allclose(active.frame @ [1, 2, 0, 1], [21, 0, 9])


def test_previews_are_followed_and_begin_from_what_stands(session: Session, active: ActiveCurve) -> None:
    session.select([id_of(session, "Square")])
    stands = session.document
    moved = ((0.0, 0.0), (12.0, 0.0), (10.0, 5.0), (0.0, 5.0))
    for width in (11.0, 12.0):
        assert active.preview("set_field", "points", (CORNERS[0], (width, 0.0), *CORNERS[2:]))
    assert np.array_equal(active.places, moved)
    assert active.document is stands and session.previewing
    active.cancel()
    assert session.document is stands and np.array_equal(active.places, CORNERS)


def test_choice_stays_while_the_counts_do(session: Session, active: ActiveCurve) -> None:
    session.select([id_of(session, "Square")])
    active.choose([(0, 1), (0, 3), (0, 4), (1, 0)])
    assert active.chosen == {(0, 1), (0, 3)}
    active.choose([(0, 0), (0, 1)], "toggle")
    assert active.chosen == {(0, 0), (0, 3)}
    active.choose([(0, 2)], "add")
    assert active.do("set_field", "points", (CORNERS[0], (11, 0), *CORNERS[2:]), label="Widen")
    assert active.chosen == {(0, 0), (0, 2), (0, 3)} and session.undo_label == "Widen"
    assert active.do("set_fields", points=CORNERS[:3], segments="MLLl")
    assert active.chosen == frozenset() and len(active.rows) == 3


def test_several_operations_are_one_step(session: Session, active: ActiveCurve) -> None:
    session.select([id_of(session, "Square")])
    before, steps = session.document, len(session.log)
    assert active.do_all([("set_field", ("even_odd", True), {}), ("rename", ("Plate",), {})], "Both")
    assert active.node is not None and active.node.name == "Plate" and len(session.log) == steps + 1
    assert session.log[-1].count("\n") == 1
    session.undo()
    assert session.document is before


def test_refusals_are_told_and_change_nothing(session: Session, active: ActiveCurve) -> None:
    session.select([id_of(session, "Square")])
    before, told = session.document, []
    active.refused.connect(told.append)
    assert not active.do("set_field", "radius", 3)
    assert not active.preview("set_field", "radius", 3)
    assert len(told) == 2 and session.document is before and not session.previewing


def test_outline_without_curves_is_none(session: Session, active: ActiveCurve) -> None:
    session.select([id_of(session, "Square")])
    assert active.do("set_field", "segments", "MLL")
    assert active.node is None
    session.undo()
    assert active.node is not None


def test_numbers_of_expressions_are_resolved(session: Session, active: ActiveCurve) -> None:
    session.do("set_parameter", "width", 4)
    session.do("insert", Rectangle(name="Plate"))
    session.do("set_field", id_of(session, "Plate"), "width", "2 * width")
    session.select([id_of(session, "Plate")])
    assert active.places[:, 0].max() == 8
    session.do("set_parameter", "width", 5)
    assert active.places[:, 0].max() == 10
