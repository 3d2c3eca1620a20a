"""The window's commands on the Mesh panel. They take the MainWindow."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from ...model.document.errors import Refusal
from ...model.editing.commands import Command

if TYPE_CHECKING:
    from ..mesh.inspector import MeshInspector
    from ..window import MainWindow

MENU = "Tools/Mesh"
EDIT = "Tools/Edit mesh"
MODES = "Tools/Mesh elements"


def _panel(window: MainWindow) -> None:
    """Bring the panel to the front, or the properties where it is there already."""
    dock = window.docks["Properties" if window.mesh.in_front else "Mesh"]
    dock.show()
    dock.raise_()


def _inspector(window: MainWindow) -> MeshInspector:
    found = window.mesh.inspector
    assert found is not None
    return found


def _closed(window: MainWindow) -> str | None:
    inspector = window.mesh.inspector
    if inspector is None or not window.mesh.in_front:
        return "open the Mesh panel first"
    return None if inspector.mesh is not None else "there is no mesh to look into"


def _none(window: MainWindow) -> str | None:
    return _closed(window) or (None if _inspector(window).chosen.count else "choose a vertex, an edge or a face first")


def _no_edge(window: MainWindow) -> str | None:
    fault = _closed(window)
    if fault:
        return fault
    chosen = _inspector(window).chosen
    return None if chosen.kind == "edge" and chosen.current >= 0 else "choose an edge first"


def _no_face(window: MainWindow) -> str | None:
    return _closed(window) or (None if _inspector(window).maker else "choose a face that a node made first")


def _stuck(step: str) -> Callable[[MainWindow], str | None]:
    def fault(window: MainWindow) -> str | None:
        if _closed(window) or _inspector(window).chosen.edge < 0:
            return _closed(window) or "choose one edge first"
        return None if _inspector(window).chosen.next_edge(step)[0] >= 0 else "the surface has a border there"

    return fault


def _walk(step: str) -> Callable[[MainWindow], None]:
    def run(window: MainWindow) -> None:
        inspector = _inspector(window)
        inspector.chosen.walk(step)
        inspector.show_table("edges")

    return run


def _mode(name: str) -> Callable[[MainWindow], None]:
    return lambda window: _inspector(window).set_mode(name)


def _in_mode(name: str) -> Callable[[MainWindow], bool]:
    def checked(window: MainWindow) -> bool:
        inspector = window.mesh.inspector
        return inspector is not None and inspector.picking and inspector.tool.mode == name

    return checked


def _choose(name: str) -> Callable[[MainWindow], None]:
    return lambda window: _inspector(window).choose(name)


def _convert(kind: str) -> Callable[[MainWindow], None]:
    def run(window: MainWindow) -> None:
        inspector = _inspector(window)
        inspector.chosen.convert(kind)  # type: ignore[arg-type]
        inspector.show_table({"vertex": "vertices", "edge": "edges", "face": "faces"}[kind])

    return run


def _select_node(window: MainWindow) -> None:
    window.session.select((_inspector(window).maker,))


def _look(window: MainWindow) -> None:
    inspector = _inspector(window)
    inspector.look_at(inspector.chosen.kind, int(inspector.chosen.numbers[0]) if inspector.chosen.current < 0
                      else inspector.chosen.current)  # fmt: skip


def _not_editable(*kinds: str) -> Callable[[MainWindow], str | None]:
    """A fault for edits of such elements; none named: of all."""

    def fault(window: MainWindow) -> str | None:
        if _none(window):
            return _none(window)
        chosen = _inspector(window).chosen
        if kinds == ("edge",) and chosen.edge < 0:
            return "choose one edge first"
        if kinds and chosen.kind not in kinds:
            return "choose a face first"
        return _inspector(window).editing.fault()

    return fault


def _edit(name: str) -> Callable[[MainWindow], None]:
    return lambda window: _inspector(window).editing.run(name)


def _ask_move(window: MainWindow) -> None:
    from PySide6.QtCore import Qt
    from PySide6.QtWidgets import QInputDialog

    from ..partition.model_page import point_from

    def move(text: str) -> None:
        try:
            _inspector(window).editing.move(point_from(text))
        except Refusal as refusal:
            window.actions_.refused.emit(str(refusal))

    dialog = QInputDialog(window)
    dialog.setWindowTitle("Move vertices")
    dialog.setLabelText("By x, y, z in mm, along the node's own axes:")
    dialog.setTextValue("0, 0, 1")
    dialog.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
    dialog.textValueSelected.connect(move)
    dialog.open()


def _convert_to_mesh(window: MainWindow) -> None:
    inspector = _inspector(window)
    inspector.editing.convert(inspector.source.solid)


def _chooses(name: str, title: str, tip: str, fault: Callable[[MainWindow], str | None] = _closed) -> Command:
    return Command(f"mesh_choose_{name}", title, MENU, _choose(name), fault, tip=tip)


def _walks(step: str, title: str, key: str, tip: str) -> Command:
    return Command(f"mesh_{step}", title, "Tools/Walk along edges", _walk(step), _stuck(step), key, tip=tip)


def _modes(name: str, title: str, key: str, tip: str) -> Command:
    return Command(f"mesh_{name}", title, MODES, _mode(name), _closed, key, tip=tip, checked=_in_mode(name))


MESH_SEPARATORS = (
    "mesh_choose_grow", "mesh_choose_sharp", "mesh_choose_loop", "mesh_choose_of_maker", "mesh_to_vertices",
    "mesh_select_node", "mesh_copy",
)  # fmt: skip
"""Before these a line is drawn in the menu."""
MESH_COMMANDS: tuple[Command, ...] = (
    Command("mesh_panel", "Mesh inspector", "View", _panel, shortcut="Alt+W", icon="mesh_panel",
            tip="The vertices, normals, faces and edges of a solid as lists, linked with the picture; the winged edge"),
    _modes("vertex", "Choose vertices", "Ctrl+1", "Click a vertex of the inspected solid"),
    _modes("edge", "Choose edges", "Ctrl+2", "Click an edge: its wings are drawn, with arrows for the loops"),
    _modes("face", "Choose faces", "Ctrl+3", "Click a face: which node made it is told below the table"),
    _modes("loop", "Choose loops", "Ctrl+4", "Click in a face, near the loop that is meant"),
    _modes("chain", "Choose chains", "Ctrl+5", "Click an edge: those that go on smoothly from it are chosen too"),
    _walks("left_before", "Back along the left face", ",",
           "The edge before on the face on the left; pressed again, it stays with that face"),
    _walks("left_after", "On along the left face", ".",
           "The edge after on the face on the left; pressed again, it stays with that face"),
    _walks("right_before", "Back along the right face", "<", "The edge before on the face on the right"),
    _walks("right_after", "On along the right face", ">", "The edge after on the face on the right"),
    _walks("start_turned", "Round the start", "[", "The next edge at the vertex it begins at, counter-clockwise"),
    _walks("start_back", "Round the start, clockwise", "]", "The next edge at the vertex it begins at, clockwise"),
    _walks("end_turned", "Round the end", "{", "The next edge at the vertex it runs to, counter-clockwise"),
    _walks("end_back", "Round the end, clockwise", "}", "The next edge at the vertex it runs to, clockwise"),
    _chooses("all", "Choose all", "All vertices, edges or faces, whichever were chosen last"),
    _chooses("none", "Choose nothing", "No element is chosen any more", _none),
    _chooses("invert", "Choose the others", "What is not chosen instead of what is"),
    _chooses("grow", "Grow", "With what touches the chosen elements", _none),
    _chooses("shrink", "Shrink", "Without those that touch something else", _none),
    _chooses("sharp", "Sharp edges", "Edges at which the surface turns by so many degrees as the list of edges says"),
    _chooses("convex", "Convex edges", "Edges at which the surface turns away"),
    _chooses("concave", "Concave edges", "Edges at which it turns towards itself"),
    _chooses("short", "Short edges", "Edges no longer than the list of edges says"),
    _chooses("naked", "Naked edges", "Edges with a face on one side only"),
    _chooses("non_manifold", "Non-manifold edges", "Edges with more than two faces"),
    _chooses("loop", "Loop of the edge", "The loop of the face on its left; of a naked edge the border", _no_edge),
    _chooses("chain", "Chain of the edge", "The edges that go on smoothly from it", _no_edge),
    _chooses("border", "Border of the faces", "The edges between the chosen faces and others", _none),
    _chooses("of_maker", "Faces of the same node", "All that the node made which made the chosen ones", _none),
    _chooses("of_nodes", "Faces of selected nodes", "All that the nodes made which are selected in the tree"),
    _chooses("same_way", "Faces that look the same way", "Within a degree of the chosen ones", _none),
    _chooses("no_larger", "Faces no larger", "All with at most the area of the largest chosen one", _none),
    _chooses("smooth", "Faces up to sharp edges",
             "What hangs together with the chosen faces by edges that are not sharp", _none),
    _chooses("connected", "Connected faces", "All that hangs together with the chosen ones", _none),
    Command("mesh_to_vertices", "As vertices", MENU, _convert("vertex"), _none, tip="The corners of what is chosen"),
    Command("mesh_to_edges", "As edges", MENU, _convert("edge"), _none,
            tip="The edges of chosen faces, or those between chosen vertices"),
    Command("mesh_to_faces", "As faces", MENU, _convert("face"), _none, tip="The faces whose edges are all chosen"),
    Command("mesh_split_edge", "Split edge", EDIT, _edit("split_edge"), _not_editable("edge"),
            tip="Put a vertex into its middle"),
    Command("mesh_flip_edge", "Flip edge", EDIT, _edit("flip_edge"), _not_editable("edge"),
            tip="Turn it between its two triangles, so that it joins their other corners"),
    Command("mesh_collapse_edge", "Collapse edge", EDIT, _edit("collapse_edge"), _not_editable("edge"),
            tip="Make its two ends one in its middle; the triangles beside it are gone"),
    Command("mesh_split_face", "Split triangle", EDIT, _edit("split_face"), _not_editable("face"),
            tip="Put a vertex into its middle"),
    Command("mesh_reverse_faces", "Reverse faces", EDIT, _edit("reverse_faces"), _not_editable("face"),
            tip="Turn the chosen faces round, so that their other side is outside"),
    Command("mesh_delete_faces", "Delete faces", EDIT, _edit("delete_faces"), _not_editable("face"),
            tip="Take the chosen faces out of the mesh"),
    Command("mesh_move_vertices", "Move vertices \u2026", EDIT, _ask_move, _not_editable(),
            tip="Move the vertices of what is chosen by three numbers"),
    Command("mesh_convert", "Convert solid to mesh", EDIT, _convert_to_mesh, _closed,
            tip="Make one mesh of the inspected solid, whose elements can be edited; its operands are gone"),
    Command("mesh_select_node", "Select the node of the face", MENU, _select_node, _no_face,
            tip="Select in the tree what made the face"),
    Command("mesh_look_at", "Zoom to the element", MENU, _look, _none, icon="fit_selection",
            tip="Bring the camera near to it; a double click on its row does the same"),
    Command("mesh_copy", "Copy rows", MENU, lambda w: _inspector(w).copy(), _closed, icon="copy",
            tip="The chosen rows of the open table, or all that are listed, to paste into a spreadsheet"),
    Command("mesh_save", "Save table as CSV …", MENU, lambda w: _inspector(w).save(), _closed, icon="save",
            tip="What is listed in the open table, figures as exact as they are"),
)  # fmt: skip
