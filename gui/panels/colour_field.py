"""A colour: swatch that opens the dialog, text that takes names and #rrggbb, and a button that clears it."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtGui import QColor, QIcon, QPainter, QPalette, QPixmap
from PySide6.QtWidgets import QColorDialog, QHBoxLayout, QToolButton, QWidget

from ..icons import icon
from .property_edit import Edit
from .text_line import TextLine


class ColourField(QWidget):
    """Edits a colour, or with `none` its words where there may be no colour; the dialog previews, and commits one step
    when it is accepted."""

    def __init__(self, edit: Edit, none: str = "", tip: str = "", parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._edit = edit
        self._none = none
        self._tip = "#rrggbb or a name such as steelblue" + (f"; {tip}" if tip else "")
        self._colour: str | None = None
        self.swatch = QToolButton(self)
        self.swatch.setObjectName("swatch")
        self.swatch.setProperty("flat", True)
        self.swatch.setToolTip("Choose a colour")
        self.swatch.clicked.connect(self._choose)
        self.text = TextLine(parent=self)
        self.text.setObjectName("colour")
        self.text.setAccessibleName("Colour")
        self.text.setToolTip(self._tip)
        self.text.editingFinished.connect(self._typed)
        self.clear = QToolButton(self)
        self.clear.setProperty("flat", True)
        self.clear.setIcon(icon("close"))
        self.clear.setToolTip("No colour of its own")
        self.clear.clicked.connect(lambda: self._commit(None))
        self.clear.setVisible(bool(none))
        layout = QHBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(4)
        for widget in (self.swatch, self.text, self.clear):
            layout.addWidget(widget)

    def set_colours(self, colours: set[str | None]) -> None:
        """The colours of all nodes it stands for."""
        self._colour = next(iter(colours)) if len(colours) == 1 else None
        self.text.setPlaceholderText("several" if len(colours) > 1 else self._none)
        if not (self.text.hasFocus() and self.text.isModified()):
            self.text.setText(self._colour or "")
            self._fault(None)
        self.clear.setEnabled(colours != {None})
        if self._colour is None:
            self.swatch.setIcon(icon("colour"))
        else:
            picture = QPixmap(16, 16)
            picture.fill(QColor(self._colour))
            painter = QPainter(picture)
            painter.setPen(self.palette().color(QPalette.ColorRole.Mid))  # or white would be lost on white
            painter.drawRect(0, 0, 15, 15)
            painter.end()
            self.swatch.setIcon(QIcon(picture))

    def _typed(self) -> None:
        if self.text.isModified():
            self.text.setModified(False)
            self._commit(self.text.text().strip() or None)

    def _commit(self, colour: str | None) -> None:
        self._fault(self._edit.commit(colour))

    def _fault(self, words: str | None) -> None:
        self.text.setProperty("fault", bool(words))
        self.text.style().unpolish(self.text)
        self.text.style().polish(self.text)
        self.text.setToolTip(words or self._tip)

    def _choose(self) -> None:
        dialog = QColorDialog(QColor(self._colour or "#a9b8c9"), self)
        dialog.setOption(QColorDialog.ColorDialogOption.DontUseNativeDialog)
        dialog.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        dialog.currentColorChanged.connect(self._preview)
        dialog.colorSelected.connect(lambda colour: self._commit(colour.name()))
        dialog.rejected.connect(self._edit.cancel)
        dialog.open()

    def _preview(self, colour: QColor) -> None:
        self._edit.preview(colour.name())
