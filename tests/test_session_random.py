"""Two thousand edits drawn at random, sound and unsound: the document stays valid, the way back is the very same."""

import itertools
import random
from collections import Counter

import pytest
from replay import replayed

from solidtree.model import script
from solidtree.model.document.errors import Refusal
from solidtree.model.document.from_outlines import FROM_OUTLINES
from solidtree.model.document.nodes import Instance, field_specs
from solidtree.model.document.outlines import OUTLINES, is_outline
from solidtree.model.document.resolve import resolve
from solidtree.model.document.table import from_table, same_document, to_table
from solidtree.model.document.tree import find, walk
from solidtree.model.editing.session import Session
from solidtree.model.operations.operations import OPERATIONS
from solidtree.model.operations.parameters import names_of
from solidtree.model.operations.pasting import clip
from solidtree.model.operations.sizing import field_of, size_handles, sized
from solidtree.model.script import box, document_of, parameter, sphere, union
from solidtree.model.solid.evaluate import Evaluator
from solidtree.model.solid.outlines.profiles import profile_of

WITH_KEYWORDS = ("set_fields", "set_section", "make_solid", "engrave", "add_material", "set_material", "set_mapping",
                 "add_light", "set_light", "displace_each")  # fmt: skip
DRAWN, SEEDS = 1500, 4  # of which a good third is refused: more than two thousand edits in all


def random_leaf(draw):
    names = ["width", "depth", "gone", "width +", "1 / 0", "nan"]
    number = draw.choice([1, 2.5, -3, 0, draw.choice(names), parameter("fresh", 7)])
    kinds = [lambda: box(number), lambda: sphere(number), lambda: script.rectangle(number), script.halfspace,
             lambda: script.extrude(script.circle(number)), lambda: script.circle(number),
             lambda: script.path([("move", (0, number)), ("line", (9, 0)), ("cubic", (9, 5), (5, 9), (0, 9))]),
             lambda: script.bezier([(0, 0), (0, number), (5, 5)], closed=draw.random() < 0.5),
             lambda: script.bspline([(0, 0), (9, number), (9, 9), (0, 9)], closed=draw.random() < 0.7),
             lambda: script.sweep(script.circle(number), script.path([("move", (0, 0, 0)), ("line", (0, 1, 9))])),
             lambda: script.lettering(draw.choice(["Ag", "", "a\nש"]), number),
             lambda: script.text_on_path(script.lettering("Ag"), script.bezier([(0, 0), (number, 9), (20, 0)]), number),
             lambda: script.stencil(script.lettering("A8"), number),
             lambda: script.loft(script.rectangle(), script.circle(number).at(0, 0, 9)),
             lambda: script.pipe(script.bezier([(0, 0), (9, 9), (20, 0)]), number),
             lambda: script.relief(width=number), lambda: script.displace(box(number), height=number),
             lambda: script.instance(f"n{draw.randrange(40)}")]  # fmt: skip
    return draw.choice(kinds)()


def random_curve(draw):
    return draw.choice([
        script.path("M 0 0 H 9 C 12 3 12 6 9 9 Q 4 12 0 9 Z M 2 2 H 4 V 4 Z"),
        script.path("M 0 0 C 3 5 6 5 9 0 S 15 -5 18 0"),
        script.path([("move", (0, 0)), ("line", ("width", 2)), ("line", (5, "width + 4"))]),
        script.bspline([(0, 0), (5, 9), (12, 1), (20, 4), (30, 0)], closed=draw.choice([True, False])),
        script.bezier([(0, 0), (5, 9), (12, 1)]), script.circle(4), script.polygon([(0, 0), (9, 0), (4, 8)]),
    ])  # fmt: skip


