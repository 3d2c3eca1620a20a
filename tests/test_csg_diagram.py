"""The CSG diagram: nothing overlaps, operands keep their order, the work grows with the nodes, the SVG is sound."""

import itertools
import random
from xml.etree import ElementTree

import pytest

from solidtree.gui.command_line import main
from solidtree.model.document.document import Document
from solidtree.model.document.errors import Refusal
from solidtree.model.document.kind_names import function_name
from solidtree.model.document.nodes import KINDS, Broken, Node, Union
from solidtree.model.document.primitives import Box
from solidtree.model.document.tree import walk
from solidtree.model.operations.operations import OPERATIONS
from solidtree.model.script import box, cylinder, difference, document_of, linear_array, save, sphere, union
from solidtree.render.drawing.csg_diagram import BETWEEN, GAP, LEVEL, diagram, diagram_of, packed, roots_of
from solidtree.render.drawing.kind_pictures import PRIMITIVES, SYMBOLS, arc
from solidtree.render.drawing.tidy_tree import TidyTree

SVG = "{http://www.w3.org/2000/svg}"


def random_tree(rng: random.Random, depth: int) -> Node:
    if depth == 0 or rng.random() < 0.25:
        return rng.choice((box, sphere, cylinder))(1).named("x" * rng.randrange(25))
    operands = [random_tree(rng, depth - 1) for _ in range(rng.randrange(1, 5))]
    return rng.choice((union, difference))(*operands).named("op" * rng.randrange(4))


def apart(items) -> None:
    """Neighbours on a level keep their gap."""
    levels: dict[float, list] = {}
    for item in items:
        levels.setdefault(item.y, []).append(item)
        assert item.height < LEVEL
    for level in levels.values():
        for a, b in itertools.pairwise(sorted(level, key=lambda item: item.x)):
            assert a.x + a.right + GAP <= b.x - b.left + 1e-6, (a, b)


@pytest.mark.parametrize("seed", range(60))
def test_nothing_overlaps_and_operands_keep_their_order(seed):
    root = random_tree(random.Random(seed), 6)
    drawn = diagram_of(root)
    apart(drawn.items)
    at = {item.node_id: item for item in drawn.items if item.role != "result"}
    for node in walk(root):
        below = [at[child.id] for child in node.children]
        assert [item.x for item in below] == sorted(item.x for item in below)
        if below:
            assert at[node.id].x == pytest.approx((below[0].x + below[-1].x) / 2)
            assert all(item.y == at[node.id].y + LEVEL for item in below)
    assert min(item.x - item.left for item in drawn.items) == pytest.approx(0)
    assert max(item.x + item.right for item in drawn.items) == pytest.approx(drawn.width)


def test_equal_sub_trees_are_drawn_alike():
    part = union(difference(box(1), sphere(1), sphere(1)), box(1))
    twice = diagram_of(union(part, part.with_(id="other"), sphere(1)))
    shape = []
    for item in twice.items:
        if item.kind == "union" and item.parent == 1:
            below = [i for i in twice.items if twice.items[i.parent] is item]
            shape.append([i.x - item.x for i in below])
    assert len(shape) == 2 and shape[0] == pytest.approx(shape[1])


def comb(count: int) -> list[list[int]]:
    """Every node has a leaf and the rest of the tree below it, by turns on either side."""
    children: list[list[int]] = [[] for _ in range(2 * count + 1)]
    for i in range(0, 2 * count, 2):
        children[i] = [i + 1, i + 2] if i % 4 else [i + 2, i + 1]
    return children


def binary(levels: int) -> list[list[int]]:
    count = 2**levels - 1
    return [[2 * i + 1, 2 * i + 2] if 2 * i + 2 < count else [] for i in range(count)]


def flat(count: int) -> list[list[int]]:
    return [list(range(1, count + 1)), *([] for _ in range(count))]


@pytest.mark.parametrize("children", [comb(5000), binary(12), flat(5000), [[i + 1] for i in range(5000)] + [[]]])
def test_each_pair_of_contours_is_compared_once(children):
    size = [5.0] * len(children)
    assert TidyTree(children, size, size, 1.0).contour_steps <= len(children)


def test_the_textbook_places_of_a_small_tree():
    # A root over a pair and a single: the single goes as near as the pair lets it.
    tidy = TidyTree([[1, 2], [3, 4], [], [], []], [1.0] * 5, [1.0] * 5, 2.0)
    assert tidy.depth == [0, 1, 1, 2, 2]
    assert tidy.x == pytest.approx([0, -2, 2, -4, 0])


