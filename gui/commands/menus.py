"""The menu bar: the table of commands, and the submenus whose entries are files and docks."""

from __future__ import annotations

from collections.abc import Iterable
from importlib.resources import as_file, files
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtWidgets import QMenu

from ... import resources
from ...model.editing.commands import Command
from ..icons import icon
from .arrange import ARRANGE_SEPARATORS
from .mesh import MESH_SEPARATORS
from .normals import NORMAL_SEPARATORS
from .surfaces import SURFACE_SEPARATORS

if TYPE_CHECKING:
    from ..window import MainWindow

PROJECT = ".solidtree"
ORDER = {
    "File": "new open recent examples - save save_as - import export export_drawing export_diagram - quit",
    "Edit": "undo redo - cut copy paste copy_script duplicate delete - rename dissolve link unlink Edit/Order - "
    "toggle_visible show_hidden - select_all invert Edit/Select find - Edit/Parameters - evaluate cancel",
    "Add": "add_box add_sphere add_cylinder add_cone add_torus add_halfspace add_relief - add_extrude add_revolve - "
    "add_rectangle add_circle add_polygon add_lettering",
    "Combine": "union difference intersection hull minkowski - group Combine/Change_to - "
    "linear_array polar_array mirror displace",
    "Curve": "draw_pen draw_freehand draw_rectangle draw_ellipse draw_polygon draw_star draw_arc draw_control_points "
    "draw_through_points - Curve/Work_plane look_at_plane - extrude revolve sweep loft pipe wrap - "
    "text_on_path stencil - engrave emboss - "
    "Curve/Nodes Curve/Nodes_become Curve/Segments_become Curve/Joints Curve/Align_nodes transform_box - "
    "unite_outlines subtract_outlines intersect_outlines "
    "exclude_outlines - offset_outline stroke_outline "
    "convert_to_path convert_to_bspline - elevate_degree reduce_degree refine_knots - "
    "reverse_contours split_outline - mirror_outline_x mirror_outline_y - edit_font Curve/Fonts - "
    "curve_panel curvature_comb construction",
    "Tools": "handles_move handles_turn handles_scale handles_size - local_axes snapping "
    "Tools/Contacts_while_dragging - Tools/Arrange - "
    "measure clear_measurements line_of_sight ray_from_face seen_from_here visibility_map "
    "Tools/Sections Tools/Surfaces Tools/Normals "
    "Tools/Mesh bitmap_inspector follow_vertex - faults repair_faults - "
    "clearance meant_to_touch clearance_report - motion_panel play_motion - tool_menu",
    "View": "fit fit_selection - isolate show_all - view_iso view_front view_top view_right view_back view_bottom "
    "view_left - perspective tolerances grid ghosts face_normals vertex_normals colour_by_node translucent sections "
    "cull_back_faces automatic_clipping - hidden_surface "
    "View/Hidden_surfaces View/Style View/Shading View/Theme - "
    "diagram bsp_panel surfaces_panel mesh_panel pipeline_panel panels",
    "Help": "palette cheat_sheet shortcuts - about",
}
"""What stands in a menu and in which order: commands, submenus by place or by a name of their own, - for separators.

A command that is not named here stands at the top, so that it is seen.
"""


WITHIN = {"Tools/Mesh": ("Tools/Mesh elements", "Tools/Walk along edges", "Tools/Edit mesh")}
"""Submenus that stand at the end of another one."""


def in_menu_order(menu: str, commands: Iterable[Command]) -> list[Command]:
    """Those of the commands that stand in a menu or in its submenus, from top to bottom."""
    places = {name: place for place, name in enumerate(ORDER.get(menu, "").split())}

    def place(command: Command) -> int:
        outer = next((outer for outer, inner in WITHIN.items() if command.menu in inner), command.menu)
        return places.get(command.name, places.get(outer.replace(" ", "_"), -1))

    return sorted((command for command in commands if command.menu.split("/")[0] == menu), key=place)


def fill_menus(window: MainWindow) -> None:
    menus = window.actions_.fill_menu_bar(window.menuBar())
    file_menu = menus["File"]
    recent = QMenu("Open recent", file_menu)
    recent.setToolTipsVisible(True)
    recent.aboutToShow.connect(lambda: _fill_recent(window, recent))
    examples = QMenu("Examples", file_menu)
    examples.setIcon(icon("examples"))
    examples.aboutToShow.connect(lambda: _fill_examples(window, examples))
    panels = QMenu("Panels", menus["View"])
    panels.aboutToShow.connect(lambda: panels.addActions(window.docks_menu_entries))
    entries = {place.replace(" ", "_"): menu.menuAction() for place, menu in menus.items()}
    entries |= {"recent": recent.menuAction(), "examples": examples.menuAction(), "panels": panels.menuAction()}
    for title, order in ORDER.items():
        for name in order.split():
            if name == "-":
                menus[title].addSeparator()
            else:
                menus[title].addAction(entries.get(name) or window.actions_[name])  # moves it to the end
    for place, inner in WITHIN.items():
        menus[place].addSeparator()
        for name in inner:
            menus[name.split("/")[0]].removeAction(menus[name].menuAction())
            menus[place].addMenu(menus[name])
    for place, names in (
        ("Tools/Arrange", ARRANGE_SEPARATORS),
        ("Tools/Surfaces", SURFACE_SEPARATORS),
        ("Tools/Normals", NORMAL_SEPARATORS),
        ("Tools/Mesh", MESH_SEPARATORS),
    ):
        for name in names:
            menus[place].insertSeparator(window.actions_[name])


def _fill_recent(window: MainWindow, menu: QMenu) -> None:
    menu.clear()
    for path in window.settings.recent:
        action = menu.addAction(Path(path).name, lambda path=path: window.files.open(path))
        action.setToolTip(path)
    if menu.isEmpty():
        menu.addAction("None yet").setEnabled(False)
        return
    menu.addSeparator()
    menu.addAction("Forget all", lambda: (window.settings.forget_recent(), window.files.path_changed.emit()))


def example_names() -> list[str]:
    folder = files(resources).joinpath("examples")
    return sorted(file.name.removesuffix(PROJECT) for file in folder.iterdir() if file.name.endswith(PROJECT))


def open_example(window: MainWindow, name: str) -> None:
    """Open an example as an unsaved document."""
    with as_file(files(resources).joinpath("examples", name + PROJECT)) as path:
        kept = Path(path)
    window.files.guard(lambda: window.files.read(kept, example=True))


def _fill_examples(window: MainWindow, menu: QMenu) -> None:
    menu.clear()
    for name in example_names():
        menu.addAction(name.replace("_", " ").capitalize(), lambda name=name: open_example(window, name))
    if menu.isEmpty():
        menu.addAction("None").setEnabled(False)