def random_curve_step(draw, document):
    """An operation on an outline, with places that it may have."""
    outlines = [node for node in walk(*document.roots) if isinstance(node, OUTLINES)]
    if not outlines or draw.random() < 0.2:
        return "insert", random_curve(draw)
    node = draw.choice(outlines).id
    place = lambda: (draw.choice([0, 0, 0, 1]), draw.randrange(6))  # noqa: E731
    some = lambda: [place() for _ in range(draw.randrange(1, 4))]  # noqa: E731
    rows = draw.sample(range(6), draw.randrange(1, 4))
    by = draw.choice([(1, 2), (0, -3.5), (0, 0), (1, 2, 3), ("width", 1), None])
    share = draw.choice([0.25, 0.5, 0.7, 0, 2, "x"])
    axis, count = draw.choice("xyz"), draw.choice([1, 2, 0, 40])
    return draw.choice([
        ("convert_to_path", [node]), ("convert_to_bspline", node), ("move_nodes", node, some(), by),
        ("place_nodes", node, [place()], [by]), ("move_handle", node, place(), by),
        ("set_handle", node, place(), draw.choice([None, 2, -1]), draw.choice([None, 30])),
        ("set_joints", node, some(), draw.choice(["cusp", "smooth", "symmetric", "auto", "odd"])),
        ("insert_node", node, *place(), share), ("delete_nodes", node, some(), draw.choice([True, False])),
        ("transform_nodes", node, some(), [(0, -1, 3), (1, 0, 0)]), ("align_nodes", node, some(), axis, "max"),
        ("distribute_nodes", node, some(), axis), ("mirror_outline", node, axis), ("smooth_joints", node, some()),
        ("harmonise_joints", node, [place()]), ("match_curvature", node, [place()]), ("break_path", node, some()),
        ("join_nodes", node, place(), place(), draw.choice([True, False])), ("close_contours", node),
        ("reverse_contours", node, draw.choice([None, [0], [3]])), ("split_outline", node),
        ("set_segments", node, some(), draw.choice(["line", "quad", "cubic", "arc"])),
        ("add_contour", node, draw.choice(["M 5 5 h 3 v 3 z", "M 0 0", "nonsense"])), ("move_points", node, rows, by),
        ("place_points", node, rows[:1], [by]), ("insert_point", node, rows[0], by), ("delete_points", node, rows[:1]),
        ("set_weights", node, rows, draw.choice([2, 1, 0, "width"])), ("set_knot", node, rows[0], share),
        ("insert_knot", node, share), ("remove_knot", node, share), ("refine_knots", node),
        ("elevate_degree", node, count), ("reduce_degree", node, count),
    ])  # fmt: skip


def random_tree(draw):
    node = random_leaf(draw)
    for _ in range(draw.randrange(4)):
        node = draw.choice([script.union, script.difference, script.mirror, script.linear_array, script.extrude])(node)
        node = draw.choice(
            [node, node.at(1), node.named("x"), node.scaled(draw.choice([2, 0, "width"])), node.hidden()]
        )
    return node


