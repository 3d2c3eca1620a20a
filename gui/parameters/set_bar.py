"""The saved sets of parameter values: a drop-down, and what can be done with the set chosen in it."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QHBoxLayout, QInputDialog, QMenu, QWidget

from ...model.document.document import Document, ParameterSet
from ...model.document.tree import unique_name
from ...model.editing.session import Session
from ...model.operations.parameter_sets import set_in_force, unknown_in_set
from ..icons import icon
from .parameter_row import ChoiceBox, flat_button

AS_SAVED = "As in the file"

Do = Callable[..., bool]


class SetBar(QWidget):
    """`do` does an operation and says what was refused; `notice` carries words for the status bar."""

    notice = Signal(str)
    import_asked = Signal()
    export_asked = Signal()

    def __init__(self, session: Session, do: Do, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("sets")
        self._session = session
        self._do = do
        self.chosen = ""
        """The set whose values the rows are compared with; "" for the file's."""
        self.box = ChoiceBox(self)
        self.box.setAccessibleName("Set of parameter values")
        self.box.setToolTip("Saved sets of values; choosing one applies it, as one step")
        self.box.activated.connect(self._activated)
        self.save = flat_button("save", "Save the values as they are now as a set …", self.save_new, self)
        self.more = flat_button("more", "Update, rename, delete, import and export sets", self._open_menu, self)
        layout = QHBoxLayout(self)
        layout.setContentsMargins(10, 6, 6, 6)
        layout.setSpacing(2)
        layout.addWidget(self.box, 1)
        layout.addWidget(self.save)
        layout.addWidget(self.more)

    def refresh(self, document: Document) -> None:
        names = [one.name for one in document.sets]
        if self.chosen not in names:
            self.chosen = set_in_force(document)
        changed = self._changed(document)
        if changed and (other := set_in_force(document)):
            self.chosen, changed = other, False
        titles = [AS_SAVED, *names]
        place = titles.index(self.chosen, 1) if self.chosen else 0
        shown = [f"{title} (changed)" if i == place and changed else title for i, title in enumerate(titles)]
        if shown != [self.box.itemText(i) for i in range(self.box.count())]:
            self.box.clear()
            self.box.addItems(shown)
        self.box.setCurrentIndex(place)

    def kept(self, document: Document) -> tuple[dict[str, object], str]:
        """The values that rows are reset to, and whose they are."""
        one = self._set(document, self.chosen)
        if one is not None:
            return dict(one.values), f"as in “{one.name}”"
        return {p.name: p.value for p in self._session.saved.parameters}, "as in the file"

    def _changed(self, document: Document) -> bool:
        kept = self.kept(document)[0]
        return any(p.name in kept and kept[p.name] != p.value for p in document.parameters)

    def _set(self, document: Document, name: str) -> ParameterSet | None:
        return next((one for one in document.sets if name and one.name == name), None)

    def _activated(self, place: int) -> None:
        if place == 0:
            self.chosen = ""
            self.reset_all()
        else:
            self.apply(self._session.document.sets[place - 1].name)

    def apply(self, name: str) -> None:
        """Apply a saved set."""
        document, before = self._session.document, self.chosen
        one = self._set(document, name)
        self.chosen = name
        if not self._do("apply_set", f"Apply {name}", name):
            self.chosen = before
        elif one is not None and (unknown := unknown_in_set(document, one)):
            self.notice.emit(f"“{name}”: {', '.join(unknown)} is no parameter here and was left out")
        self.refresh(self._session.document)

    def reset_all(self) -> None:
        """Back to the values of the chosen set, or the file's."""
        document = self._session.document
        kept, whose = self.kept(document)
        values = [(p.name, kept[p.name]) for p in document.parameters if p.name in kept]
        self._do("set_parameters", f"Values {whose}", values)
        self.refresh(self._session.document)

    def save_new(self) -> None:
        """Ask for a name, and keep the values under it."""
        suggestion = unique_name("Set", [one.name for one in self._session.document.sets])
        self._ask("Save the values as a set", suggestion, self._save)

    def save_again(self) -> None:
        """Keep the values under the chosen set's name."""
        if self.chosen:
            self._save(self.chosen)

    def _save(self, name: str) -> None:
        if self._do("save_set", f"Save set {name}", name):
            self.chosen = " ".join(name.split())
            self.refresh(self._session.document)

    def _rename(self, name: str) -> None:
        old, self.chosen = self.chosen, " ".join(name.split())
        if not self._do("rename_set", f"Rename set {old}", old, name):
            self.chosen = old
        self.refresh(self._session.document)

    def _ask(self, title: str, text: str, then: Callable[[str], None]) -> None:
        dialog = QInputDialog(self)
        dialog.setWindowTitle(title)
        dialog.setLabelText("Name")
        dialog.setTextValue(text)
        dialog.resize(360, dialog.sizeHint().height())  # the title is wider than the field
        dialog.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        dialog.textValueSelected.connect(then)
        dialog.open()

    def _open_menu(self) -> None:
        menu = QMenu(self.window())
        menu.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        name = self.chosen
        menu.addAction(icon("save"), "Save as a new set …", self.save_new)
        for title, run in (
            (f"Update “{name}”" if name else "Update the set", self.save_again),
            ("Rename …", lambda: self._ask("Rename the set", name, self._rename)),
            ("Delete", lambda: self._do("delete_set", f"Delete set {name}", name)),
        ):
            menu.addAction(title.replace("&", "&&"), run).setEnabled(bool(name))
        menu.addSeparator()
        menu.addAction("Back to the values of the set" if name else "Back to the values in the file", self.reset_all)
        menu.addSeparator()
        menu.addAction(icon("import"), "Import sets …", self.import_asked.emit)
        menu.addAction(icon("export"), "Export sets …", self.export_asked.emit).setEnabled(
            bool(self._session.document.sets)
        )
        menu.popup(self.more.mapToGlobal(self.more.rect().bottomLeft()))
