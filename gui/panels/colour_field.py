"""A colour: swatch that opens the dialog, text that takes names and #rrggbb, and a button that clears it."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtGui import QColor, QIcon, QPixmap
from PySide6.QtWidgets import QColorDialog, QHBoxLayout, QToolButton, QWidget

from ...model.document.errors import Refusal
from ...model.editing.session import Session
from ...model.operations.operations import OPERATIONS
from ..icons import icon
from .text_line import TextLine


class ColourField(QWidget):
    """Edits the colour of nodes; the dialog previews, and commits one step when it is accepted."""

    def __init__(self, session: Session, ids: list[str], parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._session = session
        self._ids = ids
        self._colour: str | None = None
        self.swatch = QToolButton(self)
        self.swatch.setObjectName("swatch")
        self.swatch.setProperty("flat", True)
        self.swatch.setToolTip("Choose a colour")
        self.swatch.clicked.connect(self._choose)
        self.text = TextLine(parent=self)
        self.text.setObjectName("colour")
        self.text.setAccessibleName("Colour")
        self.text.setToolTip("#rrggbb or a name such as steelblue; empty: that of what it stands in")
        self.text.editingFinished.connect(self._typed)
        self.clear = QToolButton(self)
        self.clear.setProperty("flat", True)
        self.clear.setIcon(icon("close"))
        self.clear.setToolTip("No colour of its own")
        self.clear.clicked.connect(lambda: self._commit(None))
        layout = QHBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(4)
        for widget in (self.swatch, self.text, self.clear):
            layout.addWidget(widget)

    def set_colours(self, colours: set[str | None]) -> None:
        """The colours of all nodes it stands for."""
        self._colour = next(iter(colours)) if len(colours) == 1 else None
        self.text.setPlaceholderText("several" if len(colours) > 1 else "as the solid")
        if not (self.text.hasFocus() and self.text.isModified()):
            self.text.setText(self._colour or "")
            self._fault(None)
        self.clear.setEnabled(colours != {None})
        if self._colour is None:
            self.swatch.setIcon(icon("colour"))
        else:
            picture = QPixmap(16, 16)
            picture.fill(QColor(self._colour))
            self.swatch.setIcon(QIcon(picture))

    def _typed(self) -> None:
        if self.text.isModified():
            self.text.setModified(False)
            self._commit(self.text.text().strip() or None)

    def _commit(self, colour: str | None) -> None:
        try:
            self._session.do("set_colour", self._ids, colour, label="Change colour")
        except Refusal as refusal:
            self._session.cancel()
            self._fault(str(refusal))
        else:
            self._fault(None)

    def _fault(self, words: str | None) -> None:
        self.text.setProperty("fault", bool(words))
        self.text.style().unpolish(self.text)
        self.text.style().polish(self.text)
        self.text.setToolTip(words or "#rrggbb or a name such as steelblue; empty: that of what it stands in")

    def _choose(self) -> None:
        dialog = QColorDialog(QColor(self._colour or "#a9b8c9"), self)
        dialog.setOption(QColorDialog.ColorDialogOption.DontUseNativeDialog)
        dialog.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        dialog.currentColorChanged.connect(self._preview)
        dialog.colorSelected.connect(lambda colour: self._commit(colour.name()))
        dialog.rejected.connect(self._session.cancel)
        dialog.open()

    def _preview(self, colour: QColor) -> None:
        self._session.preview(OPERATIONS["set_colour"](self._session.document, self._ids, colour.name()))