def random_step(draw, document):
    """An operation and its arguments: mostly ones that make sense, else anything."""
    if draw.random() < 0.3:
        return random_curve_step(draw, document)
    sound = draw.random() < 0.6
    pick = lambda good, bad=(): draw.choice([*good] if sound else [*good, *bad])  # noqa: E731
    ids = [node.id for node in walk(*document.roots)]
    ids = ids if sound and ids else [*ids, "gone"]
    one = lambda: draw.choice(ids)  # noqa: E731
    solid = lambda: draw.choice([root.id for root in document.solids] or ids) if sound else one()  # noqa: E731
    many = lambda: draw.choices(ids, k=draw.randrange(1, 4) if sound else draw.randrange(4))  # noqa: E731
    flats = [node.id for node in walk(*document.roots) if is_outline(node, document.definitions)]
    some_outlines = lambda: draw.choices(flats, k=draw.choice([1, 2])) if flats else many()  # noqa: E731
    place = pick([None, 0, 1], [2, -1, 99])
    number = pick([1, 2.5, "width"], [0, -4, "depth * 2", "gone", "1 +", float("nan"), float("inf"), None, "é"])
    kind = pick(["union", "difference", "intersection", "hull", "linear_array", "mirror"],
                ["minkowski", "polar_array", "extrude", "revolve", "box", "instance", "nonsense"])  # fmt: skip
    of_field = {node.id: [spec.name for spec in field_specs(type(node))] for node in walk(*document.roots)}
    sizes = [i for i, names in of_field.items() if "radius" in names or "height" in names]
    sized_id = draw.choice(sizes) if sizes and sound else one()
    field = pick([name for name in ("radius", "height") if name in of_field.get(sized_id, ())] or ["radius"],
                 ["size", "count", "point", "keep", "definition", "points", "colour", "id"])  # fmt: skip
    value = pick([number], [(1, number, 3), True, None, one(), [(0, 0), (1, number), (0, 1)], "x"])
    step = pick([lambda: script.at(number), lambda: script.turned(z=number), lambda: script.scaled(number)],
                [script.mirrored, lambda: 5])  # fmt: skip
    name = pick(["width", "depth"], ["other", "if", "sin", "2x", "fresh"])
    vector = pick([(1, 0, 0), (0, 2, -1), (4, "width", 1)], [(0, 0, 0), (1, 2), "z", None, (float("nan"), 0, 0)])
    label = pick(["a", "b"], ["", "x" * 300])
    font, glyphs = pick(["DejaVu Sans", "copy"], ["gone", "", None]), pick(["A", ["g", "A"]], ["gone", [], None])
    glyph = {"advance": number, "points": [(0, 0), (0, 500), (900, number)], "segments": draw.choice(["MLLl", "MLL"])}
    changes = [
        lambda: ("turn", many(), draw.choice(["x", "z", vector]), number),
        lambda: ("turn", many(), "y", 30, vector),
        lambda: ("set_clearance", number),
        lambda: ("check_pair", solid(), solid(), *draw.choice([(), (0.5,), (None, True), (number,)])),
        lambda: ("scale", many(), draw.choice([2, 0.5, number])),
        lambda: ("shift", {one(): vector, one(): (1, 0, 0)}),
        lambda: ("set_fields", sized_id, vector, {field: value}),
        lambda: ("copy_to", many(), draw.choice([None, one()]), place),
        lambda: ("paste", clip(document, ids[:1]) if len(ids) > 1 else document, draw.choice([None, one()]), place),
        lambda: ("reorder", many(), draw.choice([-2, -1, 1, 5])),
        lambda: ("promote", one()),
        *(lambda: ("make_solid", draw.choice(["extrude", "revolve", "sweep", "loft", "pipe"]), some_outlines()),) * 3,
        lambda: ("set_text_on_path", some_outlines()),
        lambda: ("make_stencils", some_outlines()),
        lambda: ("make_solid", draw.choice(["extrude", "pipe", "box"]), many(), {"tolerance": number}),
        lambda: (
            "bend_segment",
            draw.choice(flats or ids),
            draw.choice([0, 7]),
            draw.choice([0, 1, -1]),
            draw.choice([0.5, number]),
            draw.choice([(1, -2), vector]),
        ),
        lambda: ("displace_each", many(), draw.choice(["", "ab" * 32]), {"height": number}),
        lambda: ("swap", one(), one()),
        lambda: ("rename_each", many(), draw.choice(["part #", "", "same"])),
        lambda: ("reorder_parameter", name, draw.choice([0, 1, -1, 9])),
        lambda: ("set_parameters", {name: number, "width": 4}),
        lambda: ("save_set", label),
        lambda: ("apply_set", label),
        lambda: ("rename_set", label, draw.choice(["a", "b", ""])),
        lambda: ("delete_set", label),
        lambda: ("put_sets", [(label, [(name, number)])]),
        lambda: ("add_section", label, vector, draw.choice([vector, (0, 0, -1)])),
        lambda: ("set_section", label, {"point": vector}),
        lambda: ("set_section", label, {"active": draw.choice([True, False, 1])}),
        lambda: ("rename_section", label, draw.choice(["a", "b", ""])),
        lambda: ("delete_section", label),
        lambda: (
            "engrave",
            draw.choice(flats or ids),
            one(),
            *([step()] if draw.random() < 0.5 else []),
            {"depth": number, "raised": draw.choice([True, False]), "radius": draw.choice([None, 9])},
        ),
        lambda: ("add_material", label, draw.choice([None, "Brass", "gone"]), {"opacity": draw.choice([0.5, number])}),
        lambda: ("set_material", label, {draw.choice(["colour", "shininess", "texture", "gone"]): value}),
        lambda: ("rename_material", label, draw.choice(["a", "b", ""])),
        lambda: ("delete_material", label),
        lambda: ("use_material", many(), draw.choice([None, label])),
        lambda: ("set_mapping", many(), draw.choice([None, "box", "gone"]), {"size": draw.choice([(5, 5), vector])}),
        lambda: ("set_mapping", many()),
        lambda: ("add_light", label, draw.choice(["point", "ambient", "gone"]), {"position": vector}),
        lambda: ("set_light", label, {"direction": vector, "active": draw.choice([True, False])}),
        lambda: ("rename_light", label, draw.choice(["a", "b", ""])),
        lambda: ("delete_light", label),
        lambda: ("set_shading", draw.choice([None, "flat", "gone"])),
        lambda: (draw.choice(["carry_font", "release_font"]), font),
        lambda: ("copy_font", font, draw.choice(["copy", "GFS Didot", ""])),
        lambda: ("edit_glyphs", font, {draw.choice(["A", "g", "gone"]): glyph}),
        lambda: ("transform_glyphs", font, glyphs, draw.choice([[(1, 0.2, 0), (0, 1, 9)], [(1, 1)], None])),
        lambda: ("reset_glyphs", font, glyphs),
    ]
    return draw.choice(
        [
            *changes,
            lambda: ("insert", random_tree(draw), draw.choice([None, one()]), place),
            lambda: ("insert", random_tree(draw)),
            lambda: ("replace", one(), random_tree(draw)),
            lambda: ("insert_document", draw.choice([document_of(union(box(parameter("depth", 2)), sphere(1))), None])),
            lambda: ("delete", many()),
            lambda: ("rename", one(), draw.choice(["", "a", "b c", "Union", "\n"])),
            lambda: ("set_field", sized_id, field, value),
            lambda: ("place", one(), *(step() for _ in range(draw.randrange(3)))),
            lambda: ("move", many(), number, draw.choice([0, 1])),
            lambda: ("set_colour", many(), draw.choice(["red", None, "#123", "nope"])),
            lambda: ("set_visible", many(), draw.choice([True, False])),
            lambda: ("set_note", one(), draw.choice(["", "words"])),
            lambda: ("combine", kind, many()),
            lambda: ("dissolve", one()),
            lambda: ("change_kind", one(), kind),
            lambda: ("relocate", many(), draw.choice([None, one()]), place),
            lambda: ("duplicate", many()),
            lambda: ("link", one()),
            lambda: ("unlink", one()),
            lambda: ("set_parameter", name, number),
            lambda: ("rename_parameter", name, draw.choice(["width", "depth", "other", "9"])),
            lambda: ("delete_parameter", name),
        ]
    )()


