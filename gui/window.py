"""The main window: docks around the picture, and the wiring between session, worker and views."""

from __future__ import annotations

from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QTimer
from PySide6.QtGui import QCloseEvent, QDragEnterEvent, QDropEvent
from PySide6.QtWidgets import QApplication, QMainWindow

from ..model.document.tree import trail
from ..model.editing.commands import DOCUMENT_COMMANDS
from ..model.editing.session import Session, State
from .actions import Actions
from .docks import arrange
from .evaluation import Evaluation
from .files import Files
from .menus import fill_menus
from .palette import Palette
from .panels.parameters import Parameters
from .panels.problems import Problems
from .panels.properties import Properties
from .panels.script_log import ScriptLog
from .settings import LAYOUT_VERSION, Settings
from .status import StatusBar, shown_solids
from .theme import Theme
from .tree.tree import Tree
from .view.thumbnail import thumbnail
from .view.viewport import Viewport
from .view.welcome import Welcome
from .window_commands import FILE_COMMANDS, TOOL_BAR, VIEW_COMMANDS

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
        self.parallel, self.grid = self.settings.flag("parallel", False), self.settings.flag("grid", True)
        self.style_name = "edges"
        self._closing = False

        self.viewport = Viewport(self.session, self)
        self.setCentralWidget(self.viewport)
        self.files = Files(self, self.session, self.evaluation, self.settings, self._picture)
        self.actions_ = Actions(self)
        self.actions_.add(FILE_COMMANDS, self)
        self.actions_.add(DOCUMENT_COMMANDS, self.session)
        self.actions_.add(VIEW_COMMANDS, self)
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
        self.welcome = Welcome(self.actions_, self.viewport)
        self.setAcceptDrops(True)
        self._connect()
        self._restore()
        self._follow_title()
        self._follow_recent()
        self._changed(self.session.state, self.session.state)
        self.set_parallel(self.parallel)
        self.set_grid(self.grid)
        self.set_style(self.style_name)

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
        self.properties = Properties(self.session, self)
        self.parameters = Parameters(self.session, self)
        self.problems = Problems(self.session, self)
        self.script = ScriptLog(self.session, self)
        self.docks = arrange(
            self,
            left={"Model": self.tree},
            right={"Properties": self.properties},
            bottom={"Parameters": self.parameters, "Problems": self.problems, "Script": self.script},
        )

    def _connect(self) -> None:
        self._unlisten = self.session.on_change(self._changed)
        say = self.status.say
        for part in (self.tree, self.properties, self.parameters, self.actions_):
            part.refused.connect(say)
        self.evaluation.notice.connect(say)
        self.files.notice.connect(say)
        self.files.path_changed.connect(self._follow_title)
        self.files.path_changed.connect(self._follow_recent)
        self.files.opened.connect(self._opened)
        self.files.background.busy.connect(lambda words: say(words + " …" if words else ""))
        self.evaluation.shown.connect(self._shown)
        self.evaluation.busy.connect(self._busy)
        self.evaluation.outdated.connect(self.status.set_outdated)
        self.evaluation.progress.connect(self.status.set_progress)
        self.status.cancel_asked.connect(self.evaluation.cancel)
        self.status.problems_asked.connect(self._show_problems)
        self.viewport.hovered.connect(self.status.set_hover)
        self.problems.counted.connect(self._count_problems)
        self.theme.changed.connect(lambda name: self.viewport.change(lambda viewer: viewer.set_theme(name)))
        self.theme.changed.connect(self._retint)
        self.welcome.open_asked.connect(self.files.open)

    # What happens.

    def _changed(self, before: State, after: State) -> None:
        after = self.session.state  # an earlier listener may have gone on
        for part in (self.tree, self.viewport, self.evaluation, self.properties, self.parameters, self.script):
            part.session_changed(before, after)
        self.setWindowModified(self.session.modified)
        if self.session.previewing:
            return
        self.welcome.set_empty(not after.document.roots)
        if before.selection != after.selection:
            self._measure()
        for name, label in (("undo", self.session.undo_label), ("redo", self.session.redo_label)):
            title = name.capitalize()
            self.actions_[name].setText(f"{title} {label[0].lower()}{label[1:]}" if label else title)
        self.actions_.refresh()

    def _shown(self, shown: Shown, seconds: float) -> None:
        if shown.solids or not any(problem.error and not problem.node_id for problem in shown.problems):
            self.viewport.show_meshes(
                {root: solid.mesh for root, solid in shown.solids.items() if solid.mesh is not None}
            )
        self.tree.nodes.set_problems(shown.problems)
        self.problems.set_problems(shown.problems)
        self.status.set_problem(next((problem.message for problem in shown.problems if problem.error), ""))
        self.status.set_time(seconds)
        self._measure()
        self.actions_.refresh()

    def _measure(self) -> None:
        shown, selection, document = self.evaluation.latest, self.session.selection, self.session.document
        self.status.set_measures(*shown_solids(document, selection, shown))
        measures = None
        if shown is not None and selection:
            known = {root.id for root in document.solids}
            roots = {trail(document, node_id)[0].id for node_id in selection} & known
            solids = [shown.solids[root] for root in roots if root in shown.solids]
            measures = solids[0].measures if len(roots) == 1 and solids else None
        self.properties.set_measures(measures)

    def _busy(self, busy: bool) -> None:
        self.status.set_busy(busy)
        self.actions_.refresh()

    def _show_problems(self) -> None:
        self.docks["Problems"].show()
        self.docks["Problems"].raise_()

    def _count_problems(self, count: int) -> None:
        self.docks["Problems"].setWindowTitle(f"Problems ({count})" if count else "Problems")

    def _opened(self) -> None:
        self.viewport.fit_next()
        self.tree.document_opened()

    def _retint(self) -> None:
        self.properties.rebuild()
        self.actions_.refresh()

    # Commands.

    @cached_property
    def palette_(self) -> Palette:
        return Palette(self.actions_, self)

    def set_style(self, name: str) -> None:
        self.style_name = name
        self.viewport.change(lambda viewer: viewer.set_style(name))
        self.actions_.refresh()

    def set_parallel(self, parallel: bool) -> None:
        self.parallel = parallel
        self.settings.set_flag("parallel", parallel)
        self.viewport.change(lambda viewer: viewer.set_projection(parallel))
        self.actions_.refresh()

    def set_grid(self, visible: bool) -> None:
        self.grid = visible
        self.settings.set_flag("grid", visible)
        self.viewport.change(lambda viewer: viewer.set_ground(visible))
        self.actions_.refresh()

    def show_about(self) -> None:
        from .dialogs import about

        about(self)

    # The file and the layout.

    def _follow_title(self) -> None:
        self.setWindowTitle(f"{self.files.name}[*] \u2013 Solidtree")
        self.setWindowFilePath("" if self.files.path is None else str(self.files.path))
        self.setWindowModified(self.session.modified)

    def _follow_recent(self) -> None:
        self.welcome.set_recent(self.settings.recent)

    def _picture(self) -> bytes | None:
        viewer = self.viewport.viewer
        return thumbnail(viewer) if viewer is not None and self.session.document.solids else None

    def _restore(self) -> None:
        geometry, state = self.settings.layout()
        if geometry.isEmpty() or not self.restoreGeometry(geometry):
            self.resize(1280, 820)
        if not state.isEmpty():
            self.restoreState(state, LAYOUT_VERSION)

    def closeEvent(self, event: QCloseEvent) -> None:
        if not self._closing and self.session.modified:
            event.ignore()
            self.files.guard(self._close_now)
            return
        self._closing = True
        self.settings.keep_layout(self.saveGeometry(), self.saveState(LAYOUT_VERSION))
        self._unlisten()
        self.files.background.close()
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
