"""Lines of drawings: which edges, what is hidden by formula and by brute force, lines that coincide, hostile input."""

import itertools
import math
from pathlib import Path

import numpy as np
import pytest

from solidtree.model.drawing import edges
from solidtree.model.drawing.coincident import drawn_once
from solidtree.model.drawing.drawing import BORDER, FEATURE, INTERSECTION, OUTLINE, Lines, draw, polylines
from solidtree.model.drawing.edges import drawable_edges
from solidtree.model.drawing.hidden_lines import hidden_intervals, union_of_intervals
from solidtree.model.drawing.projection import Projection, looking, standard
from solidtree.model.drawing.scene import Scene, scene_of
from solidtree.model.drawing.surfaces import surfaces_of
from solidtree.model.exchange.meshes_in import read_any
from solidtree.model.script import box, cylinder, document_of, evaluate, intersection, sphere, torus, union
from solidtree.model.solid.results import evaluate_document

EXAMPLES = Path(__file__).parent.parent / "resources" / "examples"
ISO = math.sqrt(2 / 3)
"""Millimetres in an isometric picture to one along an axis."""


def scene(*solids, **named) -> Scene:
    return scene_of(evaluate(document_of(*solids, **named)))


def imported(folder, points, triangles) -> Scene:
    text = [f"OFF\n{len(points)} {len(triangles)} 0", *(" ".join(map(str, p)) for p in points)]
    text += ["3 " + " ".join(map(str, t)) for t in triangles]
    (folder / "mesh.off").write_text("\n".join(text) + "\n")
    return scene_of(evaluate_document(read_any(folder / "mesh.off")))


def drawn(solids: Scene, view: str = "iso", **options):
    return draw(solids, standard(view, solids.extent), faces=False, **options)


def counts(lines: Lines, kind=None) -> tuple[int, int]:
    """How many are visible and hidden."""
    chosen = np.ones(lines.count, bool) if kind is None else lines.kind == kind
    return int((chosen & ~lines.hidden).sum()), int((chosen & lines.hidden).sum())


def length(lines: Lines, hidden: bool) -> float:
    return float(lines.lengths[lines.hidden == hidden].sum())


def test_an_isometric_cube_has_nine_visible_and_three_hidden_edges():
    lines = drawn(scene(box(10))).lines
    assert counts(lines) == (9, 3)
    assert counts(lines, OUTLINE) == (6, 0)
    assert counts(lines, FEATURE) == (3, 3)
    assert lines.lengths.tolist() == 12 * [pytest.approx(10 * ISO)]
    assert counts(drawn(scene(box(10)), hidden=False).lines) == (9, 0)


def test_hidden_edges_that_coincide_with_visible_ones_vanish():
    for view in ("front", "back", "left", "right", "top", "bottom"):
        lines = drawn(scene(box(10, 20, 30)), view).lines
        assert counts(lines) == (4, 0), view


def test_a_ball_behind_a_plate_is_dashed_where_the_plate_covers_it():
    radius, tall = 10.0, 8.0
    ball = sphere(radius, tolerance=0.0005).at(0, 50, 0)
    lines = drawn(scene(box(60, 2, 2 * tall, centred=True), ball), "front").lines
    round_ = lines.layer == 1
    angle = math.asin(tall / radius)
    assert lines.lengths[round_ & lines.hidden].sum() == pytest.approx(4 * radius * angle, rel=1e-3)
    assert lines.lengths[round_ & ~lines.hidden].sum() == pytest.approx(4 * radius * (math.pi / 2 - angle), rel=1e-3)
    assert set(lines.kind[round_].tolist()) == {OUTLINE}


