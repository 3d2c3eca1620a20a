"""The Nodes page of the Curve panel: numbers of the chosen nodes and handles, their kinds, and what is done to them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QGridLayout, QHBoxLayout, QLabel, QSizePolicy, QToolButton, QVBoxLayout, QWidget

from ...model.document.document import parameter_values
from ...model.document.errors import Refusal
from ...model.document.expression import Expression, number
from ..panels.number_field import LENGTH, STEPS, NumberField, Steps

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ..commands.actions import Actions
    from .active import ActiveCurve, Call

AXES = ("X", "Y", "Z")
SIDES = ("Handle in", "Handle out")
WEIGHT = Steps(0.1, 0.01, 1.0, minimum=0.0, above=True)
FACTOR = Steps(0.1, 0.01, 1.0)
MIXED = "mixed"


class NodesPage(QWidget):
    """Follows the active curve. `buttons` are rows of names of commands, "" for a gap; those not there are left out."""

    def __init__(
        self,
        active: ActiveCurve,
        actions: Actions,
        buttons: Sequence[Sequence[str]],
        parent: QWidget | None = None,
    ) -> None:
        super().__init__(parent)
        self._active = active
        self.facts = QLabel(self)
        self.facts.setProperty("muted", True)
        self.facts.setWordWrap(True)
        self.chosen = QLabel(self)
        self.places = [self._field(axis, LENGTH) for axis in AXES]
        self.weight = self._field("Weight", WEIGHT)
        self.lengths = [self._field(f"{side}: length", LENGTH) for side in SIDES]
        self.angles = [self._field(f"{side}: angle", STEPS["angle"]) for side in SIDES]
        self.turn = self._field("Turn by", STEPS["angle"])
        self.scale = self._field("Scale by", FACTOR)
        self._labels: dict[QWidget, tuple[QWidget, ...]] = {}
        self._lay_out(actions, buttons)
        for axis, field in enumerate(self.places):
            self._connect(field, lambda value, axis=axis: self._place(axis, value))
        self._connect(self.weight, lambda value: [("set_weights", (self._numbers(), value), {})])
        for side in range(2):
            self._connect(self.lengths[side], lambda value, side=side: self._handle(side, "length", value))
            self._connect(self.angles[side], lambda value, side=side: self._handle(side, "angle", value))
        self._connect(self.turn, lambda value: self._transform(value, 1.0))
        self._connect(self.scale, lambda value: self._transform(0.0, value))
        active.changed.connect(self.follow)
        self.follow()

    def applies(self) -> bool:
        return self._active.path is not None

    def _field(self, name: str, steps: Steps) -> NumberField:
        field = NumberField(steps, self)
        field.setAccessibleName(name)
        return field

    def _lay_out(self, actions: Actions, buttons: Sequence[Sequence[str]]) -> None:
        grid = QGridLayout()
        grid.setHorizontalSpacing(6)
        grid.setVerticalSpacing(5)
        for column in (1, 4):
            grid.setColumnStretch(column, 1)
        self._put(grid, 0, 0, "X", self.places[0], "mm", "Of the chosen nodes, along the outline's own x axis")
        self._put(grid, 0, 3, "Y", self.places[1], "mm", "Of the chosen nodes, along the outline's own y axis")
        self._put(grid, 1, 0, "Z", self.places[2], "mm", "Of the chosen nodes, along the outline's own z axis")
        self._put(grid, 1, 3, "Weight", self.weight, "", "Draws the curve to the chosen control points; 1 is plain")
        for side, words in enumerate(SIDES):
            tip = f"Of the {words.lower()} of the chosen node"
            self._put(grid, 2 + side, 0, words, self.lengths[side], "mm", f"Length {tip[0].lower()}{tip[1:]}")
            self._put(grid, 2 + side, 3, "angle", self.angles[side], "°", f"Direction {tip[0].lower()}{tip[1:]}")
        self._put(
            grid, 4, 0, "Turn", self.turn, "°", "Turn the chosen nodes about their middle; all where none is chosen"
        )
        self._put(grid, 4, 3, "Scale", self.scale, "×", "Scale the chosen nodes about their middle; all where none is")
        layout = QVBoxLayout(self)
        layout.setContentsMargins(10, 8, 10, 8)
        layout.setSpacing(6)
        layout.addWidget(self.chosen)
        layout.addLayout(grid)
        layout.addSpacing(4)
        for names in buttons:
            row = button_row(actions, names, self)
            if row is not None:
                layout.addLayout(row)
        layout.addStretch(1)
        layout.addWidget(self.facts)

    def _put(
        self, grid: QGridLayout, row: int, column: int, words: str, field: NumberField, unit: str, tip: str
    ) -> None:
        label, behind = QLabel(words, self), QLabel(unit, self)
        label.setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        label.setBuddy(field)
        behind.setProperty("muted", True)
        for widget in (label, field):
            widget.setToolTip(tip)
        grid.addWidget(label, row, column)
        grid.addWidget(field, row, column + 1)
        grid.addWidget(behind, row, column + 2)
        self._labels[field] = (label, behind)

    def _connect(self, field: NumberField, calls: Callable[[float], list[Call]]) -> None:
        """`calls` tells what a value asks for; steps preview it, Enter and the end of steps do it."""
        latest: list[float] = []

        def typed(text: str) -> None:
            try:
                value = self._value(text)
            except Refusal as refusal:
                field.set_fault(True)
                self._active.refused.emit(str(refusal))
                return
            field.setModified(False)
            self._active.do_all(calls(value))
            self.follow()

        def stepping(value: float) -> None:
            latest[:] = [value]
            try:
                self._active.preview_all(calls(value))
            except Refusal as refusal:
                self._active.refused.emit(str(refusal))

        def stepped() -> None:
            if latest:
                self._active.do_all(calls(latest.pop()))

        field.typed.connect(typed)
        field.stepping.connect(stepping)
        field.stepped.connect(stepped)

    def _value(self, text: str) -> float:
        """A number, with a unit if there is one, or an expression's value. Raises Refusal."""
        found = number(text, "the number")
        if isinstance(found, Expression):
            return found.evaluate(parameter_values(self._active.document.parameters)[0])
        return found

    # What is asked for.

    def _numbers(self) -> list[int]:
        return sorted(n for _, n in self._active.chosen)

    def _rows(self) -> list[int]:
        return [row for row, place in enumerate(self._active.rows) if place in self._active.chosen]

    def _place(self, axis: int, value: float) -> list[Call]:
        rows = self._rows()
        if not rows:
            return []
        places = self._active.places[rows].copy()
        places[:, axis] = value
        names = [self._active.rows[row] for row in rows]
        points = [tuple(place) for place in places.tolist()]
        if self._active.by_points:
            return [("place_points", ([n for _, n in names], points), {})]
        return [("place_nodes", (names, points), {})]

    def _handle(self, side: int, what: str, value: float) -> list[Call]:
        handle = self._handles()[side]
        return [] if handle is None else [("set_handle", (handle[0],), {what: value})]

    def _transform(self, angle: float, factor: float) -> list[Call]:
        import numpy as np

        rows = self._rows() or list(range(len(self._active.rows)))
        if not rows or self._active.by_points or self._active.places.shape[1] != 2:
            return []
        places = self._active.places[rows]
        middle = 0.5 * (places.min(axis=0) + places.max(axis=0))
        c, s = np.cos(np.radians(angle)), np.sin(np.radians(angle))
        linear = factor * np.array([[c, -s], [s, c]])
        matrix = np.column_stack((linear, middle - linear @ middle))
        names = [self._active.rows[row] for row in rows]
        return [("transform_nodes", (names, [list(row) for row in matrix.tolist()]), {})]

    def _handles(self) -> list[tuple[tuple[int, int], NDArray] | None]:
        """For each side of the one chosen node its handle (contour, row), and the way (d,) there; None without one."""
        if len(self._active.chosen) != 1 or self._active.by_points or self._active.path is None:
            return [None, None]
        from ...model.path.nodes import handles

        ((contour, node),) = self._active.chosen
        curve = self._active.path.contours[contour]
        found = handles(curve)
        here = curve.points[found.node[node]]
        rows = (int(found.before[node]), int(found.after[node]))
        return [((contour, row), curve.points[row] - here) if row >= 0 else None for row in rows]

    # What is shown.

    def follow(self) -> None:
        """Show the numbers as they are now."""
        import numpy as np

        active = self._active
        rows = self._rows()
        places = active.places[rows] if rows else np.zeros((0, 2))
        spatial = active.path is not None and active.places.shape[1] == 3
        for axis, field in enumerate(self.places):
            self._show(field, places[:, axis] if axis < places.shape[1] else np.zeros(0))
            self._set_visible(field, axis < 2 or spatial)
        self._set_visible(self.weight, active.by_points)
        if active.by_points:
            weights = getattr(active.resolved, "weights", ()) or (1.0,) * len(active.places)
            self._show(self.weight, np.array([weights[n] for n in self._numbers()], float))
        found = self._handles()
        for side in range(2):
            handle = found[side]
            way = None if handle is None else handle[1]
            flat = way is not None and len(way) == 2
            self._show(self.lengths[side], np.array([] if way is None else [np.linalg.norm(way)]))
            turn = [np.degrees(np.arctan2(way[1], way[0]))] if way is not None and flat else []
            self._show(self.angles[side], np.array(turn))
            for field in (self.lengths[side], self.angles[side]):
                self._set_visible(field, not active.by_points)
        movable = active.path is not None and not active.by_points and not spatial
        for field, value in ((self.turn, 0.0), (self.scale, 1.0)):
            self._show(field, np.array([value]) if movable else np.zeros(0))
            self._set_visible(field, not active.by_points)
        self.chosen.setText(self._chosen_words(len(rows)))
        self.facts.setText(self._facts())

    def _show(self, field: NumberField, values: NDArray) -> None:
        """One value for all, or that they differ; nothing where there is none."""
        same = len(values) > 0 and float(values.max() - values.min()) <= 1e-9 * max(1.0, float(abs(values).max()))
        field.setEnabled(len(values) > 0)
        field.setPlaceholderText(MIXED if len(values) and not same else "")
        field.set_value(round(float(values[0]), 9) + 0.0 if same else None)

    def _set_visible(self, field: NumberField, visible: bool) -> None:
        for widget in (field, *self._labels[field]):
            widget.setVisible(visible)

    def _chosen_words(self, count: int) -> str:
        active = self._active
        what = "control point" if active.by_points else "node"
        if active.path is None:
            return "Select an outline to edit its nodes."
        if count == 0:
            return f"{len(active.rows)} {what}s, none chosen"
        if count == 1:
            ((contour, place),) = active.chosen
            where = f" of contour {contour}" if len(active.path.contours) > 1 else ""
            return f"{what.capitalize()} {place}{where}"
        return f"{count} of {len(active.rows)} {what}s chosen"

    def _facts(self) -> str:
        path = self._active.path
        if path is None or not path.contours:
            return ""
        closed = [contour for contour in path.contours if contour.closed]
        contours = len(path.contours)
        words = [f"{contours} contour{'s' * (contours > 1)}" + ("" if len(closed) == contours else ", open")]
        words.append(f"length {path.length():.5g} mm")
        if len(closed) == contours and path.contours[0].dimension == 2:
            words.append(f"area {abs(path.area()):.5g} mm²")
        size = path.bounds()[1] - path.bounds()[0]
        words.append(" × ".join(f"{side:.5g}" for side in size.tolist()) + " mm")
        return "  ·  ".join(words)


def button_row(actions: Actions, names: Sequence[str], parent: QWidget) -> QHBoxLayout | None:
    """A row of buttons for commands; None where none of them is there."""
    there = {command.name for command in actions.commands()}
    known = [name for name in names if not name or name in there]
    if not any(known):
        return None
    row = QHBoxLayout()
    row.setSpacing(2)
    for name in known:
        if not name:
            row.addSpacing(8)
            continue
        button = QToolButton(parent)
        button.setDefaultAction(actions[name])
        button.setAutoRaise(True)
        button.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Fixed)
        row.addWidget(button)
    row.addStretch(1)
    return row