def call(step):
    """Arguments and keywords of a drawn step; a dictionary that comes last may stand for keywords."""
    name, *arguments = step
    if name in WITH_KEYWORDS and isinstance(arguments[-1], dict):
        return name, arguments[:-1], arguments[-1]
    return name, arguments, {}


def handle_drag(draw, session):
    """What a drag of a handle does: some documents on the way, then one step of the history, or none."""
    start = session.document
    node = find(start, draw.choice([node.id for node in walk(*start.roots)] or ["gone"]))
    handles = [handle for handle in size_handles(node) if isinstance(field_of(node, handle), float)]
    way = [round(draw.uniform(-3, 12), 1) for _ in range(3)]
    if handles and draw.random() < 0.5:
        handle = draw.choice(handles)
        calls = [("set_fields", (node.id,), sized(node, handle, value, value)) for value in way]
    else:
        calls = [
            draw.choice([("move", ([node.id], value), {}), ("turn", ([node.id], "z", value), {})]) for value in way
        ]
    for name, arguments, keywords in calls:
        session.preview(OPERATIONS[name](start, *arguments, **keywords))
    if draw.random() < 0.3:
        session.cancel()
        assert session.document is start
    else:
        name, arguments, keywords = calls[-1]
        session.do(name, *arguments, **keywords)


