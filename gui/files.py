"""New, open, save, import, export: what happens to the document and its file. Disk work runs beside the window."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, Signal

from ..model.document.document import Document, Section
from ..model.document.errors import Refusal
from ..model.editing.session import Session
from ..model.operations.operations import OPERATIONS
from . import dialogs
from .background import Background
from .settings import Settings

if TYPE_CHECKING:
    from PySide6.QtWidgets import QWidget

    from ..model.drafting.plan import Plan
    from .evaluation import Evaluation

PROJECT = ".solidtree"


class Files(QObject):
    """The file of the open document. `path_changed` comes when it has another one, `opened` with a new document."""

    path_changed = Signal()
    opened = Signal()
    notice = Signal(str)
    brought_in = Signal(tuple, str)
    """Ids of the solids and outlines that came with a foreign file, and the file's name."""

    def __init__(
        self,
        window: QWidget,
        session: Session,
        evaluation: Evaluation,
        settings: Settings,
        thumbnail: Callable[[], bytes | None],
    ) -> None:
        super().__init__(window)
        self._window = window
        self._session = session
        self._evaluation = evaluation
        self._settings = settings
        self._thumbnail = thumbnail
        self.path: Path | None = None
        self._turn = 0  # how many documents have been opened
        self.background = Background(self)
        evaluation.jobs.exported.connect(self._exported)

    @property
    def name(self) -> str:
        return self.path.stem if self.path is not None else "Untitled"

    def guard(self, then: Callable[[], None]) -> None:
        """Do `then`, after asking what to do with unsaved changes."""
        if not self._session.modified:
            then()
            return
        dialogs.ask_unsaved(self._window, self.name, save=lambda: self.save(then), discard=then)

    # New and open.

    def new(self) -> None:
        self.guard(lambda: self._show(Document(), None))

    def ask_open(self) -> None:
        self.guard(lambda: dialogs.ask_open_path(self._window, self._settings.folder, "Open", self.read))

    def open(self, path: str | Path) -> None:
        """Open a project or a mesh file, asking about unsaved changes first."""
        self.guard(lambda: self.read(path))

    def read(self, path: str | Path, example: bool = False) -> None:
        """Put the file's document in the place of the open one, which stays where the file cannot be read.

        An example is opened without its file, so that saving asks for a place.
        """
        path = Path(path)
        before = self._session.state.document

        def work() -> Document:
            from ..model.exchange.meshes_in import read_any

            return read_any(path)

        def show(document: Document) -> None:
            self._show(document, path if path.suffix.lower() == PROJECT and not example else None)
            if not example:
                self._remember(path)
            if path.suffix.lower() != PROJECT:
                self.brought_in.emit(tuple(root.id for root in document.standing), path.name)

        def done(document: Document) -> None:
            if self._session.state.document is before:
                show(document)
            else:  # edited while the file was read
                self.guard(lambda: show(document))

        self.background.run(f"Opening {path.name}", work, done, lambda refusal: self._refused("opened", path, refusal))

    def _show(self, document: Document, path: Path | None) -> None:
        self.path = path
        self._turn += 1
        self._session.open(document)
        self.opened.emit()
        self.path_changed.emit()

    # Save.

    def save(self, then: Callable[[], None] | None = None) -> None:
        """Write the project to its file, asking for one where there is none; `then` follows when it is written."""
        if self.path is None:
            self.save_as(then)
        else:
            self.write(self.path, then)

    def save_as(self, then: Callable[[], None] | None = None) -> None:
        suggestion = Path(self._settings.folder, self.name + PROJECT)
        dialogs.ask_save_path(self._window, suggestion, lambda path: self.write(path, then))

    def write(self, path: str | Path, then: Callable[[], None] | None = None) -> None:
        path = Path(path)
        if path.suffix.lower() != PROJECT:
            path = path.with_name(path.name + PROJECT)
        self._session.cancel()
        document, picture, turn = self._session.document, self._thumbnail(), self._turn

        def work() -> None:
            from ..model.project.project_file import save_project

            save_project(document, path, picture)

        def done(_: None) -> None:
            self._remember(path)
            self.notice.emit(f"Saved {path.name}")
            if turn == self._turn:  # else another document has been opened meanwhile
                self.path = path
                self._session.mark_saved(document)
                self.path_changed.emit()
            if then is not None:
                self.guard(then)  # what was edited while the file was written is asked about again

        self.background.run(f"Saving {path.name}", work, done, lambda refusal: self._refused("saved", path, refusal))

    # Meshes.

    def ask_import(self) -> None:
        dialogs.ask_open_path(self._window, self._settings.folder, "Import", self.import_file)

    def import_file(self, path: str | Path) -> None:
        """Add the solids of a mesh file, the outlines of a drawing, or another project, to the open document."""
        path = Path(path)

        def work() -> Document:
            from ..model.exchange.meshes_in import read_any

            return read_any(path)

        def done(other: Document) -> None:
            before = self._session.document
            try:
                document = OPERATIONS["insert_document"](before, other)
            except Refusal as refusal:
                self._refused("imported", path, refusal)
                return
            self._session.commit(f"Import {path.name}", document, line=f"insert_document(open_document({str(path)!r}))")
            self._remember(path)
            if path.suffix.lower() != PROJECT:
                known = {root.id for root in before.standing}
                fresh = (root.id for root in document.standing if root.id not in known)
                self.brought_in.emit(tuple(fresh), path.name)
            notes = other.notes.splitlines() if path.suffix.lower() != PROJECT else []
            if notes:
                dialogs.tell(self._window, f"{path.name} is imported, but not all of it", "\n".join(notes))

        self.background.run(
            f"Reading {path.name}", work, done, lambda refusal: self._refused("imported", path, refusal)
        )

    def ask_export(self) -> None:
        solids, outlines = (
            [root.name for root in roots if root.visible]
            for roots in (self._session.document.solids, self._session.document.profiles)
        )
        start = Path(self._settings.folder, self.name)
        tolerance = self._settings.tolerance("export")
        dialogs.ExportDialog(self._window, start, solids, outlines, tolerance, self._export_with).open()

    def _export_with(self, path: str, tolerance: float, name: str | None) -> None:
        self._settings.set_tolerance("export", tolerance)
        self.export(path, tolerance, name)

    def export(
        self,
        path: str | Path,
        tolerance: float | None = None,
        solid: str | None = None,
        section: Section | None = None,
    ) -> None:
        """Write a mesh file, or of a section its outlines."""
        self._settings.folder = Path(path).parent
        self._session.cancel()
        self._evaluation.jobs.export(self._session.document, path, tolerance, solid, section)
        self.notice.emit(f"Exporting {Path(path).name}")

    def export_drawing(self, path: str | Path, plan: Plan, tolerance: float | None, solid: str | None = None) -> None:
        """Write a drawing as SVG, PDF or DXF."""
        self._settings.folder = Path(path).parent
        self._session.cancel()
        self._evaluation.jobs.export_drawing(self._session.document, plan, path, tolerance, solid)
        self.notice.emit(f"Exporting {Path(path).name}")

    def _exported(self, path: str, fault: str) -> None:
        if fault:
            self._refused("exported", Path(path), Refusal(fault))
        else:
            self.notice.emit(f"Exported {Path(path).name}")

    # Both.

    def drop(self, paths: list[Path]) -> None:
        """Files dragged into the window: a project is opened, anything else is added."""
        projects = [path for path in paths if path.suffix.lower() == PROJECT]
        if len(paths) == 1 and projects:
            self.open(paths[0])
        else:
            for path in paths:
                self.import_file(path)

    def _remember(self, path: Path) -> None:
        self._settings.add_recent(path)
        self._settings.folder = path.absolute().parent
        self.path_changed.emit()

    def _refused(self, what: str, path: Path, refusal: Refusal) -> None:
        if not path.exists():
            self._settings.forget_recent(path.absolute())
            self.path_changed.emit()
        dialogs.tell(self._window, f"{path.name or 'The file'} could not be {what}", str(refusal))