def test_a_hole_through_a_box_shows_ellipses_and_dashed_walls():
    drill = cylinder(radius=5, height=60, segments=256).at(20, 20, -10)
    found = drawn(scene(box(40, 40, 30) - drill))
    lines = found.lines
    of_drill = lines.layer == [layer.name.endswith("Cylinder") for layer in found.layers].index(True)
    middle = standard("iso", [[0, 0, 0], [40, 40, 30]]).picture([(20, 20, 30), (20, 20, 0)])[:, :2]
    # Every corner of the rims' picture lies on one of two ellipses: half axes r and r / √3.
    corners = lines.ends[of_drill].reshape(-1, 2)
    away = [np.hypot(*((corners - m) / (5, 5 / math.sqrt(3))).T) for m in middle]
    on_rim = (np.abs(np.array(away) - 1) < 2e-3).any(axis=0)
    assert on_rim.mean() > 0.9
    upper = np.abs(away[0] - 1).reshape(-1, 2).max(axis=1) < 2e-3
    assert upper.sum() > 200 and not lines.hidden[of_drill][upper].any()
    walls = lines.hidden[of_drill] & (lines.lengths[of_drill] > 5)
    assert lines.ends[of_drill][walls][:, 0, 0] - middle[0, 0] == pytest.approx([-5, 5], abs=2e-3) or (
        lines.ends[of_drill][walls][:, 0, 0] - middle[0, 0] == pytest.approx([5, -5], abs=2e-3)
    )


def test_two_crossing_boxes_have_an_edge_where_they_cross():
    """A pole through a plate: two squares of intersection, of which the upper one shows its near half."""
    for together in (True, False):
        plate, pole = box(30, 30, 4), box(10, 10, 40).at(10, 10, -20)
        lines = drawn(scene(union(plate, pole)) if together else scene(plate=plate, pole=pole)).lines
        crossing = lines.chosen((lines.kind == INTERSECTION) & ~lines.hidden)
        assert crossing.lengths.tolist() == 2 * [pytest.approx(10 * ISO)]


def test_touching_solids_have_a_line_between_them_and_leaves_of_one_solid_have_none():
    left, right = box(10), box(10).at(10, 0, 0)
    lines = drawn(scene(union(left, right)), "front").lines
    assert lines.lengths.sum() == pytest.approx(60) and not (lines.kind == INTERSECTION).any()
    lines = drawn(scene(left=left, right=right), "front").lines
    assert counts(lines, INTERSECTION) == (1, 0)
    assert lines.lengths.sum() == pytest.approx(70)


def test_layers_are_named_after_solid_and_node_and_begin_with_the_solids_path():
    holes = [cylinder(radius=1, height=30).at(x, 5, -5).named("hole") for x in (3, 7)]
    body = (box(10).named("block") - union(*holes)).coloured("red")
    found = drawn(scene(part=body, lid=box(10).at(0, 0, 10)))
    assert [layer.name for layer in found.layers] == ["part / block", "part / hole", "part / hole 2", "lid"]
    assert [layer.colour for layer in found.layers] == [(255, 0, 0)] * 3 + [None]
    assert all(isinstance(step, str) for layer in found.layers for step in layer.path)
    assert len({layer.path for layer in found.layers}) == 4


def test_joints_of_a_faceted_surface_are_no_lines():
    lines = drawn(scene(cylinder(radius=10, height=20, segments=100)), "front").lines
    assert counts(lines) == (4, 0)  # the rectangle around it
    assert lines.lengths.sum() == pytest.approx(80, rel=1e-3)


def brute_force(view: Projection, triangles, points, size: float, slack: float = 1e-6):
    """(n,) 1 where a ray from a point to the eye meets a triangle, 0 where not, -1 where it passes near a border."""
    a, e1, e2 = triangles[:, 0], triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]
    normal = np.cross(e1, e2)
    answer = np.empty(len(points), int)
    for place in range(0, len(points), 500):
        p = points[place : place + 500]
        ray = np.broadcast_to(view.axes[2], p.shape) if view.parallel else view.eye - p
        far = np.linalg.norm(ray, axis=1)
        down = -(ray @ normal.T)
        arm = p[:, None] - a
        sideways = np.cross(arm, ray[:, None])
        with np.errstate(all="ignore"):
            share = np.einsum("ntk,tk->nt", arm, normal) / down
            u = np.einsum("ntk,tk->nt", sideways, e2) / down
            v = -np.einsum("ntk,tk->nt", sideways, e1) / down
            inner = np.minimum(np.minimum(u, v), 1 - u - v)
        flat = np.abs(down) <= 1e-12 * np.linalg.norm(normal, axis=1) * far[:, None]
        before = ~flat & (share < (np.inf if view.parallel else 1.0))
        away = share * far[:, None]
        hit = (before & (inner > slack) & (away > 3 * slack * size)).any(axis=1)
        near = (before & (inner > -slack) & (away > 0.3 * slack * size)).any(axis=1)
        answer[place : place + 500] = np.where(hit, 1, np.where(near, -1, 0))
    return answer


