"""Measured figures that can be copied, put into a number field and made a parameter."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape

from PySide6.QtCore import QEvent, QObject, QPoint, Qt, Signal
from PySide6.QtGui import QContextMenuEvent, QCursor, QGuiApplication
from PySide6.QtWidgets import QApplication, QLabel, QMenu, QToolTip, QWidget

from ...model.document.errors import Refusal
from ...model.editing.session import Session
from ...model.measuring.figure import Figure, parameter_name
from ..status import figure as shown_number
from ..theme import colours_now
from .number_field import NumberField
from .property_edit import sentence

HINT = "Click to copy, or to put it into the number field that you are editing; right click for more"


class FigureUse(QObject):
    """What can be done with figures, for one session. `said` carries words for the status bar."""

    said = Signal(str)

    def __init__(self, session: Session, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._session = session

    def take(self, figure: Figure, index: int) -> None:
        """Into the number field that has the focus, else to the clipboard."""
        field = edited_field()
        if field is not None:
            self.put(figure, index, field)
        else:
            self.copy(figure.text(index))

    def copy(self, text: str) -> None:
        QGuiApplication.clipboard().setText(text)
        QToolTip.showText(QCursor.pos(), "Copied")
        self.said.emit(f"Copied {text}" if "\n" not in text and "\t" not in text else "Copied")

    def put(self, figure: Figure, index: int, field: NumberField) -> None:
        field.put(figure.text(index))
        self.said.emit(f"{figure.name_of(index)}: {figure.text(index)} as it is now; Enter takes it")

    def make_parameter(self, figure: Figure, index: int, subject: str) -> None:
        """A parameter with the value of this moment, named after what was measured."""
        words = f"{subject} {figure.name_of(index)}".strip()
        name = parameter_name(words, (parameter.name for parameter in self._session.document.parameters))
        note = f"{words} when it was measured"
        try:
            self._session.do("set_parameter", name, float(figure.text(index)), note=note, label="Make a parameter")
        except Refusal as refusal:
            self.said.emit(sentence(refusal))
        else:
            self.said.emit(f"The parameter {name} is {figure.text(index)}")

    def menu(self, figure: Figure, index: int, subject: str, every: Sequence[Figure], at: QPoint) -> QMenu:
        """Shown at a place of the screen; it deletes itself."""
        field = edited_field()
        menu = QMenu(QApplication.activeWindow())
        menu.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        menu.addAction(f"Copy {figure.text(index)}", lambda: self.copy(figure.text(index)))
        if len(figure.values) > 1:
            values = ", ".join(figure.text(i) for i in range(len(figure.values)))
            menu.addAction(f"Copy {figure.name}", lambda: self.copy(values))
        menu.addAction("Copy all", lambda: self.copy("\n".join(one.line() for one in every)))
        menu.addSeparator()
        use = menu.addAction("Use in field", lambda: field and self.put(figure, index, field))
        use.setEnabled(field is not None)
        use.setToolTip("Click into a number field first")
        menu.addAction("Make a parameter of it", lambda: self.make_parameter(figure, index, subject))
        menu.popup(at)
        return menu


def edited_field() -> NumberField | None:
    """The number field that has the focus."""
    focus = QApplication.focusWidget()
    return focus if isinstance(focus, NumberField) and focus.isEnabled() and not focus.isReadOnly() else None


class FigureLabel(QLabel):
    """Figures in a run of text, each value a link; `named` puts their names before them."""

    def __init__(self, use: FigureUse, named: bool = False, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setTextFormat(Qt.TextFormat.RichText)
        flags = Qt.TextInteractionFlag.LinksAccessibleByMouse | Qt.TextInteractionFlag.LinksAccessibleByKeyboard
        self.setTextInteractionFlags(flags)
        self.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        application = QApplication.instance()
        if isinstance(application, QApplication):
            application.focusChanged.connect(self._follow_focus)
        self.setWordWrap(True)
        self.subject = ""
        self.every: Sequence[Figure] = ()
        self._use = use
        self._named = named
        self._digits = 6
        self._figures: tuple[Figure, ...] = ()
        self._hovered = ""
        self._faint = False
        self.linkActivated.connect(self._take)
        self.linkHovered.connect(self._hover)

    @property
    def figures(self) -> tuple[Figure, ...]:
        return self._figures

    def set_figures(self, figures: Sequence[Figure], digits: int = 6) -> None:
        """Show these; what has not changed is left alone, so that a link that is pressed stays."""
        if tuple(figures) != self._figures or digits != self._digits:
            self._figures, self._digits = tuple(figures), digits
            self._write()

    def set_faint(self, faint: bool) -> None:
        """Of what is out of date."""
        if faint != self._faint:
            self._faint = faint
            self._write()

    def set_words(self, words: str) -> None:
        """Words in place of figures."""
        self._figures = ()
        self.setText(escape(words))

    def value(self, name: str, index: int = 0) -> str:
        """A value as it is copied. Raises KeyError."""
        return {figure.name: figure for figure in self._figures}[name].text(index)

    def changeEvent(self, event: QEvent) -> None:
        super().changeEvent(event)
        if event.type() == QEvent.Type.PaletteChange and self._figures:
            self._write()

    def contextMenuEvent(self, event: QContextMenuEvent) -> None:
        if self._figures:
            number, index = _numbers(self._hovered or "0.0")
            self._use.menu(self._figures[number], index, self.subject, self.every or self._figures, event.globalPos())

    def _follow_focus(self, old: QWidget | None, new: QWidget | None) -> None:
        # A click leaves the focus to the field that is edited: Qt looks for somebody who takes it among the label and
        # all around it, and stops at one whose proxy has it already.
        self.setFocusProxy(new if isinstance(new, NumberField) else None)  # type: ignore[arg-type]

    def _write(self) -> None:
        colours = colours_now()
        ink, name_ink = (colours.disabled, colours.disabled) if self._faint else (colours.text, colours.muted)
        parts = []
        for number, figure in enumerate(self._figures):
            values = ", ".join(
                f'<a href="{number}.{index}" style="color:{ink}; text-decoration:none">'
                f"{_whole(shown_number(value, self._digits))}</a>"
                for index, value in enumerate(figure.values)
            )
            name = f'<span style="color:{name_ink}">{escape(figure.name)}&nbsp;</span>' if self._named else ""
            gap = "" if figure.unit in ("", "°") else "&nbsp;"
            unit = f'<span style="color:{name_ink}">{gap}{escape(figure.unit)}</span>'
            run = f"{name}{values}{unit}"
            parts.append(run.replace(", ", ",&nbsp;") if self._named else run)
        self.setText(" &nbsp; ".join(parts))

    def _hover(self, link: str) -> None:
        self._hovered = link
        if link:
            number, index = _numbers(link)
            figure = self._figures[number]
            self.setToolTip(f"<b>{escape(figure.name_of(index))}</b>&nbsp;&nbsp;{figure.text(index)}<br>{HINT}")

    def _take(self, link: str) -> None:
        number, index = _numbers(link)
        self._use.take(self._figures[number], index)


def _whole(number: str) -> str:
    """A number with spaces at which no line is broken; Qt breaks at the narrow ones."""
    return escape(number.replace("\u202f", "\u00a0").replace("-", "\u2212"))


def _numbers(link: str) -> tuple[int, int]:
    number, _, index = link.partition(".")
    return int(number), int(index)
