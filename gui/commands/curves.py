"""The window's commands on outlines and curves, in the menu Curve. They take the MainWindow."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from ...model.document.outlines import Bezier, BSpline, is_outline
from ...model.editing.chosen import chosen
from ...model.editing.commands import Command, done

if TYPE_CHECKING:
    from ..window import MainWindow

MENU = "Curve"


def outlines_fault(fewest: int = 1, most: int | None = None) -> Callable[[MainWindow], str | None]:
    """A fault for commands that take so many selected outlines; most None: any number."""

    def fault(window: MainWindow) -> str | None:
        session = window.session
        count = len(session.selection)
        if count < fewest:
            return "select an outline first" if fewest == 1 else f"select {fewest} outlines or more first"
        if most is not None and count > most:
            return "select one outline only" if most == 1 else f"select at most {most} outlines"
        for node in chosen(session).nodes:
            if not is_outline(node, session.document.definitions):
                return f"“{node.label}” is no outline"
        return None

    return fault


def _curve_fault(kinds: tuple[type, ...], words: str) -> Callable[[MainWindow], str | None]:
    """A fault for commands that take one selected outline of some kinds."""

    def fault(window: MainWindow) -> str | None:
        nodes = chosen(window.session).nodes
        return None if len(nodes) == 1 and isinstance(nodes[0], kinds) else f"select {words} first"

    return fault


def _no_bspline_yet(window: MainWindow) -> str | None:
    fault = outlines_fault(1, 1)(window)
    if fault is None and isinstance(chosen(window.session).nodes[0], BSpline):
        return "this is a B-spline already"
    return fault


def _on_one(operation: str, label: str) -> Callable[[MainWindow], None]:
    return lambda w: done(w.session.do(operation, w.session.selection[0], label=label))


def _combine(kind: str, label: str) -> Callable[[MainWindow], None]:
    def run(window: MainWindow) -> None:
        from ..curves.outline_work import do_aside

        do_aside(window, "combine_outlines", kind, list(window.session.selection), label=label)

    return run


def _ask_offset(window: MainWindow) -> None:
    from ..curves.outline_dialog import ask_offset

    ask_offset(window)


def _ask_stroke(window: MainWindow) -> None:
    from ..curves.outline_dialog import ask_stroke

    ask_stroke(window)


def _to_path(window: MainWindow) -> None:
    window.session.do("convert_to_path", list(window.session.selection), label="Convert to path")


def _reverse(window: MainWindow) -> None:
    window.session.do("reverse_contours", window.session.selection[0], label="Reverse")


def _split(window: MainWindow) -> None:
    window.session.do("split_outline", window.session.selection[0], label="Split into outlines")


def _mirror(axis: str, label: str) -> Callable[[MainWindow], None]:
    return lambda w: done(w.session.do("mirror_outline", list(w.session.selection), axis, label=label))


def _panel(window: MainWindow) -> None:
    """Bring the panel to the front, or the properties where it is there already."""
    dock = window.docks["Properties" if window.curve_panel.in_front else "Curve"]
    dock.show()
    dock.raise_()


def _comb(window: MainWindow) -> None:
    window.comb.set_on(not window.comb.on)


def _construction(window: MainWindow) -> None:
    """Show it, with its page in front, or hide it."""
    window.construction.set_on(not window.construction.on)
    if window.construction.on:
        dock = window.docks["Curve"]
        dock.show()
        dock.raise_()
        window.curve_panel.show_page("Construction")


def _no_construction(window: MainWindow) -> str | None:
    path = window.curve.path
    if window.construction.on or (path is not None and path.contours):
        return None
    return "select an outline first"


def _combine_command(kind: str, word: str, shortcut: str, tip: str, fewest: int) -> Command:
    label = f"{word} outlines"
    return Command(f"{word.lower()}_outlines", label, MENU, _combine(kind, label), outlines_fault(fewest), shortcut,
                   f"{word.lower()}_outlines", tip)  # fmt: skip


CURVE_COMMANDS: tuple[Command, ...] = (
    _combine_command("union", "Unite", "Ctrl++; Ctrl+=",
                     "One path around all that the selected outlines fill, for good: its nodes can be edited.\n"
                     "Union keeps them as operands that stay editable", 1),
    _combine_command("difference", "Subtract", "Ctrl+-",
                     "The first selected outline less the others as one path, for good.\n"
                     "Difference keeps them as operands that stay editable", 2),
    _combine_command("intersection", "Intersect", "Ctrl+*",
                     "What all selected outlines fill as one path, for good.\n"
                     "Intersection keeps them as operands that stay editable", 2),
    _combine_command("exclusion", "Exclude", "Ctrl+^",
                     "What an odd number of the selected outlines fills, as one path: where two overlap is a hole", 2),
    Command("offset_outline", "Offset …", MENU, _ask_offset, outlines_fault(), "Ctrl+J", "offset_outline",
            "Make the selected outlines larger or smaller all around"),
    Command("stroke_outline", "Stroke to outline …", MENU, _ask_stroke, outlines_fault(), "Ctrl+Alt+C",
            "stroke_outline", "The outline of a pen of some width drawn along the selected curves"),
    Command("convert_to_path", "Convert to path", MENU, _to_path, outlines_fault(), "", "convert_to_path",
            "Nodes and handles instead of sizes"),
    Command("convert_to_bspline", "Convert to B-spline", MENU, _on_one("convert_to_bspline", "Convert to B-spline"),
            _no_bspline_yet, "", "convert_to_bspline",
            "One curve with knots and control points; it stays as it is, but for a circle's rounding"),
    Command("elevate_degree", "Elevate degree", MENU, _on_one("elevate_degree", "Elevate degree"),
            _curve_fault((Bezier, BSpline), "one B-spline or Bezier curve"), "", "elevate_degree",
            "One degree more and more control points; the curve stays as it is"),
    Command("reduce_degree", "Reduce degree", MENU, lambda w: w.spline_page.reduce_degree(),
            _curve_fault((Bezier, BSpline), "one B-spline or Bezier curve"), "", "reduce_degree",
            "One degree less and fewer control points; how far the curve moves is told in the status bar"),
    Command("refine_knots", "Refine knots", MENU, _on_one("refine_knots", "Refine knots"),
            _curve_fault((BSpline,), "one B-spline"), "", "refine_knots",
            "A knot in the middle of every interval, for finer editing; the curve stays as it is"),
    Command("reverse_contours", "Reverse", MENU, _reverse, outlines_fault(1, 1), "", "reverse_contours",
            "Run through the curve the other way; with the winding rule it can open or fill a hole"),
    Command("split_outline", "Split into outlines", MENU, _split, outlines_fault(1, 1), "", "split_outline",
            "Each island with its holes becomes an outline of its own"),
    Command("mirror_outline_x", "Mirror left-right", MENU, _mirror("x", "Mirror left-right"), outlines_fault(), "",
            "mirror_outline_x", "Mirror the selected outlines in place, left to right"),
    Command("mirror_outline_y", "Mirror up-down", MENU, _mirror("y", "Mirror up-down"), outlines_fault(), "",
            "mirror_outline_y", "Mirror the selected outlines in place, top to bottom"),
    Command("curve_panel", "Curve panel", "Curve", _panel, shortcut="V", icon="curve_panel",
            tip="Numbers of nodes and handles, joints, the construction and the knots of the selected outline",
            checked=lambda w: w.curve_panel.in_front),
    Command("curvature_comb", "Curvature comb", "Curve", _comb, shortcut="Alt+K", icon="curvature_comb",
            tip="Teeth across the selected outline, as long as it is bent", checked=lambda w: w.comb.on),
    Command("construction", "Construction", "Curve", _construction, _no_construction, "Alt+Shift+C", "construction",
            "How a point of the selected curve is made: de Casteljau's or de Boor's levels, string art, steps,\n"
            "what each control point weighs, and the polynomial", checked=lambda w: w.construction.on),
)  # fmt: skip
