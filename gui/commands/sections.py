"""The window's commands on sections. They take the MainWindow."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from ...model.document.document import Section
from ...model.document.tree import unique_name
from ...model.editing.commands import Command

if TYPE_CHECKING:
    from ...render.pick import Pick
    from ..window import MainWindow

MENU = "Tools/Sections"
AXES = ("x", "y", "z")


def _no_solid(window: MainWindow) -> str | None:
    return None if any(root.visible for root in window.session.document.solids) else "no solid is visible"


def _no_section(window: MainWindow) -> str | None:
    return None if window.session.document.sections else "the document has no section"


def _no_chosen(window: MainWindow) -> str | None:
    if _no_section(window):
        return _no_section(window)
    return None if _chosen(window) is not None else "choose a section in the Sections panel first"


def _chosen(window: MainWindow) -> Section | None:
    """The chosen section, or the only one."""
    sections = window.session.document.sections
    return window.section_tool.section or (sections[0] if len(sections) == 1 else None)


def _across(axis: int) -> Callable[[MainWindow], None]:
    """Through the middle of what is shown; open on the side from which it is looked at."""

    def run(window: MainWindow) -> None:
        viewer = window.viewport.viewer
        bounds = None if viewer is None else viewer.scene.visible_bounds()
        middle = [0.0, 0.0, 0.0] if bounds is None else [round(float(c), 6) + 0.0 for c in bounds.mean(axis=0)]
        towards = 1.0 if viewer is None or viewer.camera.position[axis] >= viewer.camera.target[axis] else -1.0
        normal = [0.0, 0.0, 0.0]
        normal[axis] = -towards
        add(window, tuple(middle), tuple(normal))

    return run


def add(window: MainWindow, point: tuple[float, ...], normal: tuple[float, ...]) -> None:
    """Add a section as one step, and show its handle and its row."""
    name = unique_name("Section", [section.name for section in window.session.document.sections])
    window.session.do("add_section", name, point, normal, label=f"Add {name}")
    _set_open(window, True)
    window.section_tool.choose(name)
    show_panel(window)


def show_panel(window: MainWindow) -> None:
    window.docks["Sections"].show()
    window.docks["Sections"].raise_()


def _set_open(window: MainWindow, shown: bool) -> None:
    window.section_tool.set_open(shown)
    window.sections.measure()


def _at_face(window: MainWindow) -> None:
    def take(pick: Pick) -> None:
        point = tuple(round(value, 6) + 0.0 for value in pick.point)
        add(window, point, tuple(round(-value, 9) + 0.0 for value in pick.normal))

    window.measure.end()
    window.sight.end()
    window.place_on_face.end()
    window.draw.end()
    window.face_plane.end()
    window.section_tool.ask_face(take)


def _flip(window: MainWindow) -> None:
    section = _chosen(window)
    assert section is not None
    normal = tuple(0.0 - value for value in section.normal)
    window.session.do("set_section", section.name, normal=normal, label=f"Flip {section.name}")


def _delete(window: MainWindow) -> None:
    section = _chosen(window)
    assert section is not None
    window.session.do("delete_section", section.name, label=f"Delete {section.name}")


def _switch(window: MainWindow) -> None:
    section = _chosen(window)
    assert section is not None
    label = f"{'Close' if section.active else 'Open'} {section.name}"
    window.session.do("set_section", section.name, active=not section.active, label=label)


def ask_export(window: MainWindow) -> None:
    from .. import dialogs

    section = _chosen(window)
    assert section is not None
    start = Path(window.settings.folder, f"{window.files.name} {section.name}.svg")
    dialogs.ask_outline_path(window, start, lambda path: window.files.export(path, section=section))


SECTION_COMMANDS: tuple[Command, ...] = (
    *(
        Command(f"section_{axis}", f"Section across {axis}", MENU, _across(place), _no_solid, f"Alt+{axis.upper()}",
                "section", f"Cut through the middle by a plane across the {axis} axis, open on the side you look from")
        for place, axis in enumerate(AXES)
    ),
    Command("section_face", "Section at a face …", MENU, _at_face, _no_solid, "", "section",
            "Click a face: its plane cuts all that stands before it"),
    Command("flip_section", "Flip section", MENU, _flip, _no_chosen, "Alt+Shift+X", "flip",
            "Open the other side of the chosen section"),
    Command("switch_section", "Open or close section", MENU, _switch, _no_chosen, "",
            tip="Let the chosen section open the picture, or not"),
    Command("delete_section", "Delete section", MENU, _delete, _no_chosen, "", "delete",
            "Take the chosen section out"),
    Command("export_section", "Export outlines …", MENU, ask_export, _no_chosen, "", "export",
            "Write what the chosen section cuts as SVG or DXF, in millimetres"),
    Command("sections", "Show sections", "View", lambda w: _set_open(w, not w.section_tool.open), _no_section,
            "Shift+X", "section", "Let the sections open the picture; off shows the solids whole",
            checked=lambda w: w.section_tool.open),
)  # fmt: skip