def menger(level: int):
    """A sponge of side 3^level."""
    side = 3**level
    bars = []
    for depth in range(level):
        step = 3 ** (level - 1 - depth)
        bars += [
            box(step, step, side + 2).at((3 * i + 1) * step, (3 * j + 1) * step, -1)
            for i, j in itertools.product(range(3**depth), repeat=2)
        ]
    bar = union(*bars)
    return box(side) - union(bar, bar.turned(x=90).at(0, side, 0), bar.turned(y=90).at(0, 0, side))


def crossing_parts():
    rng = np.random.default_rng(5)
    parts = [
        box(10, 14, 7).turned(x=float(rng.uniform(0, 90)), y=float(rng.uniform(0, 90))).at(*map(float, place))
        for place in rng.uniform(-8, 8, (6, 3))
    ]
    return scene(*parts, sphere(6).at(2, 1, 0))


MODELS = {
    "plate": lambda: scene(
        box(50, 40, 5)
        - union(*(cylinder(radius=2, height=9).at(5 + 8 * i, 5 + 8 * j, -2) for i in range(5) for j in range(4)))
    ),
    "sponge": lambda: scene(menger(2)),
    "torus": lambda: scene(torus(10, 3)),
    "parts": crossing_parts,
}


def views_of(extent) -> list[Projection]:
    middle, size = extent.mean(axis=0), float(np.linalg.norm(np.ptp(extent, axis=0)))
    return [
        standard("iso", extent),
        looking(middle + size * np.array([0.3, -0.8, 0.45]), middle),
        looking(middle + size * np.array([0.5, -0.9, 0.6]), middle, perspective=50, aspect=None),
        looking(middle + size * np.array([0.05, 0.12, 0.03]), middle - size * np.array([0.2, -0.1, 0]), perspective=80),
    ]


@pytest.mark.parametrize("name", MODELS)
def test_random_points_of_edges_agree_with_rays_to_the_eye(name):
    solids = MODELS[name]()
    rng = np.random.default_rng(11)
    faces = solids.faces()
    triangles = faces.points[faces.corners.reshape(-1, 3)]
    for view in views_of(solids.extent):
        surfaces = surfaces_of(solids, view)
        edges = drawable_edges(solids, surfaces)
        item, hidden = hidden_intervals(edges, surfaces)
        along = np.hypot(*(edges.ends[:, 1, :2] - edges.ends[:, 0, :2]).T)
        edge, share = rng.choice(edges.count, 750, p=along / along.sum()), rng.random(750)
        picture = edges.ends[edge, 0] + share[:, None] * (edges.ends[edge, 1] - edges.ends[edge, 0])
        if not view.parallel:  # back from the picture
            picture = picture * (view.focal / (view.focal + picture[:, 2:]))
        rays = brute_force(view, triangles, picture @ view.axes + view.target, faces.size)
        size = float(np.ptp(edges.ends[:, :, :2].reshape(-1, 2), axis=0).max())
        inside = (item[:, None] == edge) & (hidden[:, :1] <= share) & (share <= hidden[:, 1:])
        at_end = (item[:, None, None] == edge) & (np.abs(hidden[:, :, None] - share) * along[edge] < 1e-5 * size)
        sure = (rays >= 0) & ~at_end.any(axis=(0, 1))
        assert sure.sum() > 400
        assert rays[sure].tolist() == inside.any(axis=0)[sure].tolist()
        assert 0 < rays[sure].sum() < sure.sum()


