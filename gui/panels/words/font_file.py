"""A font file opened for lettering: which file, which of its faces, and one step of the history."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QFileDialog, QInputDialog, QWidget

from ....model.document.errors import Refusal
from ....model.editing.session import Session
from ....model.lettering.fonts.library import ENDINGS, faces_in, keep
from ...dialogs import tell
from ..property_edit import sentence


def ask_font_file(window: QWidget, session: Session, node_id: str) -> None:
    """Which font file the lettering is to be set in."""
    dialog = QFileDialog(window, "Open font file")
    dialog.setNameFilters([f"Fonts ({' '.join('*' + ending for ending in ENDINGS)})", "All files (*)"])
    dialog.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
    dialog.setFileMode(QFileDialog.FileMode.ExistingFile)
    dialog.fileSelected.connect(lambda path: take_font_file(window, session, node_id, Path(path)))
    dialog.open()


def take_font_file(window: QWidget, session: Session, node_id: str, path: Path) -> None:
    """Set the lettering in a font file, of a collection in the face that is asked for. A message tells a refusal."""
    names = [face.name for face in faces_in(path)]
    if len(names) < 2:
        _take(window, session, node_id, path, 0)
        return
    rows = [f"{number + 1}  {name}" for number, name in enumerate(names)]
    dialog = QInputDialog(window)
    dialog.setWindowTitle(path.name)
    dialog.setLabelText("Which font of the collection?")
    dialog.setComboBoxItems(rows)
    dialog.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
    dialog.textValueSelected.connect(lambda row: _take(window, session, node_id, path, rows.index(row)))
    dialog.open()


def set_font(session: Session, node_id: str, name: str, asset: str = "", face: int = 0) -> str | None:
    """Another font in one step, by its name or from a file among the assets; why not, or None."""
    try:
        session.do("set_fields", node_id, font=name, asset=asset, face=face, label="Change font")
    except Refusal as refusal:
        session.cancel()
        return sentence(refusal)
    return None


def _take(window: QWidget, session: Session, node_id: str, path: Path, face: int) -> None:
    try:
        name, asset = keep(path, face)
        fault = set_font(session, node_id, name, asset, face)
    except Refusal as refusal:
        fault = str(refusal)
    if fault is not None:
        tell(window, f"{path.name} could not be opened", fault.removeprefix(f"{path.name}: "))
