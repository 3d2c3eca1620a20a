"""The properties of what is selected: the form of a node, or what several share, and their measures."""

from __future__ import annotations

from typing import Any

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QFrame, QLabel, QScrollArea, QWidget

from ...model.document.document import parameter_values
from ...model.document.errors import Refusal
from ...model.document.tree import find
from ...model.editing.session import Session, State
from .figures import FigureUse
from .measured import SOLID, Measured
from .measures import MeasuresView
from .node_form import NodeForm, extra_steps


class Properties(QScrollArea):
    """Follows the selection. A change of values keeps the form and the focus in it; another kind makes a new form."""

    refused = Signal(str)

    def __init__(
        self, session: Session, use: FigureUse, placement: QAction | None = None, parent: QWidget | None = None
    ) -> None:
        """`placement` is the command that shows how a texture lies."""
        super().__init__(parent)
        self.setObjectName("properties")
        self.setWidgetResizable(True)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setFrameShape(QFrame.Shape.NoFrame)
        self._session = session
        self._form: NodeForm | None = None
        self._use = use
        self._placement = placement
        self._views: dict[str, MeasuresView] = {}
        self._measured: Measured = {}
        self._shape: Any = None
        self._build()

    def session_changed(self, before: State, after: State) -> None:
        if self._shape_of(after) != self._shape:
            self._build()
        elif before.document is not after.document:
            self._refresh()

    def set_measures(self, measured: Measured) -> None:
        """Those of the selection. Other headings make a new form."""
        headings = list(self._measured)
        self._measured = measured
        if list(measured) != headings:
            self._build()
        for heading, view in self._views.items():
            view.set_measures(*measured[heading])

    def rebuild(self) -> None:
        """Draw the pictures anew, as in another theme."""
        self._build()

    def _shape_of(self, state: State) -> Any:
        """What decides which rows the form has."""
        if len(state.selection) != 1:
            return state.selection
        try:
            node = find(state.document, state.selection[0])
        except Refusal:
            return ()
        by_file = bool(getattr(node, "asset", ""))
        return node.id, type(node), by_file, tuple(type(step) for step in extra_steps(node))

    def _refresh(self) -> None:
        if self._form is not None and self._session.selection:
            document = self._session.document
            node = find(document, self._session.selection[0])
            self._form.refresh(node, parameter_values(document.parameters)[0])

    def _build(self) -> None:
        self._shape = self._shape_of(self._session.state)
        self._views = {}
        old = self.takeWidget()
        if isinstance(old, NodeForm):
            old.retire()
        form = NodeForm(self._session, self._placement, self)
        form.refused.connect(self.refused)
        selection = self._session.selection
        if not self._shape:
            _say_empty(form)
        elif len(selection) == 1:
            form.build(find(self._session.document, selection[0]))
        else:
            form.heading(f"{len(selection)} nodes")
            form.build_look(list(selection))
        if self._shape:
            for heading, (measures, subject) in self._measured.items():
                view = self._views[heading] = MeasuresView(self._use, form)
                view.setObjectName("measures_of_solid" if heading == SOLID else "measures_of_node")
                view.set_measures(measures, subject)
                form.heading(heading, view.copy_button)
                form.column.addWidget(view)
        form.column.addStretch(1)
        self._form = form
        self.setWidget(form)
        self._refresh()


def _say_empty(form: NodeForm) -> None:
    words = QLabel("Nothing is selected.\nClick a face in the picture\nor a row of the tree.", form)
    words.setProperty("muted", True)
    words.setAlignment(Qt.AlignmentFlag.AlignHCenter)
    form.column.addSpacing(24)
    form.column.addWidget(words)
