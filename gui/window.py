"""The main window: docks around the picture, and the wiring between session, worker and views."""

from __future__ import annotations

from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QTimer
from PySide6.QtGui import QCloseEvent, QDragEnterEvent, QDropEvent, QShowEvent
from PySide6.QtWidgets import QApplication, QMainWindow

from ..model.editing.session import Session, State
from ..model.surface.faults import bitmap_faults
from .clearance.panel import ClearancePanel
from .commands.actions import Actions
from .commands.menus import fill_menus
from .commands.nodes import NODE_BUTTONS
from .commands.tables import add_commands
from .commands.views import TOOL_BAR
from .curves.active import ActiveCurve
from .curves.comb import CombView
from .curves.construction import ConstructionView
from .curves.construction_page import ConstructionPage
from .curves.drawing.draw_bar import DrawBar
from .curves.drawing.draw_tool import DrawTool
from .curves.drawing.face_plane_tool import FacePlaneTool
from .curves.drawing.work_plane import WorkPlane
from .curves.editing.edit_tool import EditTool
from .curves.joints_page import JointsPage
from .curves.nodes_page import NodesPage
from .curves.panel import CurvePanel
from .curves.splines.spline_page import SplinePage
from .docks import FAULTS_HEIGHT, arrange, give_sizes, raise_dock, switch_layout
from .evaluation import Evaluation
from .faults.panel import FaultsPanel
from .files import Files
from .hidden_surfaces import HiddenSurfaces
from .looks import Looks
from .mesh.panel import MeshPanel
from .motion.panel import MotionPanel
from .normals.needle_view import NeedleView
from .palette.palette import Palette
from .panels.figures import FigureUse
from .panels.measured import measured
from .panels.measurements import Measurements
from .panels.problems import Problems
from .panels.properties import Properties
from .panels.script_log import ScriptLog
from .panels.sections import Sections
from .parameters.parameters import Parameters
from .partition.panel import BspPanel
from .pipeline.panel import PipelinePanel, let_float
from .settings import LAYOUT_VERSION, Settings
from .side_windows import SideWindows
from .status import StatusBar, shown_solids
from .surfaces.handles.light_tool import LightTool
from .surfaces.handles.mapping_tool import MappingTool
from .surfaces.panel import SurfacesPanel
from .theme import Theme
from .tools.engrave_tool import EngraveTool
from .tools.handles import Handles
from .tools.measure import MeasureTool
from .tools.place_on_face import PlaceOnFace
from .tools.section_tool import SectionTool
from .tools.sight.tool import SightTool
from .tools.tool_menu import SpaceBar
from .tree.diagram import Diagram
from .tree.model_panel import ModelPanel
from .tree.tree import Tree
from .view.ghosts import OperandGhosts
from .view.isolation import IsolationCard
from .view.thumbnail import thumbnail
from .view.viewport import Viewport
from .view.welcome import Welcome
from .wiring import connect

if TYPE_CHECKING:
    from ..model.worker.shown import Shown

UNSEEN = 500  # milliseconds that the start waits for the window to appear


