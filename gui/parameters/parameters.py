"""The customizer: the document's parameters with the editors they call for, in groups, and saved sets of values."""

from __future__ import annotations

from functools import partial
from typing import Any

from PySide6.QtCore import QPoint, Qt, QTimer, Signal
from PySide6.QtWidgets import QFrame, QLabel, QLineEdit, QMenu, QPushButton, QScrollArea, QVBoxLayout, QWidget

from ...model.document.document import Parameter, parameter_values
from ...model.document.errors import Refusal
from ...model.document.tree import find, unique_name
from ...model.editing.session import Session, State
from ...model.operations.parameters import parameter_users
from ..icons import icon
from ..panels.property_edit import sentence
from .fold import Fold
from .parameter_definition import Definition
from .parameter_row import ParameterRow
from .set_bar import SetBar

MANY = 10  # parameters from which on there is a field to find one


class Parameters(QWidget):
    """`refused` carries why a change was not made, and other words for the status bar.

    A change of values keeps the rows and the focus in them; rows move when names, groups or their order change.
    """

    refused = Signal(str)

    def __init__(self, session: Session, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("parameters")
        self._session = session
        self._seen: tuple[Any, ...] = ()
        self._shape: Any = None
        self._folded: set[str] = set()
        self._defining = ""
        self.rows: dict[str, ParameterRow] = {}
        self.definition: Definition | None = None
        self.sets = SetBar(session, self.do, self)
        self.sets.notice.connect(self.refused)
        self.search = QLineEdit(self)
        self.search.setObjectName("find_parameter")
        self.search.setPlaceholderText("Find a parameter …")
        self.search.setClearButtonEnabled(True)
        self.search.textChanged.connect(self._filter)
        self._search_line = QWidget(self)
        search_layout = QVBoxLayout(self._search_line)
        search_layout.setContentsMargins(10, 0, 10, 6)
        search_layout.addWidget(self.search)
        self.area = QScrollArea(self)
        self.area.setWidgetResizable(True)
        self.area.setFrameShape(QFrame.Shape.NoFrame)
        self.area.setProperty("plain", True)  # the folds have lines of their own
        self.area.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self._body = QWidget()
        self._column = QVBoxLayout(self._body)
        self._column.setContentsMargins(0, 0, 0, 12)
        self._column.setSpacing(0)
        self.hint = QLabel(
            "A parameter is a number with a name. Write the name in any number field, or reckon with it: width / 2 + 3."
        )
        self.hint.setProperty("muted", True)
        self.hint.setWordWrap(True)
        self.hint.setContentsMargins(12, 8, 12, 8)
        self.add = QPushButton(icon("add"), "Add a parameter")
        self.add.setObjectName("add_parameter")
        self.add.setProperty("line", True)
        self.add.setFlat(True)
        self.add.clicked.connect(self.add_parameter)
        self.area.setWidget(self._body)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(0)
        layout.addWidget(self.sets)
        layout.addWidget(self._search_line)
        layout.addWidget(self.area, 1)
        self._folds: dict[str, Fold] = {}
        self._column.addWidget(self.hint)
        self._column.addWidget(self.add, 0, Qt.AlignmentFlag.AlignLeft)
        self._column.addStretch(1)
        self._follow()

    def session_changed(self, before: State, after: State) -> None:
        self._follow()

    # What others ask for.

    def do(self, operation: str, label: str, *arguments: Any, **keywords: Any) -> bool:
        """Do an operation; a refusal goes to the status bar."""
        try:
            self._session.do(operation, *arguments, label=label, **keywords)
        except Refusal as refusal:
            self._session.cancel()
            self.refused.emit(sentence(refusal))
            return False
        return True

    def add_parameter(self) -> None:
        """Declare one, and open its definition with the name selected."""
        taken = [p.name for p in self._session.document.parameters]
        name = unique_name("size", taken).replace(" ", "_")
        group = self._session.document.parameter(self._defining).group if self._defining in taken else ""
        more = {"group": group} if group else {}
        self._defining = name
        if self.do("set_parameter", "Add parameter", name, 10.0, **more):
            self.define(name)

    def define(self, name: str) -> None:
        """Open the definition of a parameter in place of its row's lower half."""
        self._session.document.parameter(name)
        self._defining = name
        self._show_definition()
        if self.definition is not None:
            line = self.definition.fields["name"]
            line.setFocus(Qt.FocusReason.OtherFocusReason)
            line.selectAll()
            self._reveal(self.definition)

    def show_parameter(self, name: str) -> None:
        """Bring a parameter's row into sight, with the focus in its editor."""
        row = self.rows[name]
        self.search.clear()
        self._folds[self._session.document.parameter(name).group].set_open(True)
        row.focus_editor()
        self._reveal(row)

    def select_users(self, name: str) -> None:
        """Select the nodes that a parameter reaches."""
        users = parameter_users(self._session.document, name)
        if users:
            self._session.select(users)
        self.refused.emit("" if users else f"Nothing uses {name} yet")

    def move_parameter(self, name: str, by: int) -> None:
        """Move a parameter among those of its group."""
        parameters = self._session.document.parameters
        group = self._session.document.parameter(name).group
        beside = [i for i, p in enumerate(parameters) if p.group == group]
        place = next(i for i in beside if parameters[i].name == name)
        to = beside.index(place) + by
        if 0 <= to < len(beside):
            self.do("reorder_parameter", f"Move {name}", name, beside[to])

    def delete(self, name: str) -> None:
        if self.do("delete_parameter", f"Delete {name}", name) and self._defining == name:
            self._defining = ""
            self._follow()

    # What is shown.

    def _follow(self) -> None:
        document = self._session.document
        seen = (document.parameters, document.sets, self._session.saved)
        if len(self._seen) == 3 and all(a is b for a, b in zip(seen, self._seen, strict=True)):
            return
        self._seen = seen
        parameters = document.parameters
        shape = [(p.name, p.group) for p in parameters]
        if shape != self._shape:
            self._shape = shape
            self._arrange(parameters)
        self.sets.refresh(document)
        kept, whose = self.sets.kept(document)
        values, faults = parameter_values(parameters)
        for p in parameters:
            fault = faults.get(p.name, "")
            self.rows[p.name].refresh(p, values.get(p.name), fault, kept.get(p.name), whose)  # type: ignore[arg-type]
        if self.definition is not None and self._defining in self.rows:
            self.definition.refresh(document.parameter(self._defining))
        self.hint.setVisible(not parameters)
        self.sets.setVisible(bool(parameters))
        self._search_line.setVisible(len(parameters) >= MANY)

    def _arrange(self, parameters: tuple[Parameter, ...]) -> None:
        """Put the rows into the folds of their groups, in order; rows and folds that stay are kept."""
        names = {p.name for p in parameters}
        self._follow_rename(parameters)
        focus = self._body.focusWidget() if self._body.isAncestorOf(self.focusWidget() or self) else None
        if not names & self.rows.keys():  # another document
            self.area.verticalScrollBar().setValue(0)
        for name in [name for name in self.rows if name not in names]:
            _retire(self.rows.pop(name))
        if self._defining not in names:
            self._close_definition()
        groups = list(dict.fromkeys(p.group for p in sorted(parameters, key=lambda p: bool(p.group))))
        for group in [group for group in self._folds if group not in groups]:
            fold = self._folds.pop(group)
            for row in fold.content.findChildren(ParameterRow):
                row.setParent(self._body)
            _retire(fold)
        for place, group in enumerate(groups):
            fold = self._folds.get(group)
            if fold is None:
                fold = self._folds[group] = Fold(group or "Parameters", self._body)
            self._column.insertWidget(place, fold)
            fold.heading.setVisible(len(groups) > 1 or bool(group))
            for index, p in enumerate(p for p in parameters if p.group == group):
                if p.name not in self.rows:
                    self.rows[p.name] = self._row(p.name)
                fold.column.insertWidget(index, self.rows[p.name])
                self.rows[p.name].show()
        if self._defining in self.rows:
            self._show_definition()
        if focus is not None:
            focus.setFocus(Qt.FocusReason.OtherFocusReason)
        self._filter(self.search.text())

    def _follow_rename(self, parameters: tuple[Parameter, ...]) -> None:
        """Where one name alone is another one now, its row and its definition go on with it."""
        old, new = list(self.rows), [p.name for p in parameters]
        gone, come = set(old) - set(new), set(new) - set(old)
        if len(gone) == len(come) == 1:
            before, after = gone.pop(), come.pop()
            self.rows[after] = self.rows.pop(before)
            self.rows[after].rename(after)
            if self._defining == before:
                self._defining = after
                if self.definition is not None:
                    self.definition.name = after

    def _row(self, name: str) -> ParameterRow:
        row = ParameterRow(self._session, name, self._body)
        row.menu_asked.connect(self._open_menu)
        row.define_asked.connect(self._toggle_definition)
        row.reset_asked.connect(self._reset)
        return row

    def _reset(self, name: str) -> None:
        kept = self.sets.kept(self._session.document)[0]
        if name in kept:
            self.do("set_parameters", f"Reset {name}", [(name, kept[name])])

    def _toggle_definition(self, name: str) -> None:
        if self._defining == name:
            self._close_definition()
        else:
            self.define(name)

    def _show_definition(self) -> None:
        row = self.rows[self._defining]
        if self.definition is not None:
            if self.definition.name == self._defining:
                row.column.addWidget(self.definition)
                return
            _retire(self.definition)
        self.definition = form = Definition(self._session, self._session.document.parameter(self._defining), row)
        form.closed.connect(self._close_definition)
        form.moved.connect(self.move_parameter)
        form.delete_asked.connect(self.delete)
        row.column.addWidget(form)
        form.show()

    def _close_definition(self) -> None:
        self._defining = ""
        if self.definition is not None:
            form, self.definition = self.definition, None
            _retire(form)

    def _filter(self, text: str) -> None:
        wanted = text.strip().lower()
        document = self._session.document
        for p in document.parameters:
            if p.name in self.rows:
                self.rows[p.name].setVisible(wanted in f"{p.name} {p.note} {p.group}".lower())
        for group, fold in self._folds.items():
            members = [p.name for p in document.parameters if p.group == group and p.name in self.rows]
            fold.setVisible(any(not self.rows[name].isHidden() for name in members))

    def _reveal(self, widget: QWidget) -> None:
        QTimer.singleShot(0, widget, partial(self.area.ensureWidgetVisible, widget))  # when the layout has its sizes

    def _open_menu(self, name: str, at: QPoint | None) -> None:
        document = self._session.document
        row = self.rows[name]
        menu = QMenu(self.window())
        menu.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        menu.setToolTipsVisible(True)
        menu.addAction(icon("rename"), "Definition …", lambda: self.define(name))
        users = parameter_users(document, name)
        few = ", ".join(find(document, one).label for one in users[:5])
        action = menu.addAction(f"Select users ({len(users)})", lambda: self.select_users(name))
        action.setEnabled(bool(users))
        action.setToolTip(few + (" …" if len(users) > 5 else ""))
        reset = menu.addAction(icon("reset"), row.reset.toolTip() or "Reset", lambda: self._reset(name))
        reset.setEnabled(not row.reset.isHidden())
        menu.addSeparator()
        group = [p.name for p in document.parameters if p.group == document.parameter(name).group]
        menu.addAction(icon("up"), "Move up", lambda: self.move_parameter(name, -1)).setEnabled(group[0] != name)
        menu.addAction(icon("down"), "Move down", lambda: self.move_parameter(name, 1)).setEnabled(group[-1] != name)
        menu.addSeparator()
        menu.addAction(icon("delete"), "Delete", lambda: self.delete(name))
        menu.popup(at or row.more.mapToGlobal(row.more.rect().bottomLeft()))


def _retire(widget: QWidget) -> None:
    """Before it goes: what loses the focus by that must not change the document."""
    for child in widget.findChildren(QWidget):
        child.blockSignals(True)
    widget.hide()
    widget.deleteLater()
