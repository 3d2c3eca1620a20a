"""Saving the edited font: a family name of its own, a form, a place; written and checked beside the window's thread."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QComboBox, QDialog, QDialogButtonBox, QFileDialog, QFormLayout, QLabel, QVBoxLayout

from ...model.document.errors import Refusal
from ..dialogs import tell
from ..panels.text_line import TextLine

if TYPE_CHECKING:
    from .font_window import FontWindow

FORMS = (
    ("otf", "OpenType (.otf), cubic curves"),
    ("ttf", "TrueType (.ttf), quadratic curves"),
    ("pfb", "Type 1 (.pfb), for older programs: without kerning"),
)
OWN_FORM = {"TrueType": "ttf", "Type 1": "pfb"}


def ask_save_font(window: FontWindow) -> None:
    """Ask for a family and a form, then for a place."""
    face = window.desk.plain
    if face is None:
        return
    try:
        from ...model.lettering.fonts.in_document import file_of
        from ...model.lettering.saving.naming import proposed_family

        proposed = proposed_family(*file_of(window.desk.session.document, window.desk.font)[:2])
    except Refusal as refusal:
        tell(window, f"{window.desk.font} cannot be saved", str(refusal))
        return
    SaveFont(window, proposed, OWN_FORM.get(face.kind, "otf")).open()


class SaveFont(QDialog):
    """The new font's name: licences of many fonts ask that a changed one is called otherwise."""

    def __init__(self, window: FontWindow, family: str, form: str) -> None:
        super().__init__(window)
        self.setObjectName("save_font")
        self.setWindowTitle("Save font")
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self.setWindowModality(Qt.WindowModality.WindowModal)
        self._window = window
        self.family = TextLine(parent=self)
        self.family.setObjectName("family")
        self.family.setText(family)
        self.form = QComboBox(self)
        for value, words in FORMS:
            self.form.addItem(words, value)
        self.form.setCurrentIndex(self.form.findData(form))
        rows = QFormLayout()
        rows.setHorizontalSpacing(12)
        rows.setVerticalSpacing(8)
        rows.setLabelAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        rows.setFieldGrowthPolicy(QFormLayout.FieldGrowthPolicy.AllNonFixedFieldsGrow)
        rows.addRow("Family", self.family)
        rows.addRow("Form", self.form)
        count = len(window.desk.edited)
        words = QLabel(
            f"{window.desk.font} with {count} edited glyph{'s' * (count != 1)}. A changed font needs a name of its "
            "own; its licence and its authors stay in it. Changed glyphs lose their hinting.",
            self,
        )
        words.setWordWrap(True)
        words.setProperty("muted", True)
        self.fault = QLabel(self)
        self.fault.setWordWrap(True)
        self.fault.setProperty("fault", True)
        self.fault.hide()
        buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Save | QDialogButtonBox.StandardButton.Cancel, self)
        buttons.accepted.connect(self._place)
        buttons.rejected.connect(self.reject)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(16, 16, 16, 16)
        layout.setSpacing(12)
        layout.addLayout(rows)
        layout.addWidget(words)
        layout.addWidget(self.fault)
        layout.addWidget(buttons)
        self.setMinimumWidth(420)
        self.family.textChanged.connect(lambda: self.fault.hide())
        self.family.selectAll()

    def _place(self) -> None:
        """Ask where to, once the name will do."""
        from ...model.lettering.fonts.in_document import file_of
        from ...model.lettering.saving.naming import check_family

        desk, family = self._window.desk, self.family.text()
        try:
            check_family(*file_of(desk.session.document, desk.font)[:2], family)
        except Refusal as refusal:
            words = str(refusal)
            self.fault.setText(words[:1].upper() + words[1:])
            self.fault.show()
            return
        form = str(self.form.currentData())
        settings = self._window.settings
        name = "".join(part for part in family.title() if part.isalnum() or part in "-_")
        dialog = QFileDialog(self, "Save font", str(settings.folder))
        dialog.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        dialog.setAcceptMode(QFileDialog.AcceptMode.AcceptSave)
        dialog.setNameFilters([f"{words.split(' (')[0]} (*.{value})" for value, words in FORMS if value == form])
        dialog.setDefaultSuffix(form)
        dialog.selectFile(f"{name or 'Font'}.{form}")
        dialog.fileSelected.connect(lambda path: self._write(Path(path), family, form))
        dialog.open()

    def _write(self, path: Path, family: str, form: str) -> None:
        from ...model.lettering.fonts.changing import write_changed_font
        from ...model.lettering.fonts.in_document import file_of

        window, desk = self._window, self._window.desk
        document, font = desk.session.document, desk.font
        window.settings.folder = path.parent

        def write() -> tuple[str, ...]:
            data, number, drawn = file_of(document, font)
            return write_changed_font(data, number, path, family, drawn=drawn, form=form)

        window.background.run(
            "Writing the font",
            write,
            lambda remarks: window.saved(path, remarks),
            lambda refusal: tell(window, f"{path.name} was not written", str(refusal)),
        )
        self.accept()
