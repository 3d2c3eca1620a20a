"""The report of a document's clearances, written by `solidtree check` in a process of its own."""

from __future__ import annotations

import subprocess
import sys
import tempfile
from pathlib import Path

from ...model.document.document import Document
from ...model.document.errors import Refusal
from ...model.project.disk import one_line
from ...model.project.project_file import save_project
from ..command_line import NOT_IN_ORDER
from .pair_checks import TOLERANCE


def report_by_process(document: Document, name: str, out: Path) -> None:
    """Write a document's report to `out`, with `name` as its title. Raises Refusal."""
    with tempfile.TemporaryDirectory(prefix="solidtree-report-") as folder:
        project = Path(folder, f"{name}.solidtree")
        save_project(document, project)
        command = ("-m", "solidtree.gui.command_line", "check", str(project), "--report", str(out.absolute()))
        done = subprocess.run(
            [sys.executable, *command, "--tolerance", str(TOLERANCE)], capture_output=True, text=True, cwd=folder
        )
    if done.returncode > NOT_IN_ORDER or not out.is_file():
        lines = done.stderr.strip().splitlines()
        raise Refusal(one_line(lines[-1]) if lines else "the check came to no end")
