"""The table of commands on a document: menus, toolbar, palette, shortcuts and tests all read it.

The window adds its own (files, views) to the same table.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from ..document.from_outlines import FROM_OUTLINES, Extrude, Revolve
from ..document.nodes import Difference, Instance, Intersection, Node
from ..document.outlines import OUTLINES, Circle, Lettering, Outlines, Polygon, Rectangle
from ..document.primitives import Box, Cone, Cylinder, Halfspace, Sphere, Torus
from .chosen import chosen
from .session import Session

BOUNDING = (Difference, Intersection)


@dataclass(frozen=True, slots=True)
class Command:
    """One entry. `fault` tells why it cannot be used now, or None; `run` takes what `fault` took."""

    name: str
    title: str
    menu: str
    run: Callable[[Any], None]
    fault: Callable[[Any], str | None] = lambda context: None
    shortcut: str = ""
    icon: str = ""
    tip: str = ""
    toolbar: bool = False
    checked: Callable[[Any], bool] | None = None
    """For a switch: whether it is on."""


def chosen_fault(fewest: int = 1, most: int | None = None) -> Callable[[Session], str | None]:
    """A fault for commands that take so many selected nodes; most None: any number."""

    def fault(session: Session) -> str | None:
        count = len(session.selection)
        if count < fewest:
            return "select a node first" if fewest == 1 else f"select at least {fewest} nodes first"
        if most is not None and count > most:
            return "select one node only" if most == 1 else f"select at most {most} nodes"
        return None

    return fault


def place_beside(session: Session, flat: bool = False) -> list[Any]:
    """Where new nodes go, as the last arguments of `insert`; `flat`: they are outlines.

    Into a selected operation that has room for them, beside a selected operand, else (no arguments) they stand by
    themselves.
    """
    if len(session.selection) != 1:
        return []
    looked = chosen(session)
    node, above = looked.nodes[0], looked.above[0]
    outlines = Outlines(session.document.definitions)
    if _takes(node, flat, outlines):
        return [node.id]
    if above is not None and _takes(above, flat, outlines):
        return [above.id, looked.places[0] + 1]
    return []


def _takes(node: Node, flat: bool, outlines: Outlines) -> bool:
    """Whether a node takes any number of outlines (`flat`) or of solids."""
    if type(node).operands[1] is not None or isinstance(node, Instance):
        return False
    return (node in outlines or isinstance(node, FROM_OUTLINES)) == flat


def _bounded_place(session: Session) -> list[Any]:
    """Where a new half-space goes, likewise: only where it cuts something, never among the operands of a union."""
    if len(session.selection) != 1:
        return []
    looked = chosen(session)
    node, above = looked.nodes[0], looked.above[0]
    if isinstance(node, BOUNDING):
        return [node.id]
    if isinstance(above, BOUNDING):
        return [above.id, looked.places[0] + 1]
    return []


def _add(kind: Callable[[], Node]) -> Callable[[Session], None]:
    def run(session: Session) -> None:
        node = kind()
        bounded = isinstance(node, Halfspace)
        place = _bounded_place(session) if bounded else place_beside(session, isinstance(node, OUTLINES))
        session.do("insert", node, *place, label=f"Add {node.title.lower()}")

    return run


def _combine(kind: str, title: str) -> Callable[[Session], None]:
    return lambda session: done(session.do("combine", kind, list(session.selection), label=title))


def done(_: object) -> None:
    """Lets a call that answers stand where nothing is asked."""


def _add_command(
    kind: type[Node], shortcut: str, tip: str, make: Callable[[], Node] | None = None, toolbar: bool = True
) -> Command:
    word = kind.__name__.lower()
    return Command(f"add_{word}", kind.title, "Add", _add(make or kind), shortcut=shortcut, icon=word, tip=tip,
                   toolbar=toolbar and make is None)  # fmt: skip


def _combine_command(kind: str, title: str, shortcut: str, tip: str, toolbar: bool = True) -> Command:
    return Command(kind, title, "Combine", _combine(kind, title), chosen_fault(), shortcut, kind, tip, toolbar)


def _hexagon() -> Polygon:
    corners = (math.radians(60 * i) for i in range(6))
    return Polygon(points=tuple((round(10 * math.cos(a), 6), round(10 * math.sin(a), 6)) for a in corners))


def _outlines_fault(fewest: int, most: int | None, ask: str) -> Callable[[Session], str | None]:
    """A fault for commands that take so many selected outlines; most None: any number. `ask` is said of others."""

    def fault(session: Session) -> str | None:
        outlines = Outlines(session.document.definitions)
        solid = next((node for node in chosen(session).nodes if node not in outlines), None)
        if solid is not None:
            return f"“{solid.label}” is no outline; select outlines"
        count = len(session.selection)
        return ask if count < fewest or (most is not None and count > most) else None

    return fault


def _text_on_path_fault(session: Session) -> str | None:
    ask = "select two: a lettering and the curve to set it along"
    fault = _outlines_fault(2, 2, ask)(session)
    either = any(isinstance(node, Lettering | Instance) for node in chosen(session).nodes)
    return fault or (None if either else ask)


def _done_by(operation: str, title: str) -> Callable[[Session], None]:
    return lambda session: done(session.do(operation, list(session.selection), label=title))


def _make_solid_command(kind: str, title: str, fewest: int, most: int | None, shortcut: str, tip: str) -> Command:
    ask = {1: "select an outline first", 2: "select two outlines or more"}[fewest] if most is None else (
        "select two: an outline and the path to draw it along")  # fmt: skip
    fault = _outlines_fault(fewest, most, ask)
    return Command(kind, title, "Curve", lambda s: done(s.do("make_solid", kind, list(s.selection), label=title)),
                   fault, shortcut, kind, tip)  # fmt: skip


def _visibility(session: Session) -> None:
    show = not all(node.visible for node in chosen(session).nodes)
    session.do("set_visible", list(session.selection), show, label="Show" if show else "Hide")


def _undo_fault(session: Session) -> str | None:
    return None if session.undo_label else "there is nothing to undo"


def _redo_fault(session: Session) -> str | None:
    return None if session.redo_label else "there is nothing to redo"


def _dissolve_fault(session: Session) -> str | None:
    bare = [node for node in chosen(session).nodes if not node.children]
    return chosen_fault()(session) or (f"“{bare[0].label}” has no operands to set free" if bare else None)


def _unlink_fault(session: Session) -> str | None:
    whole = all(isinstance(node, Instance) for node in chosen(session).nodes)
    return chosen_fault()(session) or (None if whole else "select an instance")


DOCUMENT_COMMANDS: tuple[Command, ...] = (
    _add_command(Box, "Shift+B", "A cuboid"),
    _add_command(Sphere, "Shift+S", "A ball"),
    _add_command(Cylinder, "Shift+C", "A round bar"),
    _add_command(Cone, "Shift+O", "A cone or a frustum"),
    _add_command(Torus, "Shift+T", "A ring"),
    _add_command(Halfspace, "Shift+H", "All on one side of a plane; it bounds what it is combined with"),
    _add_command(Extrude, "", "A rectangle drawn up", lambda: Extrude(children=(Rectangle(),))),
    _add_command(Revolve, "", "A circle turned about the z axis", lambda: Revolve(children=(Circle(radius=4).at(12),))),
    _add_command(Rectangle, "", "An outline of four sides, flat", toolbar=False),
    _add_command(Circle, "", "A round outline, flat", toolbar=False),
    _add_command(Polygon, "", "An outline of straight sides, flat", _hexagon),
    _add_command(Lettering, "Alt+L", "Text in any font, as an outline", toolbar=False),
    _make_solid_command("extrude", "Extrude", 1, None, "Shift+E", "Draw each selected outline up to a solid"),
    _make_solid_command("revolve", "Revolve", 1, None, "Ctrl+R", "Turn each selected outline about its own y axis"),
    _make_solid_command("sweep", "Sweep", 2, 2, "", "Draw the selected outline along the selected path"),
    _make_solid_command("loft", "Loft", 2, None, "", "Stretch a solid over the selected outlines, in their order"),
    _make_solid_command("pipe", "Pipe", 1, None, "", "A round bar along each selected path"),
    _make_solid_command("wrap", "Wrap", 1, None, "", "Lay each selected outline round a cylinder"),
    Command("text_on_path", "Text on path", "Curve", _done_by("set_text_on_path", "Text on path"), _text_on_path_fault,
            "Alt+P", "text_on_path", "Set the selected lettering along the selected curve"),
    Command("stencil", "Stencil", "Curve", _done_by("make_stencils", "Stencil"),
            _outlines_fault(1, None, "select an outline first"), "", "stencil",
            "Hold the middles of the selected letters by bridges, so that they can be cut out"),
    _combine_command("union", "Union", "Ctrl+U", "All that lies in any of the selected nodes"),
    _combine_command("difference", "Difference", "Ctrl+D", "The first selected node less the others"),
    _combine_command("intersection", "Intersection", "Ctrl+I", "What lies in all of the selected nodes"),
    _combine_command("hull", "Hull", "", "The smallest convex solid around the selected nodes", False),
    _combine_command("minkowski", "Minkowski sum", "", "The first selected node swept by the others", False),
    _combine_command("linear_array", "Linear array", "", "Copies in a row", False),
    _combine_command("polar_array", "Polar array", "", "Copies around an axis", False),
    _combine_command("mirror", "Mirror", "", "With its mirror image", False),
    Command("undo", "Undo", "Edit", lambda s: done(s.undo()), _undo_fault, "Ctrl+Z", "undo", "Take back the last step",
            True),
    Command("redo", "Redo", "Edit", lambda s: done(s.redo()), _redo_fault, "Ctrl+Shift+Z", "redo",
            "Do again what was taken back", True),
    Command("delete", "Delete", "Edit", lambda s: done(s.do("delete", list(s.selection))), chosen_fault(), "Delete",
            "delete", "Take the selected nodes out"),
    Command("duplicate", "Duplicate", "Edit", lambda s: done(s.do("duplicate", list(s.selection))), chosen_fault(),
            "Ctrl+Shift+D", "duplicate", "Copy the selected nodes, each beside its original"),
    Command("dissolve", "Dissolve", "Edit", lambda s: done(s.do("dissolve", list(s.selection))), _dissolve_fault,
            "Ctrl+Shift+G", "dissolve", "Replace operations by their operands"),
    Command("link", "Link", "Edit", lambda s: done(s.do("link", list(s.selection))), chosen_fault(), "", "link",
            "Make a definition of it, which instances share; equal nodes come to share one"),
    Command("unlink", "Unlink", "Edit", lambda s: done(s.do("unlink", list(s.selection))), _unlink_fault, "", "unlink",
            "Make an instance a part of its own"),
    Command("toggle_visible", "Show or hide", "Edit", _visibility, chosen_fault(), "H", "eye",
            "Hide the selected nodes, or show them again"),
)  # fmt: skip
