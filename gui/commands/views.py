"""The window's own entries of the table of commands: files, views, styles, theme. They take the MainWindow."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ...model.document.tree import walk
from ...model.editing.commands import Command

if TYPE_CHECKING:
    from ..window import MainWindow

VIEWS = (
    ("iso", "Isometric", "0"),
    ("front", "Front", "1"),
    ("top", "Top", "2"),
    ("right", "Right", "3"),
    ("back", "Back", "4"),
    ("bottom", "Bottom", "5"),
    ("left", "Left", "6"),
)
STYLES = (
    ("shaded", "Shaded", "Alt+1", "Faces alone"),
    ("edges", "Shaded with edges", "Alt+2", "Faces and their feature edges"),
    ("wireframe", "Wireframe", "Alt+3", "Every edge, nothing hidden"),
    ("hidden-line", "Hidden line", "Alt+4", "Edges without those behind faces"),
)
SHADINGS = (
    ("flat", "Flat", "One intensity for each face"),
    ("gouraud", "Gouraud", "Light at the vertices, interpolated over the faces"),
    ("gouraud-diffuse", "Gouraud without highlights", "Diffuse light at the vertices, interpolated over the faces"),
    ("phong", "Phong", "Light at every pixel, from interpolated normals"),
)
THEMES = (("system", "As the system"), ("light", "Light"), ("dark", "Dark"))


def _no_solid(window: MainWindow) -> str | None:
    visible = any(root.visible for root in window.session.document.standing)
    return None if visible else "no solid and no outline is visible"


def _nothing(window: MainWindow) -> str | None:
    return None if window.session.document.standing else "the document is empty"


def _selected(window: MainWindow) -> str | None:
    return None if window.session.selection else "select a node first"


def _busy(window: MainWindow) -> str | None:
    waits = window.evaluation.waiting or window.evaluation.jobs.at_work
    return None if waits else "nothing is being computed"


def _select_all(window: MainWindow) -> None:
    window.session.select([root.id for root in window.session.document.standing])


def _invert(window: MainWindow) -> None:
    chosen = set(window.session.selection)
    roots = window.session.document.standing
    window.session.select([root.id for root in roots if not any(node.id in chosen for node in walk(root))])


def _shade(window: MainWindow, shading: str, title: str) -> None:
    window.session.do("set_shading", shading, label=f"{title} shading")


def _shortcuts(window: MainWindow) -> None:
    from ..palette.shortcuts import Shortcuts

    Shortcuts(window.actions_, window).open()


def _cheat_sheet(window: MainWindow) -> None:
    from ..palette.cheat_sheet import CheatSheet

    CheatSheet(window.actions_, window).open()


def _tolerances(window: MainWindow) -> None:
    from ..tolerances import Tolerances

    def take(display: float, export: float) -> None:
        window.settings.set_tolerance("display", display)
        window.settings.set_tolerance("export", export)
        window.evaluation.set_tolerance(display)

    Tolerances(window, window.evaluation.tolerance, window.settings.tolerance("export"), take).open()


def _about(window: MainWindow) -> None:
    from ..dialogs import about

    about(window)


FILE_COMMANDS: tuple[Command, ...] = (
    Command("new", "New", "File", lambda w: w.files.new(), shortcut="Ctrl+N", icon="new", tip="An empty document"),
    Command("open", "Open …", "File", lambda w: w.files.ask_open(), shortcut="Ctrl+O", icon="open",
            tip="A project, or a mesh file or a drawing as a new document", toolbar=True),
    Command("save", "Save", "File", lambda w: w.files.save(), shortcut="Ctrl+S", icon="save",
            tip="Write the project to its file", toolbar=True),
    Command("save_as", "Save as …", "File", lambda w: w.files.save_as(), shortcut="Ctrl+Shift+S",
            tip="Write the project to another file"),
    Command("import", "Import …", "File", lambda w: w.files.ask_import(), shortcut="Ctrl+Shift+O", icon="import",
            tip="Add the solids of a mesh file, the outlines of a drawing, or another project"),
    Command("export", "Export …", "File", lambda w: w.files.ask_export(), _no_solid, "Ctrl+E", "export",
            "Write the visible solids as a mesh, or the outlines as a drawing, for other programs", True),
    Command("quit", "Quit", "File", lambda w: w.close(), shortcut="Ctrl+Q", icon="quit", tip="Close the window"),
)  # fmt: skip

VIEW_COMMANDS: tuple[Command, ...] = (
    Command("rename", "Rename", "Edit", lambda w: w.tree.rename_selected(), _selected, "F2", "",
            "Give the selected node a name; several get what is typed, each with its number"),
    Command("select_all", "Select all", "Edit", _select_all, _nothing, "Ctrl+A", tip="Select every solid and outline"),
    Command("invert", "Invert selection", "Edit", _invert, _nothing, "Ctrl+Shift+A",
            tip="Select the solids and outlines in which nothing is selected"),
    Command("evaluate", "Evaluate again", "Edit", lambda w: w.evaluation.ask(), _nothing, "F5",
            tip="Compute all solids, as after a cancelled evaluation"),
    Command("cancel", "Cancel evaluation", "Edit", lambda w: w.evaluation.cancel(), _busy, "Ctrl+.", "cancel",
            "Give up what is being computed; what is shown stays"),
    Command("fit", "Fit all", "View", lambda w: w.viewport.fit(), shortcut="Home", icon="fit",
            tip="Show all solids", toolbar=True),
    Command("fit_selection", "Fit selection", "View", lambda w: w.viewport.fit_selection(), _selected, "F", "",
            "Show what is selected"),
    *(
        Command(f"view_{name}", title, "View", lambda w, name=name: w.viewport.look_from(name), shortcut=keys,
                icon=f"view_{name}", tip="Seen from a corner" if name == "iso" else f"The model seen from the {name}")
        for name, title, keys in VIEWS
    ),
    Command("tolerances", "Tolerances …", "View", _tolerances, icon="tolerances",
            tip="How fine curved surfaces are: in the picture, and in what is exported"),
    Command("perspective", "Perspective", "View", lambda w: w.looks.set_parallel(not w.looks.parallel), shortcut="P",
            icon="perspective", tip="Perspective, or parallel projection", toolbar=True,
            checked=lambda w: not w.looks.parallel),
    Command("grid", "Ground grid", "View", lambda w: w.looks.set_grid(not w.looks.grid), shortcut="G", icon="grid",
            tip="The grid on the ground plane", toolbar=True, checked=lambda w: w.looks.grid),
    Command("ghosts", "Ghosts of operands", "View", lambda w: w.looks.set_ghosts(not w.looks.ghosts),
            shortcut="Shift+G",
            icon="ghosts", tip="Selected operands that the result does not show as they are",
            checked=lambda w: w.looks.ghosts),
    Command("colour_by_node", "Colour by node", "View",
            lambda w: w.looks.set_colour_by_node(not w.looks.colour_by_node),
            shortcut="C", icon="colour_by_node", tip="A colour for each node, on the faces that it made",
            checked=lambda w: w.looks.colour_by_node),
    *(
        Command(f"style_{name}", title, "View/Style", lambda w, name=name: w.looks.set_style(name), shortcut=keys,
                icon=name, tip=tip, checked=lambda w, name=name: w.looks.style == name)
        for name, title, keys, tip in STYLES
    ),
    *(
        Command(f"shading_{name}", title, "View/Shading", lambda w, name=name, title=title: _shade(w, name, title),
                tip=f"{tip}; kept with the document, for all that has no shading of its own",
                checked=lambda w, name=name: (w.session.document.shading or "phong") == name)
        for name, title, tip in SHADINGS
    ),
    *(
        Command(f"theme_{name}", title, "View/Theme", lambda w, name=name: w.theme.choose(name),
                tip="Light or dark" if name == "system" else f"The {name} theme",
                icon="theme" if name == "system" else "", checked=lambda w, name=name: w.theme.choice == name)
        for name, title in THEMES
    ),
    Command("palette", "Find a command …", "Help", lambda w: w.palette_.open(), shortcut="Ctrl+K", icon="palette",
            tip="Every command by a few of its letters"),
    Command("tool_menu", "Tools at the pointer", "Tools", lambda w: w.space_bar.open(), icon="tool_menu",
            tip="A menu of what can be done with the selection; Space opens it, in the picture and in the tree"),
    Command("cheat_sheet", "Keys and mouse", "Help", _cheat_sheet, shortcut="F1; ?",
            icon="cheat_sheet", tip="All keys, and what the mouse does"),
    Command("shortcuts", "Keyboard shortcuts …", "Help", _shortcuts, icon="shortcuts",
            tip="Look up the keys of a command, and change them"),
    Command("about", "About Solidtree", "Help", _about, icon="about", tip="Version and licences"),
)  # fmt: skip

TOOL_BAR = (
    "open", "save", "", "undo", "redo", "", "handles_move", "handles_turn", "handles_scale", "handles_size", "",
    "add_box", "add_sphere", "add_cylinder", "add_cone", "add_torus", "add_halfspace", "add_extrude", "add_revolve", "",
    "union", "difference", "intersection", "",
    "fit", "view_iso", "",
    "style_shaded", "style_edges", "style_wireframe", "style_hidden-line", "",
    "perspective", "grid", "hidden_surface", "", "measure", "", "export",
)  # fmt: skip
