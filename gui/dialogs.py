"""Questions and messages. None of them stops the window: each opens, and calls back with the answer."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from PySide6.QtCore import Qt
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import (
    QApplication,
    QComboBox,
    QDialog,
    QDialogButtonBox,
    QFileDialog,
    QFormLayout,
    QHBoxLayout,
    QLabel,
    QLineEdit,
    QMessageBox,
    QPlainTextEdit,
    QPushButton,
    QVBoxLayout,
    QWidget,
)

from ..model.document.errors import Refusal
from ..model.document.expression import Expression, number

READABLE = (
    "*.solidtree *.stl *.3mf *.obj *.ply *.off *.glb *.gltf *.svg *.dxf *.bmp *.png *.jpg *.jpeg *.tif *.tiff *.webp"
)
FORMATS = (
    ("3mf", "3MF: printing, with names and colours"),
    ("stl", "STL: printing, triangles alone"),
    ("obj", "OBJ: other modellers, with names and colours"),
    ("ply", "PLY: with colours"),
    ("off", "OFF: points and faces"),
    ("glb", "GLB: web and renderers, with names and colours"),
    ("svg", "SVG: outlines with their curves"),
    ("dxf", "DXF: outlines with their curves, a layer for each"),
)
OF_OUTLINES = ("svg", "dxf")


def _box(parent: QWidget, icon: QMessageBox.Icon, text: str, detail: str) -> QMessageBox:
    box = QMessageBox(icon, QApplication.applicationDisplayName() or "Solidtree", text, parent=parent)
    box.setInformativeText(detail)
    box.setTextFormat(Qt.TextFormat.PlainText)
    box.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
    box.setWindowModality(Qt.WindowModality.WindowModal)
    return box


def tell(parent: QWidget, text: str, detail: str) -> None:
    """A calm message: what did not work, and why."""
    sentence = detail[:1].upper() + detail[1:]
    _box(parent, QMessageBox.Icon.Warning, text, sentence if sentence.endswith((".", "!")) else sentence + ".").open()


def ask_unsaved(parent: QWidget, name: str, save: Callable[[], None], discard: Callable[[], None]) -> None:
    """What to do with unsaved changes; Cancel calls nothing."""
    buttons = QMessageBox.StandardButton
    box = _box(parent, QMessageBox.Icon.Question, f"Save the changes to {name}?", "Without saving they are lost.")
    box.setStandardButtons(buttons.Save | buttons.Discard | buttons.Cancel)
    box.setDefaultButton(buttons.Save)

    def answered(_: int) -> None:
        clicked = box.standardButton(box.clickedButton()) if box.clickedButton() is not None else buttons.Cancel
        if clicked == buttons.Save:
            save()
        elif clicked == buttons.Discard:
            discard()

    box.finished.connect(answered)
    box.open()


def _file_dialog(
    parent: QWidget, title: str, folder: str, filters: list[str], then: Callable[[str], None]
) -> QFileDialog:
    dialog = QFileDialog(parent, title, folder)
    dialog.setNameFilters(filters)
    dialog.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
    dialog.fileSelected.connect(then)
    return dialog


def ask_open_path(parent: QWidget, folder: str, title: str, then: Callable[[str], None]) -> None:
    filters = [f"All that can be read ({READABLE})", "Projects (*.solidtree)", "All files (*)"]
    dialog = _file_dialog(parent, title, folder, filters, then)
    dialog.setFileMode(QFileDialog.FileMode.ExistingFile)
    dialog.open()


def ask_sets_path(parent: QWidget, start: Path, write: bool, then: Callable[[str], None]) -> None:
    """Which file to read sets of parameter values from, or to write them to."""
    both, json, csv = "Sets of values (*.json *.csv)", "OpenSCAD's customizer (*.json)", "Table (*.csv)"
    folder = start.parent if write else start
    title = "Export sets" if write else "Import sets"
    dialog = _file_dialog(parent, title, str(folder), [json, csv] if write else [both, "All files (*)"], then)
    if write:
        dialog.setAcceptMode(QFileDialog.AcceptMode.AcceptSave)
        dialog.setDefaultSuffix("json")
        dialog.filterSelected.connect(lambda chosen: dialog.setDefaultSuffix("csv" if chosen == csv else "json"))
        dialog.selectFile(start.name)
    else:
        dialog.setFileMode(QFileDialog.FileMode.ExistingFile)
    dialog.open()


def ask_save_path(parent: QWidget, suggestion: Path, then: Callable[[str], None]) -> None:
    dialog = _file_dialog(parent, "Save as", str(suggestion.parent), ["Projects (*.solidtree)"], then)
    dialog.setAcceptMode(QFileDialog.AcceptMode.AcceptSave)
    dialog.setDefaultSuffix("solidtree")
    dialog.selectFile(suggestion.name)
    dialog.open()


def ask_report_path(parent: QWidget, start: Path, then: Callable[[str], None]) -> None:
    """Which file to write the report of a check to."""
    dialog = _file_dialog(parent, "Save report", str(start.parent), ["Page to print (*.html)"], then)
    dialog.setAcceptMode(QFileDialog.AcceptMode.AcceptSave)
    dialog.setDefaultSuffix("html")
    dialog.selectFile(start.name)
    dialog.open()


def ask_diagram_path(parent: QWidget, start: Path, then: Callable[[str], None]) -> None:
    """Which file to write the diagram of the tree to."""
    dialog = _file_dialog(parent, "Export diagram", str(start.parent), ["SVG drawing (*.svg)"], then)
    dialog.setAcceptMode(QFileDialog.AcceptMode.AcceptSave)
    dialog.setDefaultSuffix("svg")
    dialog.selectFile(start.name)
    dialog.open()


def ask_outline_path(parent: QWidget, start: Path, then: Callable[[str], None]) -> None:
    """Which file to write the outlines of a section to."""
    svg, dxf = "SVG drawing (*.svg)", "DXF drawing, a layer for each solid (*.dxf)"
    dialog = _file_dialog(parent, "Export outlines", str(start.parent), [svg, dxf], then)
    dialog.setAcceptMode(QFileDialog.AcceptMode.AcceptSave)
    dialog.setDefaultSuffix("svg")
    dialog.filterSelected.connect(lambda chosen: dialog.setDefaultSuffix("dxf" if chosen == dxf else "svg"))
    dialog.selectFile(start.name)
    dialog.open()


def ask_drawing_path(parent: QWidget, start: Path, then: Callable[[str], None]) -> None:
    """Which file to write a drawing to."""
    filters = {
        "SVG drawing, linked to the tree (*.svg)": "svg",
        "PDF page (*.pdf)": "pdf",
        "DXF drawing at true size, a layer for each node (*.dxf)": "dxf",
    }
    dialog = _file_dialog(parent, "Save drawing", str(start.parent), list(filters), then)
    dialog.setAcceptMode(QFileDialog.AcceptMode.AcceptSave)
    dialog.setDefaultSuffix("svg")
    dialog.filterSelected.connect(lambda chosen: dialog.setDefaultSuffix(filters[chosen]))
    dialog.selectFile(start.name)
    dialog.open()


class ExportDialog(QDialog):
    """File, format, tolerance and which solid or outline. `then` takes (path, tolerance, name or None for all)."""

    def __init__(
        self,
        parent: QWidget,
        start: Path,
        solids: list[str],
        outlines: list[str],
        tolerance: float,
        then: Callable[[str, float, str | None], None],
    ) -> None:
        super().__init__(parent)
        self.setWindowTitle("Export")
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self._then = then
        self.format = QComboBox(self)
        for ending, words in FORMATS:
            self.format.addItem(words, ending)
        flat = not solids and bool(outlines)
        self.format.setCurrentIndex(self.format.findData("svg" if flat else "3mf"))
        self.path = QLineEdit(str(start.with_name(start.name + "." + self.format.currentData())), self)
        self.path.setMinimumWidth(340)
        browse = QPushButton("Browse …", self)
        browse.clicked.connect(self._browse)
        self._names = {"Solids": solids, "Outlines": outlines}
        self._what = QLabel(self)
        self.solid = QComboBox(self)
        self._what.setBuddy(self.solid)
        self._list_names()
        self.tolerance = QLineEdit(f"{tolerance:g}", self)
        self.tolerance.setToolTip("The largest distance between the true surface and its facets, in millimetres")
        self.fault = QLabel(self)
        self.fault.setProperty("fault", True)
        self.fault.setWordWrap(True)
        file_line = QHBoxLayout()
        file_line.setSpacing(8)
        file_line.addWidget(self.path, 1)
        file_line.addWidget(browse)
        tolerance_line = QHBoxLayout()
        tolerance_line.setSpacing(8)
        tolerance_line.addWidget(self.tolerance, 1)
        tolerance_line.addWidget(QLabel("mm", self))
        form = QFormLayout()
        form.setHorizontalSpacing(12)
        form.setVerticalSpacing(8)
        form.setLabelAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        form.addRow("Format", self.format)
        form.addRow("File", file_line)
        form.addRow(self._what, self.solid)
        form.addRow("Tolerance", tolerance_line)
        form.addRow("", self.fault)
        self.buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Cancel, self)
        self.buttons.addButton("Export", QDialogButtonBox.ButtonRole.AcceptRole)
        self.buttons.accepted.connect(self.accept)
        self.buttons.rejected.connect(self.reject)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(16, 16, 16, 16)
        layout.addLayout(form)
        layout.addWidget(self.buttons)
        self.format.currentIndexChanged.connect(self._follow_format)
        self.path.textEdited.connect(self._follow_path)

    def accept(self) -> None:
        try:
            tolerance = number(self.tolerance.text().strip(), "the tolerance")
            tolerance = tolerance.evaluate({}) if isinstance(tolerance, Expression) else tolerance
            path = Path(self.path.text().strip()).expanduser()
            if tolerance <= 0:
                raise Refusal("the tolerance must be above 0")
            if not path.name:
                raise Refusal("name a file to write to")
            if not path.parent.is_dir():
                raise Refusal(f"there is no folder {path.parent}")
        except Refusal as refusal:
            text = str(refusal)
            self.fault.setText(text[:1].upper() + text[1:])
            return
        super().accept()
        self._then(str(path), tolerance, self.solid.currentData())

    def _browse(self) -> None:
        filters = [f"{words.partition(':')[0]} (*.{ending})" for ending, words in FORMATS]
        here = Path(self.path.text())
        dialog = _file_dialog(self, "Export to", str(here.parent), filters, self._chosen)
        dialog.setAcceptMode(QFileDialog.AcceptMode.AcceptSave)
        dialog.selectNameFilter(filters[self.format.currentIndex()])
        dialog.selectFile(here.name)
        dialog.open()

    def _chosen(self, path: str) -> None:
        self.path.setText(path)
        self._follow_path(path)

    def _list_names(self) -> None:
        """What can be written in the chosen format."""
        what = "Outlines" if self.format.currentData() in OF_OUTLINES else "Solids"
        if what == self._what.text():
            return
        self._what.setText(what)
        names = self._names[what]
        self.solid.clear()
        self.solid.addItem(names[0] if len(names) == 1 else f"All visible {what.lower()}", None)
        for name in names if len(names) > 1 else ():
            self.solid.addItem(name, name)

    def _follow_format(self) -> None:
        self._list_names()
        path = Path(self.path.text())
        if path.name:
            self.path.setText(str(path.with_suffix("." + self.format.currentData())))

    def _follow_path(self, text: str) -> None:
        place = self.format.findData(Path(text).suffix.lower().removeprefix("."))
        if place >= 0:
            self.format.blockSignals(True)
            self.format.setCurrentIndex(place)
            self.format.blockSignals(False)
            self._list_names()


def report_fault(parent: QWidget | None, report: str) -> None:
    """An error of the program itself: said calmly, with a report that can be copied."""
    dialog = QDialog(parent)
    dialog.setObjectName("report")
    dialog.setWindowTitle("Something went wrong")
    dialog.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
    words = QLabel("Something went wrong inside the program. Your document is still there; saving it now is wise.")
    words.setWordWrap(True)
    text = QPlainTextEdit(report)
    text.setReadOnly(True)
    text.setMinimumSize(560, 240)
    buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Close)
    copy = buttons.addButton("Copy report", QDialogButtonBox.ButtonRole.ActionRole)
    copy.clicked.connect(lambda: QGuiApplication.clipboard().setText(report))
    buttons.rejected.connect(dialog.reject)
    layout = QVBoxLayout(dialog)
    layout.setContentsMargins(16, 16, 16, 16)
    for widget in (words, text, buttons):
        layout.addWidget(widget)
    dialog.open()


def about(parent: QWidget) -> None:
    """The version, which BSP builder is in use, and whose work stands in the program."""
    from importlib.metadata import version

    from ..model.partition.native import describe

    text = f"Solidtree {version('solidtree')} ({describe()})"
    detail = "A modeller in which a solid is a tree.\n\nSolids: Manifold. Pictures: VTK. Window: Qt. Icons: Tabler."
    _box(parent, QMessageBox.Icon.NoIcon, text, detail).open()
