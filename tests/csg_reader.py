"""A small reader of OpenSCAD's .csg for tests and measurements: the kinds of node that the boolean cases use."""

import ast
import math
import re
from dataclasses import dataclass, field

from solidtree.model.document.from_outlines import Extrude
from solidtree.model.document.nodes import Difference, Hull, Intersection, Minkowski, Node, Union
from solidtree.model.document.outlines import Circle, Polygon, Rectangle
from solidtree.model.document.placement import Affine, Placement
from solidtree.model.document.primitives import Box, Cone, Polyhedron

_TOKEN = re.compile(r"\s*(?:([%#]?[A-Za-z_]\w*)\s*\(|([{};]))")


@dataclass
class Call:
    """One call of the file: its word, its arguments by name or position, and the calls in its braces."""

    word: str
    arguments: dict
    below: list["Call"] = field(default_factory=list)


def parse(text):
    """The calls at the top of a file. Nothing here recurses: cases are hundreds of levels deep."""
    root = Call("group", {})
    open_, at, last = [root], 0, root
    end_of_text = len(text.rstrip())
    while at < end_of_text:
        found = _TOKEN.match(text, at)
        assert found, f"cannot read {text[at : at + 40]!r}"
        at = found.end()
        if found[1]:
            end = _closing(text, at)
            last = Call(found[1].lstrip("#"), _arguments(text[at:end]))
            open_[-1].below.append(last)
            at = end + 1
        elif found[2] == "{":
            open_.append(last)
        elif found[2] == "}":
            open_.pop()
    return root.below


def _closing(text, at):
    depth = 1
    while depth:
        depth += {"(": 1, ")": -1}.get(text[at], 0)
        at += 1
    return at - 1


def _arguments(text):
    plain = re.sub(r"\btrue\b", "True", re.sub(r"\bfalse\b", "False", re.sub(r"\bundef\b", "None", text)))
    call = ast.parse(f"f({plain.replace('$', 'S_')})", mode="eval").body
    values = {i: ast.literal_eval(value) for i, value in enumerate(call.args)}
    return values | {keyword.arg: ast.literal_eval(keyword.value) for keyword in call.keywords}


def fragments(radius, arguments):
    """OpenSCAD's rule for the sides of a circle."""
    if (arguments.get("S_fn") or 0) > 0:
        return math.ceil(max(arguments["S_fn"], 3))
    return math.ceil(max(min(360 / arguments.get("S_fa", 12), 2 * math.pi * radius / arguments.get("S_fs", 2)), 5))


def sphere_mesh(radius, sides):
    """OpenSCAD's sphere: rings half a step away from the poles, closed by flat faces."""
    rings = (sides + 1) // 2
    points = [
        (
            radius * math.sin(math.pi * (i + 0.5) / rings) * math.cos(2 * math.pi * j / sides),
            radius * math.sin(math.pi * (i + 0.5) / rings) * math.sin(2 * math.pi * j / sides),
            radius * math.cos(math.pi * (i + 0.5) / rings),
        )
        for i in range(rings)
        for j in range(sides)
    ]
    faces = [tuple(range(sides)), tuple((rings - 1) * sides + j for j in reversed(range(sides)))]
    for i in range(rings - 1):
        for j in range(sides):
            a, b = i * sides + j, i * sides + (j + 1) % sides
            faces.append((a, a + sides, b + sides, b))
    return points, faces


def leaf(call):
    """A leaf or outline as a node."""
    a = call.arguments
    match call.word:
        case "cube":
            size = a.get("size", 1)
            return Box(size=tuple(size) if isinstance(size, list) else (size,) * 3, centred=bool(a.get("center")))
        case "cylinder":
            low, high = a.get("r1", a.get("r", 1)), a.get("r2", a.get("r", 1))
            sides = fragments(max(low, high), a)
            return Cone(
                radius=low, top_radius=high, height=a.get("h", 1), segments=sides, centred=bool(a.get("center"))
            )
        case "sphere":
            points, faces = sphere_mesh(a["r"], fragments(a["r"], a))
            return Polyhedron(points=tuple(points), faces=tuple(faces))
        case "polyhedron":
            faces = tuple(tuple(reversed(face)) for face in a["faces"])
            return Polyhedron(points=tuple(map(tuple, a["points"])), faces=faces)
        case "square":
            size = a.get("size", 1)
            width, height = size if isinstance(size, list) else (size, size)
            return Rectangle(width=width, height=height, centred=bool(a.get("center")))
        case "circle":
            return Circle(radius=a["r"], segments=fragments(a["r"], a))
        case "polygon":
            return Polygon(points=tuple(map(tuple, a["points"])), loops=tuple(map(tuple, a.get("paths") or ())))
    raise ValueError(f"{call.word} is not read here")


OPERATIONS = {
    "union": Union, "group": Union, "difference": Difference, "intersection": Intersection, "hull": Hull,
    "minkowski": Minkowski, "multmatrix": Union, "linear_extrude": Extrude, "color": Union, "render": Union,
}  # fmt: skip


def node_of(call) -> Node:
    """A call and all below it as a node."""
    made: list[Node] = []
    stack = [(call, False)]
    while stack:
        call, ready = stack.pop()
        if call.word not in OPERATIONS:
            made.append(leaf(call))
            continue
        if not ready:
            stack.append((call, True))
            stack += [(below, False) for below in reversed(call.below)]
            continue
        size = len(call.below)
        children = tuple(made[len(made) - size :])
        del made[len(made) - size :]
        made.append(_operation(call, children))
    return made[0]


def _operation(call, children) -> Node:
    if call.word == "linear_extrude":
        a = call.arguments
        assert len(children) == 1 and not a.get("twist") and len(set(a.get("scale", [1]))) == 1
        return Extrude(
            children=children, height=a["height"], top_scale=a.get("scale", [1])[0], centred=bool(a.get("center"))
        )
    kind = OPERATIONS[call.word]
    node = children[0] if kind is Union and len(children) == 1 else kind(children=children)
    if call.word == "multmatrix":
        rows = call.arguments[0][:3]
        step = Affine(tuple(value for row in rows for value in row))
        return node.with_(placement=Placement((*node.placement.steps, step)))
    return node


def read_csg(text) -> Node:
    """The union of a file's calls."""
    return node_of(Call("group", {}, parse(text)))
