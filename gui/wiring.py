"""The signals between the parts of the window: who hears of what."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .commands.parameters import ask_export, ask_import
from .curves.editing.node_menu import open_node_menu
from .view.pointer_menu import open_pointer_menu

if TYPE_CHECKING:
    from .window import MainWindow


def connect(window: MainWindow) -> None:
    """Connect the parts of a window, once, when all of them are there."""
    _words(window)
    _evaluation(window)
    _measuring(window)
    _drawing(window)
    _editing(window)
    _surfaces(window)
    _mesh(window)
    window.parameters.sets.import_asked.connect(lambda: ask_import(window))
    window.parameters.sets.export_asked.connect(lambda: ask_export(window))
    window.files.path_changed.connect(window.follow_title)
    window.files.path_changed.connect(window.follow_recent)
    window.files.opened.connect(window.opened)
    window.section_tool.chosen.connect(window.actions_.refresh)
    window.viewport.menu_asked.connect(
        lambda under, place: open_pointer_menu(window.viewport, window.session, window.actions_, under, place)
    )
    window.problems.counted.connect(window.count_problems)
    window.docks["Diagram"].visibilityChanged.connect(window.diagram.set_in_front)
    _faults(window)
    _motion(window)
    _clearance(window)
    window.docks["BSP"].visibilityChanged.connect(window.bsp.set_in_front)
    _pipeline(window)
    window.docks["Curve"].visibilityChanged.connect(window.curve_panel.set_in_front)
    window.docks["Curve"].visibilityChanged.connect(window.actions_.refresh)
    window.curve_panel.seen.connect(window.joints_page.set_seen)
    window.construction.switched.connect(window.actions_.refresh)
    window.theme.changed.connect(lambda name: window.viewport.change(lambda viewer: viewer.set_theme(name)))
    window.theme.changed.connect(window.retint)
    window.welcome.open_asked.connect(window.files.open)


def _words(window: MainWindow) -> None:
    """What the status bar says: refusals, hints, what is under the pointer."""
    status = window.status
    for part in (
        window.tree,
        window.diagram,
        window.properties,
        window.parameters,
        window.sections,
        window.section_tool,
        window.actions_,
        window.handles,
        window.place_on_face,
        window.bsp,
        window.curve,
        window.surfaces,
        window.pipeline,
        window.mesh,
        window.faults,
        window.motion,
        window.clearance,
        window.light_tool,
        window.mapping_tool,
    ):
        part.refused.connect(status.say)
    for said in (
        window.handles.hint,
        window.evaluation.notice,
        window.files.notice,
        window.figure_use.said,
        window.measure.said,
        window.needles.said,
    ):
        said.connect(status.say)
    window.place_on_face.said.connect(status.set_hint)
    window.sight.said.connect(status.set_hint)
    window.bsp.probe.said.connect(status.set_hint)
    window.section_tool.said.connect(status.set_hover)
    window.viewport.hovered.connect(status.set_hover)
    window.files.background.busy.connect(lambda words: status.say(words + " …" if words else ""))


def _evaluation(window: MainWindow) -> None:
    evaluation, status = window.evaluation, window.status
    evaluation.shown.connect(window.shown)
    evaluation.shown.connect(window.sections.measure)
    evaluation.examined.connect(window.examined)
    evaluation.examined.connect(window.measure_selection)
    evaluation.busy.connect(window.busy)
    evaluation.outdated.connect(status.set_outdated)
    evaluation.progress.connect(status.set_progress)
    status.cancel_asked.connect(evaluation.cancel)
    hidden = window.hidden_surfaces
    hidden.changed.connect(lambda: status.set_hidden_surface(*hidden.words))
    hidden.mode_changed.connect(window.actions_.refresh)
    status.problems_asked.connect(window.show_problems)


def _measuring(window: MainWindow) -> None:
    tool, panel = window.measure, window.measurements

    def follow() -> None:
        panel.set_taken(tool.taken, tool.current)
        window.actions_.refresh()

    tool.changed.connect(follow)
    tool.began.connect(lambda: window.handles.set_hidden(True))
    tool.ended.connect(lambda: window.handles.set_hidden(False))
    tool.ended.connect(window.actions_.refresh)
    window.sight.began.connect(lambda: window.handles.set_hidden(True))
    window.sight.ended.connect(lambda: window.handles.set_hidden(False))
    window.sight.ended.connect(window.actions_.refresh)
    window.files.opened.connect(window.sight.end)
    panel.chosen.connect(tool.choose)
    panel.removed.connect(tool.remove)
    panel.cleared.connect(tool.clear)
    panel.start_asked.connect(lambda: window.actions_.run("measure"))
    window.files.opened.connect(tool.clear)
    window.files.opened.connect(tool.end)


def _pipeline(window: MainWindow) -> None:
    tool = window.pipeline.tool
    window.docks["Pipeline"].visibilityChanged.connect(window.pipeline.set_in_front)
    tool.said.connect(window.status.set_hint)
    others = (window.measure, window.sight, window.draw, window.face_plane, window.engrave)
    for other in (*others, window.place_on_face, window.bsp.probe):
        tool.began.connect(other.end)
    for other in others:
        other.began.connect(tool.end)
    tool.began.connect(lambda: window.handles.set_hidden(True))
    tool.ended.connect(lambda: window.handles.set_hidden(False))
    for signal in (tool.began, tool.ended):
        signal.connect(window.actions_.refresh)
    window.files.opened.connect(window.pipeline.forget)
    window.files.opened.connect(lambda: window.looks.set_clipping(None))


def _editing(window: MainWindow) -> None:
    """The nodes of the outline that is edited, and what can be done to them."""
    tool = window.edit_tool
    tool.said.connect(window.status.set_hint)
    tool.menu_asked.connect(lambda place: open_node_menu(window.actions_, window.curve, window.viewport, place))
    tool.box_changed.connect(window.actions_.refresh)
    window.spline_page.told.connect(window.status.say)
    window.curve.changed.connect(lambda: None if window.session.previewing else window.actions_.refresh())


def _faults(window: MainWindow) -> None:
    """What comes in from a file is looked at; the panel comes to the front where that has faults."""
    panel = window.faults
    window.docks["Faults"].visibilityChanged.connect(panel.set_in_front)
    window.docks["Faults"].visibilityChanged.connect(window.actions_.refresh)
    window.files.opened.connect(panel.document_opened)
    window.files.brought_in.connect(panel.checks.look_at_arrivals)
    panel.said.connect(window.status.say)
    panel.listed.connect(window.actions_.refresh)

    def show(words: str) -> None:
        window.show_faults()
        window.status.say(words)

    def made() -> None:
        """The clicks and the handles' place are the other tools': a fault in the picture and they give way in turn."""
        picture, mesh = panel.picture, window.mesh
        assert picture is not None
        tools = (window.measure, window.sight, window.draw, window.face_plane, window.engrave, window.pipeline.tool)

        def begin() -> None:
            for other in (*tools, window.mapping_tool, *((mesh.inspector.tool,) if mesh.inspector else ())):
                other.end()
            window.handles.set_hidden(True)  # the ends of the others have shown them

        def give_way() -> None:
            panel.leave()
            window.handles.set_hidden(True)

        def pair() -> None:
            if mesh.inspector is not None:
                mesh.inspector.tool.began.connect(give_way)

        picture.began.connect(begin)
        picture.ended.connect(lambda: window.handles.set_hidden(False))
        for other in (*tools, window.mapping_tool):
            other.began.connect(give_way)
        pair()
        mesh.made.connect(pair)

    panel.dirty.connect(show)
    panel.made.connect(made)


def _motion(window: MainWindow) -> None:
    panel = window.motion
    window.docks["Motion"].visibilityChanged.connect(panel.set_in_front)
    window.docks["Motion"].visibilityChanged.connect(window.actions_.refresh)
    window.files.opened.connect(panel.document_opened)
    panel.listed.connect(window.actions_.refresh)


def _clearance(window: MainWindow) -> None:
    """A pair in the picture, a fault there and the tools that have the clicks give way to one another."""
    panel = window.clearance
    window.docks["Clearance"].visibilityChanged.connect(panel.set_in_front)
    window.docks["Clearance"].visibilityChanged.connect(window.actions_.refresh)
    window.files.opened.connect(panel.document_opened)
    panel.said.connect(window.status.say)

    def made() -> None:
        assert panel.picture is not None
        panel.picture.began.connect(window.faults.leave)
        for tool in (window.measure, window.sight, window.draw, window.face_plane, window.engrave):
            tool.began.connect(panel.leave)

    panel.made.connect(made)


def _drawing(window: MainWindow) -> None:
    """One tool has the clicks; the handles give way to it."""
    draw, face = window.draw, window.face_plane
    for tool in (draw, face, window.engrave):
        tool.said.connect(window.status.set_hint)
        tool.began.connect(lambda: window.handles.set_hidden(True))
        tool.ended.connect(lambda: window.handles.set_hidden(False))
        tool.ended.connect(window.actions_.refresh)
        window.measure.began.connect(tool.end)
        window.sight.began.connect(tool.end)
        window.files.opened.connect(tool.end)
    draw.began.connect(window.engrave.end)
    face.began.connect(window.engrave.end)
    draw.refused.connect(window.status.say)
    window.engrave.refused.connect(window.status.say)
    draw.began.connect(window.follow_empty)
    draw.ended.connect(window.follow_empty)
    face.taken.connect(lambda: draw.start(face.resumed) if face.resumed else None)
    window.work_plane.changed.connect(window.actions_.refresh)


def _surfaces(window: MainWindow) -> None:
    """The Surfaces panel chooses whose handles are in the picture; those of nodes give way to a texture's."""
    panel, light, mapping = window.surfaces, window.light_tool, window.mapping_tool
    window.docks["Surfaces"].visibilityChanged.connect(panel.set_in_front)
    panel.light_chosen.connect(light.choose)
    panel.chosen.connect(lambda: None if window.session.previewing else window.actions_.refresh())
    light.picked.connect(panel.choose_light)
    for tool in (light, mapping):
        tool.said.connect(window.status.set_hint)
    mapping.began.connect(lambda: window.handles.set_hidden(True))
    mapping.ended.connect(lambda: window.handles.set_hidden(False))
    mapping.ended.connect(window.actions_.refresh)

    def give_way() -> None:
        mapping.end()
        light.set_aside(True)
        window.handles.set_hidden(True)  # the end of the placement has shown them

    tools = (window.measure, window.sight, window.draw, window.face_plane, window.engrave, window.pipeline.tool)
    for other in tools:
        other.began.connect(give_way)
        other.ended.connect(lambda: light.set_aside(False))
    window.files.opened.connect(mapping.end)


def _mesh(window: MainWindow) -> None:
    """The clicks are the Mesh panel's while it is in front, until another tool begins."""
    window.docks["Mesh"].visibilityChanged.connect(window.mesh.set_in_front)

    def made() -> None:
        inspector = window.mesh.inspector
        assert inspector is not None
        tool = inspector.tool
        tool.said.connect(window.status.set_hint)
        tool.began.connect(lambda: window.handles.set_hidden(True))
        tool.ended.connect(lambda: window.handles.set_hidden(False))
        others = (window.measure, window.sight, window.draw, window.face_plane, window.engrave, window.pipeline.tool)
        for other in others:
            tool.began.connect(other.end)
        for other in (*others, window.mapping_tool):
            other.began.connect(tool.end)
        for signal in (tool.began, tool.ended):
            signal.connect(window.actions_.refresh)

    window.mesh.made.connect(made)