class MainWindow(QMainWindow):
    """One window on one session. `start` begins to draw and to evaluate; call it when the window is shown."""

    def __init__(
        self, session: Session | None = None, settings: Settings | None = None, theme: Theme | None = None
    ) -> None:
        super().__init__()
        self.setObjectName("window")
        self.session = session or Session()
        self.settings = settings or Settings()
        application = QApplication.instance()
        assert isinstance(application, QApplication)
        self.theme = theme or Theme(application, self.settings, self)
        self.evaluation = Evaluation(self.session, self)
        self.evaluation.set_tolerance(self.settings.tolerance("display"))
        self.looks = Looks(self)
        self.side_windows = SideWindows(self)
        self._closing = False
        self.curve = ActiveCurve(self.session, self)

        self.viewport = Viewport(self.session, self)
        self.setCentralWidget(self.viewport)
        self.operand_ghosts = OperandGhosts(self.viewport, self.session, self.evaluation, self.looks.ghosts)
        self.viewport.add_tool(self.operand_ghosts)
        self.hidden_surfaces = HiddenSurfaces(self.session, self.viewport, self.evaluation, self.settings, self)
        self.files = Files(self, self.session, self.evaluation, self.settings, self._picture)
        self.actions_ = Actions(self, self.settings)
        add_commands(self.actions_, self)
        self.section_tool = SectionTool(self.session, self.viewport, self)
        self.viewport.add_tool(self.section_tool)
        self.handles = Handles(
            self.viewport,
            self.session,
            self.settings,
            lambda: self.looks.ghosts,
            self.files.background,
            lambda: not self.evaluation.waiting,
        )
        self.viewport.add_tool(self.handles)
        self.edit_tool = EditTool(self.session, self.viewport, self.curve, self.handles, self.settings)
        self.viewport.add_tool(self.edit_tool)
        self.place_on_face = PlaceOnFace(self.session, self.viewport, lambda i: self.evaluation.parts.get(i), self)
        self.viewport.add_tool(self.place_on_face)
        self.engrave = EngraveTool(self.session, self.viewport, self)
        self.viewport.add_tool(self.engrave)
        self.measure = MeasureTool(self.session, self.viewport, self)
        self.viewport.add_tool(self.measure)
        self.sight = SightTool(self.session, self.viewport, self.hidden_surfaces, self)
        self.viewport.add_tool(self.sight)
        self.work_plane = WorkPlane(self.session, self.viewport, self)
        self.draw = DrawTool(self.session, self.viewport, self.work_plane, lambda: self.handles.snapping, self)
        self.viewport.add_tool(self.draw)
        self.face_plane = FacePlaneTool(self.viewport, self.work_plane, self)
        self.viewport.add_tool(self.face_plane)
        self.comb = CombView(self.curve, self.viewport, self.settings)
        self.viewport.add_tool(self.comb)
        self.construction = ConstructionView(self.curve, self.viewport)
        self.viewport.add_tool(self.construction)
        self.light_tool = LightTool(self.session, self.viewport, self)
        self.viewport.add_tool(self.light_tool)
        self.mapping_tool = MappingTool(self.session, self.viewport, self)
        self.viewport.add_tool(self.mapping_tool)
        self.needles = NeedleView(self.viewport, self.session)
        self.viewport.add_tool(self.needles)
        self.status = StatusBar(self)
        self.setStatusBar(self.status)
        self._make_docks()
        self.docks_menu_entries = [dock.toggleViewAction() for dock in self.docks.values()]
        fill_menus(self)
        tools = self.addToolBar("Tools")
        tools.setObjectName("tools")
        tools.setMovable(False)
        self.actions_.fill_tool_bar(tools, TOOL_BAR)
        self.docks_menu_entries.append(tools.toggleViewAction())
        self.viewport.add_tool(self.space_bar)
        self.welcome = Welcome(self.actions_, self.viewport)
        self.draw_bar = DrawBar(self.draw, self.actions_, self.viewport)
        self.isolation = IsolationCard(self.session, self.actions_, self.viewport)
        self.setAcceptDrops(True)
        self._unlisten = self.session.on_change(self._changed)
        connect(self)
        self._restore()
        self.follow_title()
        self.follow_recent()
        self._changed(self.session.state, self.session.state)
        self.looks.apply()

    def start(self, paths: list[str] | None = None) -> None:
        """Load VTK once the window is on the screen, or soon where it is not to be seen; then open the files."""
        self._paths = list(paths or [])
        self.viewport.exposed.connect(lambda: QTimer.singleShot(0, self, self._attach))
        QTimer.singleShot(UNSEEN, self, self._attach)

    def _attach(self) -> None:
        if self._closing or self.viewport.viewer is not None:
            return
        paths, self._paths = self._paths, []
        for path in paths[:1]:
            self.files.read(path)
        for path in paths[1:]:
            self.files.import_file(path)
        self.viewport.attach(self.theme.name)
        QTimer.singleShot(0, self.evaluation, self.evaluation.warm)  # what the user did meanwhile comes first

    # Parts.

    def _make_docks(self) -> None:
        self.tree = Tree(self.session, self.actions_, self)
        self.model_panel = ModelPanel(self.session, self.tree, self)
        self.diagram = Diagram(self.session, self.actions_, self)
        self.figure_use = FigureUse(self.session, self)
        self.properties = Properties(self.session, self.figure_use, self.actions_["texture_placement"], self)
        self.parameters = Parameters(self.session, self)
        self.problems = Problems(self.session, self)
        self.measurements = Measurements(self.figure_use, self)
        self.sections = Sections(self.session, self.section_tool, self.actions_, self.section_tool.figures, self)
        self.script = ScriptLog(self.session, self)
        self.bsp = BspPanel(self)
        self.surfaces = SurfacesPanel(self)
        self.pipeline = PipelinePanel(self)
        self.mesh = MeshPanel(self)
        self.faults = FaultsPanel(self)
        self.motion = MotionPanel(self)
        self.clearance = ClearancePanel(self)
        self.joints_page = JointsPage(self.curve, self.comb, self)
        nodes_page = NodesPage(self.curve, self.actions_, NODE_BUTTONS, self)
        construction_page = ConstructionPage(self.curve, self.construction, self)
        self.spline_page = SplinePage(self.curve, self)
        pages = {
            "Nodes": nodes_page,
            "Joints": self.joints_page,
            "Construction": construction_page,
            "B-spline": self.spline_page,
        }
        self.curve_panel = CurvePanel(self.curve, pages, self)
        self.docks = arrange(
            self,
            left={"Model": self.model_panel, "Diagram": self.diagram},
            right={
                "Properties": self.properties,
                "Curve": self.curve_panel,
                "Parameters": self.parameters,
                "BSP": self.bsp,
                "Surfaces": self.surfaces,
                "Pipeline": self.pipeline,
                "Mesh": self.mesh,
            },
            bottom={
                "Problems": self.problems,
                "Faults": self.faults,
                "Motion": self.motion,
                "Clearance": self.clearance,
                "Sections": self.sections,
                "Script": self.script,
                "Measure": self.measurements,
            },
        )
        self.docks["Surfaces"].hide()
        self.docks["Pipeline"].hide()
        let_float(self.docks["Pipeline"])
        self.docks["Mesh"].hide()

    # What happens.

    def _changed(self, before: State, after: State) -> None:
        after = self.session.state  # an earlier listener may have gone on
        for part in (
            self.curve,
            self.tree,
            self.model_panel,
            self.diagram,
            self.viewport,
            self.evaluation,
            self.hidden_surfaces,
            self.properties,
            self.parameters,
            self.sections,
            self.script,
            self.surfaces,
            self.mesh,
            self.faults,
            self.motion,
            self.clearance,
        ):
            part.session_changed(before, after)
        self.setWindowModified(self.session.modified)
        if self.session.previewing:
            return
        if before.document.materials != after.document.materials:
            self._tell_problems()
        self.follow_empty()
        self.isolation.follow()
        if before.selection != after.selection:
            self.measure_selection()
        for name, label in (("undo", self.session.undo_label), ("redo", self.session.redo_label)):
            title = name.capitalize()
            self.actions_[name].setText(f"{title} {label[0].lower()}{label[1:]}" if label else title)
        self.actions_.refresh()

    def follow_empty(self) -> None:
        """The welcome card stands in an empty picture, and gives way to what is drawn there."""
        self.welcome.set_empty(not self.session.document.roots and not self.draw.active)

    def shown(self, shown: Shown, seconds: float) -> None:
        meshes = shown.solids | shown.outlines
        if meshes or not any(problem.error and not problem.node_id for problem in shown.problems):
            self.viewport.show_meshes({root: one.mesh for root, one in meshes.items() if one.mesh is not None})
        self._tell_problems()
        self.status.set_time(seconds)
        self.measure_selection()
        if not self.session.previewing:
            self.actions_.refresh()

    def _tell_problems(self) -> None:
        """What the evaluation says of nodes, and what is wrong with the bitmaps that they wear."""
        latest = self.evaluation.latest
        problems = (*(() if latest is None else latest.problems), *bitmap_faults(self.session.document))
        self.tree.nodes.set_problems(problems)
        self.problems.set_problems(problems)
        self.status.set_problem(next((problem.sentence for problem in problems if problem.error), ""))

    def measure_selection(self) -> None:
        shown, selection, document = self.evaluation.latest, self.session.selection, self.session.document
        self.status.set_measures(*shown_solids(self.session.view, selection, shown))
        self.properties.set_measures(measured(document, selection, shown, self.evaluation.parts))

    def examined(self) -> None:
        if not self.session.previewing:
            self.actions_.refresh()

    def busy(self, busy: bool) -> None:
        self.status.set_busy(busy)
        self.actions_.refresh()

    def show_problems(self) -> None:
        self.docks["Problems"].show()
        self.docks["Problems"].raise_()

    def show_faults(self) -> None:
        raise_dock(self, "Faults", FAULTS_HEIGHT)

    def show_motion(self) -> None:
        raise_dock(self, "Motion", FAULTS_HEIGHT)

    def show_clearance(self) -> None:
        raise_dock(self, "Clearance", FAULTS_HEIGHT)

    def count_problems(self, count: int) -> None:
        self.docks["Problems"].setWindowTitle(f"Problems ({count})" if count else "Problems")

    def opened(self) -> None:
        self.viewport.fit_next()
        self.hidden_surfaces.document_opened()
        self.tree.document_opened()
        self.diagram.document_opened()

    def retint(self) -> None:
        self.properties.rebuild()
        self.actions_.refresh()

    # Commands.

    @cached_property
    def palette_(self) -> Palette:
        return Palette(self)

    @cached_property
    def space_bar(self) -> SpaceBar:
        return SpaceBar(self)

    def show_search(self) -> None:
        self.docks["Model"].show()
        self.docks["Model"].raise_()
        self.model_panel.start()

    def show_diagram(self) -> None:
        """Bring the diagram to the front, or the list where the diagram is there already."""
        shown = self.diagram.in_front
        dock = self.docks["Model" if shown else "Diagram"]
        dock.show()
        dock.raise_()
        (self.tree if shown else self.diagram).setFocus()

    # The file and the layout.

    def follow_title(self) -> None:
        self.setWindowTitle(f"{self.files.name}[*] \u2013 Solidtree")
        self.setWindowFilePath("" if self.files.path is None else str(self.files.path))
        self.setWindowModified(self.session.modified)

    def follow_recent(self) -> None:
        self.welcome.set_recent(self.settings.recent)

    def _picture(self) -> bytes | None:
        viewer = self.viewport.viewer
        return thumbnail(viewer) if viewer is not None and self.session.document.solids else None

    def _restore(self) -> None:
        geometry, state = self.settings.layout()
        if geometry.isEmpty() or not self.restoreGeometry(geometry):
            self.resize(1280, 820)
        self._unsized = state.isEmpty() or not self.restoreState(state, LAYOUT_VERSION)
        switch_layout(self, True)

    def showEvent(self, event: QShowEvent) -> None:
        super().showEvent(event)
        if self._unsized:
            self._unsized = False
            give_sizes(self)

    def closeEvent(self, event: QCloseEvent) -> None:
        if not self._closing and self.session.modified:
            event.ignore()
            self.files.guard(self._close_now)
            return
        self._closing = True
        self.settings.keep_layout(self.saveGeometry(), self.saveState(LAYOUT_VERSION))
        self.side_windows.end()
        self._unlisten()
        self.files.background.close()
        self.hidden_surfaces.close()
        self.pipeline.close_work()
        self.clearance.close_work()
        self.evaluation.close()
        self.viewport.close_viewer()
        super().closeEvent(event)

    def _close_now(self) -> None:
        self._closing = True
        self.close()

    def dragEnterEvent(self, event: QDragEnterEvent) -> None:
        if any(url.isLocalFile() for url in event.mimeData().urls()):
            event.acceptProposedAction()

    def dropEvent(self, event: QDropEvent) -> None:
        paths = [Path(url.toLocalFile()) for url in event.mimeData().urls() if url.isLocalFile()]
        if paths:
            event.acceptProposedAction()
            self.files.drop(paths)