def test_wide_operations_are_folded_until_they_are_opened():
    root = union(*[box(i + 1).named(f"b{i}") for i in range(100)])
    folded = diagram_of(root)
    assert [item.text for item in folded.items if item.role == "fold"] == ["… 94 more"]
    assert len([item for item in folded.items if item.role == "leaf"]) == 6
    opened = diagram_of(root, opened={root.id})
    assert len([item for item in opened.items if item.role == "leaf"]) == 100
    assert not [item for item in diagram_of(union(*[box(1)] * 12)).items if item.role == "fold"]


def test_deep_trees_are_laid_out():
    node: Node = Box(name="leaf")
    for _ in range(3000):
        node = Union(children=(node,))
    assert diagram_of(node).height > 3000 * LEVEL


def test_every_kind_has_a_picture():
    names = {function_name(kind) for kind in KINDS.values() if kind.__name__ not in ("Broken", "Instance")}
    assert names <= PRIMITIVES.keys() | SYMBOLS.keys() and Broken.__name__ in KINDS


def test_arcs_are_round():
    (x, y), radius, here = (3.0, 4.0), 10.0, (0.0, 0.0)
    for command, numbers in arc((x, y), radius, radius, -30, 250):
        if command == "C":
            points = [here, numbers[0:2], numbers[2:4], numbers[4:6]]
            middle = [sum(w * p[i] for w, p in zip((1, 3, 3, 1), points, strict=True)) / 8 for i in (0, 1)]
            assert abs(((middle[0] - x) ** 2 + (middle[1] - y) ** 2) ** 0.5 - radius) < 3e-3
        here = numbers[-2:]


def test_solids_stand_in_rows_that_suit_the_frame():
    parts = [diagram_of(union(box(1), box(2)).named(f"s{i}")) for i in range(4)]
    wide, tall = packed(parts, 1000, 100), packed(parts, 100, 1000)
    assert wide.height == parts[0].height and wide.width == pytest.approx(4 * parts[0].width + 3 * BETWEEN)
    assert tall.width == parts[0].width and tall.height == pytest.approx(4 * parts[0].height + 3 * BETWEEN)
    assert [item.parent for item in wide.items].count(-1) == 4 and packed([], 10, 10).items == ()
    for item in tall.items:
        assert item.parent < 0 or tall.items[item.parent].y < item.y


NAMES = ["<&>\"'", "a ]]> b", "Büchse Ⅳ", "tab\tand\x07bell"]


def test_the_svg_is_well_formed_and_holds_every_name(tmp_path):
    document = document_of(
        difference(*[box(1).named(name) for name in NAMES]).named("<root>"),
        linear_array(sphere(1).coloured("tomato"), 5).named("row"),
    )
    document = OPERATIONS["link"](document, ["n2"])
    diagram(document, tmp_path / "x.svg")
    root = ElementTree.parse(tmp_path / "x.svg").getroot()
    titles = {element.text for element in root.iter(f"{SVG}title")}
    assert {"<root>", "<&>\"'", "a ]]> b", "Büchse Ⅳ", "tab\tandbell"} <= titles
    texts = {element.text for element in root.iter(f"{SVG}text")}
    assert {"<root>", "× 5", "<&>\"' (definition)"} <= texts
    fills = {element.get("fill") for element in root.iter(f"{SVG}path")}
    gradients = {f"url(#{element.get('id')})" for element in root.iter(f"{SVG}radialGradient")}
    assert gradients and gradients <= fills
    assert not list(root.iter(f"{SVG}image")) and not list(root.iter(f"{SVG}script"))


def test_one_solid_can_be_drawn_alone():
    document = document_of(a=box(1), b=sphere(1))
    assert [title for _, title in roots_of(document, "b")] == ["b"]
    with pytest.raises(Refusal, match="no solid called “c”"):
        roots_of(document, "c")
    assert roots_of(Document()) == []


def test_the_command_line_writes_it(tmp_path, capsys):
    save(tmp_path / "part.solidtree", part=box(1) - sphere(1), other=box(2))
    assert main(["diagram", str(tmp_path / "part.solidtree"), str(tmp_path / "a.svg"), "--solid", "part"]) == 0
    assert "other" not in (tmp_path / "a.svg").read_text(encoding="utf-8")
    assert main(["diagram", str(tmp_path / "part.solidtree"), str(tmp_path / "a.pdf")]) == 2
    assert main(["diagram", str(tmp_path / "part.solidtree"), str(tmp_path / "b.svg"), "--solid", "no"]) == 2
    assert "no solid called" in capsys.readouterr().err
    script = tmp_path / "make.py"
    script.write_text(f"diagram(box(1) + sphere(2), {str(tmp_path / 'c.svg')!r})", encoding="utf-8")
    assert main(["run", str(script)]) == 0 and ElementTree.parse(tmp_path / "c.svg")