def test_no_line_of_a_drawing_covers_another():
    for solids in (scene(menger(2)), crossing_parts()):
        for view in ("iso", "front"):
            lines = drawn(solids, view).lines
            rng = np.random.default_rng(2)
            line = rng.choice(lines.count, 500)
            point = lines.ends[line, 0] + rng.uniform(0.01, 0.99, (500, 1)) * (
                lines.ends[line, 1] - lines.ends[line, 0]
            )
            way = lines.ends[:, 1] - lines.ends[:, 0]
            arm = point[:, None] - lines.ends[:, 0]
            share = (arm * way).sum(axis=2) / (way * way).sum(axis=1)
            off = np.abs(arm[..., 0] * way[:, 1] - arm[..., 1] * way[:, 0]) / lines.lengths
            unit = way / lines.lengths[:, None]
            turned = np.abs(unit[line, None, 0] * unit[:, 1] - unit[line, None, 1] * unit[:, 0])
            covering = (off < 1e-6) & (turned < 1e-6) & (share > 0) & (share < 1)
            assert (covering.sum(axis=1) == 1).all()


def test_pieces_in_line_are_joined_and_the_visible_ones_win():
    ends = np.array([[[0, 0], [4, 4]], [[6, 6], [3, 3]], [[2, 2], [9, 9]], [[0, 1], [4, 5]]], float)
    kind = np.array([FEATURE, FEATURE, OUTLINE, FEATURE], np.int8)
    hidden = np.array([False, False, True, False])
    lines = drawn_once(Lines(ends, kind, hidden, np.zeros(4, np.int32)))
    found = {(tuple(map(tuple, sorted(e.tolist()))), h) for e, h in zip(lines.ends, lines.hidden.tolist(), strict=True)}
    assert found == {
        (((0, 0), (6, 6)), False),
        (((6, 6), (9, 9)), True),
        (((0, 1), (4, 5)), False),
    }


def test_intervals_are_joined_per_item():
    item = np.array([1, 0, 1, 1, 0])
    spans = np.array([[0.5, 0.9], [0.0, 0.3], [0.1, 0.2], [0.15, 0.5], [0.4, 0.45]])
    of, joined = union_of_intervals(item, spans)
    assert of.tolist() == [0, 0, 1] and joined.tolist() == [[0.0, 0.3], [0.4, 0.45], [0.1, 0.9]]


def test_polylines_keep_every_line_and_close_round_outlines():
    lines = drawn(scene(sphere(10)), "front").lines
    (outline,) = polylines(lines)
    assert outline.closed and len(outline.points) == lines.count + 1
    lines = drawn(scene(menger(2))).lines
    strings = polylines(lines)
    total = sum(np.hypot(*np.diff(string.points, axis=0).T).sum() for string in strings)
    assert total == pytest.approx(lines.lengths.sum())
    assert sum(len(string.points) - 1 for string in strings) == lines.count > len(strings)


def test_the_border_of_an_open_surface_is_drawn_and_its_inside_hides_as_well(tmp_path):
    corners = list(itertools.product((0, 10), repeat=3))
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4)]  # the lid is missing
    lines = drawn(imported(tmp_path, corners, [t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))])).lines
    assert length(lines.chosen(lines.kind == BORDER), False) == pytest.approx(40 * ISO)
    # Of the inner upright edge and the two below, what the front walls leave to be seen: nothing of the lower two.
    assert length(lines, False) + length(lines, True) == pytest.approx(120 * ISO)
    assert counts(lines, FEATURE)[1] == 2