def check(document):
    """What holds for every document, whatever was done to it."""
    table = to_table(document)  # refuses doubled ids
    assert to_table(from_table(table)) == table
    names = [root.name for root in document.standing]
    assert len(set(names)) == len(names) and all(names)
    known = {parameter.name for parameter in document.parameters}
    definitions = {root.id for root in document.definitions}
    for node in walk(*document.roots):
        fewest, most = type(node).operands
        assert isinstance(node, Instance) or len(node.children) >= fewest
        assert most is None or len(node.children) <= most
        flat = isinstance(node, FROM_OUTLINES) or is_outline(node, document.definitions)
        assert all(is_outline(child, document.definitions) == flat for child in node.children)
        assert names_of(node.expressions()) <= known
        assert not isinstance(node, Instance) or node.definition in definitions
    for one in document.sets:
        assert {name for name, _ in one.values} <= known
    assert sum(section.active for section in document.sections) <= 6
    worn = {node.material for node in walk(*document.roots)} - {""}
    assert worn <= {material.name for material in document.materials}
    assert not any(is_outline(root, document.definitions) for root in document.solids)
    assert all(is_outline(root, document.definitions) for root in document.profiles)
    assert len(resolve(document).standing) == len(document.standing)


@pytest.mark.parametrize("seed", range(SEEDS))
def test_random_edits_leave_a_valid_document_and_the_very_way_back(seed):
    draw = random.Random(seed)
    start = document_of(
        union(box("width"), sphere(2)),
        script.mirror(box(parameter("width", 3)).at(5)),
        script.extrude(script.rectangle()),
    )
    session, evaluator = Session(start, depth=10_000), Evaluator()
    told = []
    session.on_change(lambda before, after: told.append((before, after)))
    done, refused, dragged, back = Counter(), 0, 0, 0
    for count in range(DRAWN):
        before, log = session.document, session.log
        sort = draw.random()
        try:
            if sort < 0.08:
                back += session.undo()
            elif sort < 0.14:
                back += session.redo()
            elif sort < 0.18:
                session.select(draw.choices([node.id for node in walk(*before.roots)] or ["n1"], k=2))
            elif sort < 0.3:
                handle_drag(draw, session)
                dragged += 1
            else:
                name, arguments, keywords = call(random_step(draw, before))
                session.do(name, *arguments, **keywords)
                done[name] += session.document is not before
        except Refusal as refusal:
            refused += 1
            session.cancel()
            assert session.document is before and session.log == log
            assert 5 < len(str(refusal)) < 400 and "\n" not in str(refusal)
        check(session.document)
        if count % 25 == 0:
            shown = resolve(session.document)
            for root in shown.solids:
                entry = evaluator.evaluate(root, 1.0)
                assert entry.solid is not None or entry.problems
            for root in shown.profiles:
                path, problems = profile_of(root)
                assert path is not None or problems
        if sum(1 for _ in walk(*session.document.roots)) > 60:
            session.do("delete", [*(node.id for node in session.document.solids[2:]),
                                  *(node.id for node in session.document.profiles[3:])])  # fmt: skip
    while session.redo():
        pass
    last = session.document
    assert same_document(replayed(session.log, start), last)
    while session.undo():
        pass
    assert session.document is start and session.log == ()
    while session.redo():
        pass
    assert session.document is last
    assert done.total() + dragged + back > 500 and len(+done) > 30 and refused > 100
    for (_, after), (before, _) in itertools.pairwise(told):
        assert after.document is before.document, "a change was not told"
