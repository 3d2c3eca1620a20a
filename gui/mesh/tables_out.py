"""Tables of a mesh into the clipboard and into files."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import Qt
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QFileDialog

from ...model.document.errors import Refusal

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from ..window import MainWindow
    from .table_page import TablePage

MOST_COPIED = 100_000


def copy_rows(window: MainWindow, page: TablePage, rows: NDArray[np.int64], first: int) -> None:
    """Put rows into the clipboard, cells separated by tabs. Raises Refusal where they are too many."""
    table = page.view.elements.table
    if table is None:
        return
    if len(rows) > MOST_COPIED:
        raise Refusal(
            f"{len(rows):,} rows are too many for the clipboard, which takes {MOST_COPIED:,}: "
            "save them as CSV, or list fewer"
        )
    QGuiApplication.clipboard().setText(table.tabbed(rows, first))
    window.status.say(f"Copied {len(rows):,} {'row' if len(rows) == 1 else 'rows'} of {page.name}")


def ask_csv(window: MainWindow, page: TablePage, first: int, solid: str) -> None:
    """Ask which file the listed rows are to be written to."""
    dialog = QFileDialog(window, "Save table", window.settings.folder)
    dialog.setNameFilters(["Table (*.csv)"])
    dialog.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
    dialog.setAcceptMode(QFileDialog.AcceptMode.AcceptSave)
    dialog.setDefaultSuffix("csv")
    dialog.selectFile(f"{solid} {page.name}.csv")
    dialog.fileSelected.connect(lambda path: write_csv(window, page, path, first))
    dialog.open()


def write_csv(window: MainWindow, page: TablePage, path: str, first: int) -> None:
    """Write the listed rows to a file, in the background."""
    table, rows = page.view.elements.table, page.view.elements.listed.copy()
    if table is None:
        return

    def work() -> None:
        from ...model.project.disk import reason_of

        try:
            with Path(path).open("w", encoding="utf-8", newline="") as file:
                table.write_csv(file, rows, first)
        except OSError as error:
            raise Refusal(reason_of(error)) from error

    def refused(refusal: Refusal) -> None:
        from .. import dialogs

        dialogs.tell(window, f"{Path(path).name} could not be written", str(refusal))

    name = Path(path).name
    window.files.background.run(
        f"Writing {name}", work, lambda _: window.status.say(f"Wrote {len(rows):,} rows to {name}"), refused
    )