@pytest.mark.parametrize(
    ("points", "triangles", "visible"),
    [
        ([(0, 0, 0), (10, 0, 0), (0, 10, 0)], [(0, 1, 2)], 20 + math.sqrt(200)),
        ([(0, 0, 0), (10, 0, 0), (0, 10, 0)], [(0, 1, 2), (0, 1, 2), (2, 1, 0)], 20 + math.sqrt(200)),
        ([(0, 0, 0), (10, 0, 0), (0, 10, 0), (5, 0, 0)], [(0, 1, 2), (0, 1, 3), (0, 0, 2)], 20 + math.sqrt(200)),
        ([(0, 0, 0), (10, 0, 0), (10, 10, 0), (0, 10, 0)], [(0, 1, 2), (0, 3, 2)], 40),
    ],
    ids=["one", "duplicates", "degenerate", "one the wrong way round"],
)
def test_hostile_triangles_are_drawn_once(tmp_path, points, triangles, visible):
    lines = drawn(imported(tmp_path, points, triangles), "top").lines
    assert length(lines, False) == pytest.approx(visible) and not lines.hidden.any()


def test_three_blades_that_overlap_in_a_circle_hide_one_another(tmp_path):
    """Each goes over the next one and under the one before."""
    blade = np.array([(-6, -3, 1), (9, -3.2, -1), (9, -2.2, -1)])
    turn = np.array([[-0.5, -math.sqrt(0.75), 0], [math.sqrt(0.75), -0.5, 0], [0, 0, 1]])
    points = np.concatenate([blade, blade @ turn.T, blade @ turn])
    solids = imported(tmp_path, points.tolist(), [(0, 1, 2), (3, 4, 5), (6, 7, 8)])
    hidden = drawn(solids, "top").lines
    hidden = hidden.chosen(hidden.hidden)
    middles = hidden.ends.mean(axis=1) - standard("top", solids.extent).picture([(0, 0, 0)])[0, :2]
    around = np.sort(np.degrees(np.arctan2(middles[:, 1], middles[:, 0])) % 120)
    assert hidden.count == 6  # both long sides of each go under the one before
    assert around.reshape(2, 3).std(axis=1) == pytest.approx([0, 0], abs=1e-6)


def test_an_empty_scene_and_solids_behind_the_eye_have_no_lines():
    empty = scene_of(evaluate_document(document_of()))
    assert draw(empty, standard("iso", empty.extent)).empty
    behind = draw(scene(box(10)), looking((50, 50, 50), (100, 100, 100), perspective=40))
    assert behind.empty and behind.bounds.tolist() == [[0, 0], [0, 0]]
    nothing = draw(scene(intersection(box(1), box(1).at(5, 5, 5))), standard("iso"))
    assert nothing.empty


def test_progress_goes_from_nothing_to_all_and_may_stop_the_drawing():
    told: list[float] = []
    draw(scene(menger(2)), standard("iso"), progress=lambda label, share: told.append(share))
    assert told[0] == 0.0 and told[-1] == 1.0 and told == sorted(told) and len(told) > 8

    class Stopped(Exception):
        pass

    def stop(label, share):
        if share > 0.5:
            raise Stopped

    with pytest.raises(Stopped):
        draw(scene(menger(2)), standard("iso"), progress=stop)


def test_outlines_do_not_run_to_and_fro_on_saddles_and_stay_what_they_are_elsewhere(monkeypatch):
    drill = scene_of(evaluate_document(read_any(EXAMPLES / "drill_bit.solidtree"), 0.01))
    bored = scene(sphere(10, segments=64), plate=box(40, 40, 20).at(30, 0, 0) - cylinder(8, 30).at(50, 20, -5))

    def outlines(solids):
        lines = drawn(solids).lines
        return lines.chosen(lines.kind == OUTLINE)

    after = [outlines(solids) for solids in (drill, bored)]
    monkeypatch.setattr(edges, "_without_zigzags", lambda surfaces, *_: surfaces.facing[surfaces.faces.plane_of])
    before = [outlines(solids) for solids in (drill, bored)]
    assert length(after[0], True) < 0.9 * length(before[0], True)
    assert length(after[0], False) < length(before[0], False)
    assert np.array_equal(after[1].ends, before[1].ends)
