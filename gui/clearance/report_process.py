"""The report of a document's clearances, written by `solidtree check` in a process of its own, one at a time."""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, QProcess, Signal

from ...model.project.disk import one_line
from ...model.project.project_file import save_project
from ..command_line import DONE, NOT_IN_ORDER
from .pair_checks import TOLERANCE

if TYPE_CHECKING:
    from ...model.document.document import Document


class ReportProcess(QObject):
    """`ended` carries the file's name, and "" or why it was not written."""

    ended = Signal(str, str)

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self._process: QProcess | None = None
        self._folder: tempfile.TemporaryDirectory[str] | None = None
        self._out = Path()

    @property
    def at_work(self) -> bool:
        return self._process is not None

    def write(self, document: Document, name: str, out: Path) -> None:
        """Write a document's report to `out`, with `name` as its title. Raises Refusal."""
        self.cancel()
        folder = tempfile.TemporaryDirectory(prefix="solidtree-report-")
        project = Path(folder.name, f"{name}.solidtree")
        save_project(document, project)
        self._folder, self._out = folder, out
        self._process = process = QProcess(self)
        process.setWorkingDirectory(folder.name)
        process.finished.connect(self._finished)
        command = ["-m", "solidtree.gui.command_line", "check", str(project), "--report", str(out.absolute())]
        process.start(sys.executable, [*command, "--tolerance", str(TOLERANCE)])

    def cancel(self) -> None:
        """Give up the one that is being written; `ended` does not come."""
        process, self._process = self._process, None
        if process is not None:
            process.finished.disconnect()
            process.kill()
            process.waitForFinished()
            process.deleteLater()
        self._tidy()

    def _finished(self, code: int, status: QProcess.ExitStatus) -> None:
        process, self._process = self._process, None
        assert process is not None
        lines = bytes(process.readAllStandardError().data()).decode(errors="replace").strip().splitlines()
        process.deleteLater()
        self._tidy()
        if status == QProcess.ExitStatus.NormalExit and code in (DONE, NOT_IN_ORDER):
            self.ended.emit(self._out.name, "")
        else:
            self.ended.emit(self._out.name, one_line(lines[-1]) if lines else "the check came to no end")

    def _tidy(self) -> None:
        folder, self._folder = self._folder, None
        if folder is not None:
            folder.cleanup()
