"""The window's commands that move the selected nodes to where others stand. They take the MainWindow."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from ...model.document.errors import Refusal
from ...model.document.tree import find, outermost
from ...model.editing.commands import Command

if TYPE_CHECKING:
    from ..window import MainWindow

MENU = "Tools/Arrange"
AXES = ("x", "y", "z")
SIDES = (
    ("min", "lowest", ("left", "front", "bottom")),
    ("middle", "middle", ("middle across", "middle in depth", "middle in height")),
    ("max", "highest", ("right", "back", "top")),
)


def _fault(fewest: int) -> Callable[[MainWindow], str | None]:
    def fault(window: MainWindow) -> str | None:
        selection, parts = window.session.selection, window.evaluation.parts
        if len(selection) < fewest:
            return "select a node first" if fewest == 1 else f"select {fewest} nodes or more first"
        if window.evaluation.examining:
            return "the selected nodes are still being computed"
        if not any(node_id in parts for node_id in selection):
            return "the selected nodes have no solid in the picture"
        return None

    return fault


def _arrange(window: MainWindow, label: str, moves: Callable[[list[Any]], Any]) -> None:
    """Move the selected nodes by what a function says for their bounds in the world, as one step."""
    from ...model.operations.arranging import parent_moves

    session = window.session
    ids = outermost(session.document, session.selection)
    bounds = []
    for node_id in ids:
        part = window.evaluation.parts.get(node_id)
        if part is None or part.measures is None or part.measures.bounds is None:
            raise Refusal(f"“{find(session.document, node_id).label}” has no size: it is empty, endless or has failed")
        bounds.append(part.measures.bounds)
    found = parent_moves(session.document, ids, moves(bounds))
    if not found:
        raise Refusal(f"{label}: it is so already")
    session.do("shift", found, label=label, select=session.selection)


def _align(axis: str, side: str, label: str) -> Callable[[MainWindow], None]:
    def run(window: MainWindow) -> None:
        from ...model.measuring.arrange import aligned

        alone = len(outermost(window.session.document, window.session.selection)) == 1
        _arrange(window, label, lambda bounds: aligned(bounds, axis, side, 0.0 if alone else None))

    return run


def _distribute(axis: str, by: str, label: str) -> Callable[[MainWindow], None]:
    def run(window: MainWindow) -> None:
        from ...model.measuring.arrange import spread

        _arrange(window, label, lambda bounds: spread(bounds, axis, by))

    return run


def _drop(window: MainWindow) -> None:
    from ...model.measuring.arrange import grounded

    _arrange(window, "Drop to the ground", grounded)


def _centre(window: MainWindow) -> None:
    from ...model.measuring.arrange import centred

    _arrange(window, "Centre on the ground", centred)


def _place(window: MainWindow) -> None:
    window.measure.end()
    window.sight.end()
    window.draw.end()
    window.face_plane.end()
    window.engrave.end()
    window.place_on_face.start()


def _place_fault(window: MainWindow) -> str | None:
    return "select one node only" if len(window.session.selection) > 1 else _fault(1)(window)


def _align_commands() -> tuple[Command, ...]:
    commands = []
    for number, axis in enumerate(AXES):
        for side, word, names in SIDES:
            label = f"Align {names[number]}"
            tip = f"Bring the {word} {axis} of the selected nodes to the first one's; of a single node to {axis} = 0"
            if side == "middle":
                tip = f"Bring the middles along {axis} to the first selected node's; of a single node to {axis} = 0"
            commands.append(Command(f"align_{axis}_{side}", label, MENU, _align(axis, side, label), _fault(1), "",
                                    f"align_{axis}_{side}", tip))  # fmt: skip
    return tuple(commands)


def _distribute_commands() -> tuple[Command, ...]:
    commands = []
    for by, words, tip in (
        ("gaps", "Equal gaps", "Make the gaps between the selected nodes equal; the outermost two stay"),
        ("centres", "Equal centres", "Make the steps from middle to middle equal; the outermost two stay"),
    ):
        for axis in AXES:
            label = f"{words} along {axis}"
            commands.append(Command(f"distribute_{axis}_{by}", label, MENU, _distribute(axis, by, label), _fault(3), "",
                                    f"distribute_{axis}", tip))  # fmt: skip
    return tuple(commands)


ARRANGE_COMMANDS: tuple[Command, ...] = (
    Command("place_on_face", "Place on face …", MENU, _place, _place_fault, "Shift+F",
            "place_on_face", "Lay the selected node on a face that you click"),
    Command("drop_to_ground", "Drop to the ground", MENU, _drop, _fault(1), "Shift+D", "drop_to_ground",
            "Bring the lowest point of each selected node to z = 0"),
    Command("centre_on_ground", "Centre on the ground", MENU, _centre, _fault(1), "", "centre_on_ground",
            "Bring the selected nodes together over the origin, standing on z = 0"),
    *_align_commands(),
    *_distribute_commands(),
)  # fmt: skip
ARRANGE_SEPARATORS = ("align_x_min", "align_y_min", "align_z_min", "distribute_x_gaps", "distribute_x_centres")
"""The commands before which the menu has a line."""
