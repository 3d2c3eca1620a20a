"""Numbers of the glyph that is worked on, of its chosen nodes, and what is done to all chosen glyphs."""

from __future__ import annotations

import unicodedata
from collections.abc import Callable

import numpy as np
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QCheckBox, QFrame, QGridLayout, QHBoxLayout, QLabel, QPushButton, QVBoxLayout, QWidget

from ...model.document.errors import Refusal
from ...model.document.expression import Expression, number
from ...model.lettering.fonts.drawn_glyph import DrawnGlyph
from ..panels.number_field import NumberField, Steps
from . import glyph_edits
from .glyph_canvas import GlyphCanvas
from .glyph_desk import GlyphDesk
from .glyph_list import GlyphList
from .glyph_picture import bounds_of

UNITS = Steps(1.0, 0.1, 10.0)
PERCENT = Steps(5.0, 1.0, 25.0)
DEGREES = Steps(1.0, 0.1, 5.0)


class GlyphSide(QWidget):
    """`buttons` is a row of tools for the chosen nodes."""

    def __init__(
        self, desk: GlyphDesk, canvas: GlyphCanvas, glyphs: GlyphList, buttons: QWidget, parent: QWidget | None = None
    ) -> None:
        super().__init__(parent)
        self._desk, self._canvas, self._glyphs = desk, canvas, glyphs
        self.title, self.meaning = QLabel(self), QLabel(self)
        self.title.setProperty("title", True)
        self.title.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        self.meaning.setProperty("muted", True)
        self.meaning.setWordWrap(True)
        self.width_field = self._field("width", "Width", lambda value: self._set_width(value))
        self.left = self._field("left", "Left bearing", lambda value: self._set_left(value))
        self.right = self._field("right", "Right bearing", lambda value: self._set_right(value))
        self.place_x = self._field("x", "X", lambda value: self._place(0, value))
        self.place_y = self._field("y", "Y", lambda value: self._place(1, value))
        self.nodes = QLabel(self)
        self.nodes.setProperty("muted", True)
        self.before = QCheckBox("Show the shape of the font's file", self)
        self.before.setChecked(True)
        self.before.toggled.connect(canvas.set_before)
        self.slant = self._plain("slant", "Slant", 0.0, DEGREES)
        self.across = self._plain("across", "Width", 100.0, PERCENT)
        self.up = self._plain("up", "Height", 100.0, PERCENT)
        self.weight = self._plain("weight", "Weight", 0.0, UNITS)
        self.apply = QPushButton("Apply", self)
        self.apply.setToolTip("Slant, scale and grow all chosen glyphs, as one step")
        self.apply.clicked.connect(self._apply)
        self.reset = QPushButton("Reset", self)
        self.reset.setToolTip("Give the chosen glyphs the shapes of the font's file again")
        self.reset.clicked.connect(lambda: desk.reset(self._chosen()))
        self.of = QLabel(self)
        self.of.setProperty("heading", True)
        self._lay_out(buttons)
        desk.changed.connect(self.follow)
        canvas.chosen_changed.connect(self.follow)
        glyphs.chosen.connect(self.follow)
        self.follow()

    def _field(self, name: str, label: str, set_: Callable[[float], None]) -> NumberField:
        field = NumberField(UNITS, self)
        field.setObjectName(name)
        field.setAccessibleName(label)
        latest: list[float] = []

        def typed(text: str) -> None:
            value = self._number(text, field)
            if value is not None:
                field.setModified(False)
                set_(value)

        field.typed.connect(typed)
        field.stepping.connect(lambda value: (latest.append(value), field.set_value(value)))
        field.stepped.connect(lambda: set_(latest[-1]) if latest else None)
        return field

    def _plain(self, name: str, label: str, value: float, steps: Steps) -> NumberField:
        """A number that counts with the button alone."""
        field = NumberField(steps, self)
        field.setObjectName(name)
        field.setAccessibleName(label)
        field.set_value(value)

        def typed(text: str) -> None:
            found = self._number(text, field)
            if found is not None:
                field.setModified(False)
                field.set_value(found)

        field.typed.connect(typed)
        field.stepping.connect(field.set_value)
        return field

    def _number(self, text: str, field: NumberField) -> float | None:
        try:
            value = number(text, "the number")
            if isinstance(value, Expression):
                value = value.evaluate({})
            return value
        except Refusal as refusal:
            field.set_fault(True)
            self._desk.refused.emit(str(refusal))
            return None

    def _lay_out(self, buttons: QWidget) -> None:
        layout = QVBoxLayout(self)
        layout.setContentsMargins(12, 10, 12, 10)
        layout.setSpacing(6)
        layout.addWidget(self.title)
        layout.addWidget(self.meaning)
        layout.addSpacing(6)
        layout.addLayout(
            self._grid(
                ("Width", self.width_field, "How far the pen moves on, in font units"),
                ("Left bearing", self.left, "From the origin to the outline: moves the outline"),
                ("Right bearing", self.right, "From the outline to the next letter: changes the width"),
            )
        )
        layout.addWidget(self.before)
        layout.addWidget(self._rule())
        layout.addWidget(self.nodes)
        layout.addLayout(
            self._grid(
                ("X", self.place_x, "Of the chosen nodes"),
                ("Y", self.place_y, "Of the chosen nodes, above the baseline"),
            )
        )
        layout.addWidget(buttons)
        layout.addWidget(self._rule())
        layout.addWidget(self.of)
        layout.addLayout(
            self._grid(
                ("Slant °", self.slant, "Leans to the right about the baseline"),
                ("Width %", self.across, "Of the outline and of the pen's way"),
                ("Height %", self.up, "From the baseline"),
                ("Weight", self.weight, "Grows the outline by so many units on every side; below 0: thinner"),
            )
        )
        row = QHBoxLayout()
        row.addWidget(self.apply)
        row.addWidget(self.reset)
        row.addStretch(1)
        layout.addLayout(row)
        layout.addStretch(1)

    def _grid(self, *rows: tuple[str, QWidget, str]) -> QGridLayout:
        grid = QGridLayout()
        grid.setHorizontalSpacing(8)
        grid.setVerticalSpacing(5)
        grid.setColumnMinimumWidth(0, 84)
        for place, (words, field, tip) in enumerate(rows):
            label = QLabel(words, self)
            label.setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
            label.setBuddy(field)
            label.setToolTip(tip)
            field.setToolTip(tip)
            grid.addWidget(label, place, 0)
            grid.addWidget(field, place, 1)
        return grid

    def _rule(self) -> QFrame:
        rule = QFrame(self)
        rule.setProperty("rule", True)
        return rule

    # What is shown.

    def follow(self) -> None:
        """Show the numbers as they are now."""
        desk = self._desk
        drawn = desk.drawn
        codes = self._glyphs.glyphs.codes.get(desk.glyph, []) if drawn is not None else []
        self.title.setText(desk.glyph if drawn is not None else "No glyph")
        words = [f"U+{code:04X} {unicodedata.name(chr(code), '').lower()}".rstrip() for code in codes[:2]]
        self.meaning.setText(", ".join(words) or ("No character of its own" if drawn is not None else desk.fault))
        bounds = bounds_of(drawn.outline) if drawn is not None else None
        self.width_field.set_value(_shown(drawn.advance) if drawn is not None else None)
        self.left.set_value(_shown(bounds[0]) if bounds is not None else None)
        self.right.set_value(_shown(drawn.advance - bounds[2]) if drawn is not None and bounds is not None else None)
        for field in (self.left, self.right):
            field.setEnabled(bounds is not None)
        self.width_field.setEnabled(drawn is not None)
        places = self._places(drawn)
        total = sum(len(contour.nodes) for contour in drawn.outline.contours) if drawn is not None else 0
        self.nodes.setText(f"{len(places)} of {total} nodes chosen" if len(places) else f"{total} nodes, none chosen")
        for axis, field in enumerate((self.place_x, self.place_y)):
            field.setEnabled(len(places) > 0)
            column = places[:, axis]
            same = len(column) > 0 and float(np.ptp(column)) < 1e-6
            field.setPlaceholderText("mixed" if len(column) and not same else "")
            field.set_value(_shown(float(column[0])) if same else None)
        chosen = self._chosen()
        self.of.setText(f"The {len(chosen):,} chosen glyphs" if len(chosen) > 1 else "The whole glyph")
        self.apply.setEnabled(bool(chosen) and desk.face is not None)
        self.reset.setEnabled(any(name in desk.edited for name in chosen))

    def _places(self, drawn: DrawnGlyph | None) -> np.ndarray:
        """(k, 2) of the chosen nodes."""
        rows = [
            contour.points[contour.starts[node]]
            for c, contour in enumerate(drawn.outline.contours if drawn is not None else ())
            for node in range(len(contour.nodes))
            if (c, node) in self._canvas.chosen
        ]
        return np.array(rows).reshape(-1, 2)

    def _chosen(self) -> list[str]:
        names = self._glyphs.chosen_glyphs()
        return names if len(names) > 1 or not self._desk.glyph else [self._desk.glyph]

    # What is asked for.

    def _set_width(self, value: float) -> None:
        drawn = self._desk.drawn
        if drawn is not None:
            self._desk.put("Change width", drawn.outline, value)

    def _set_left(self, value: float) -> None:
        drawn = self._desk.drawn
        bounds = bounds_of(drawn.outline) if drawn is not None else None
        if drawn is not None and bounds is not None:
            by = value - bounds[0]
            outline = drawn.outline.transformed(((1.0, 0.0, by), (0.0, 1.0, 0.0)))
            self._desk.put("Change left bearing", outline, drawn.advance + by)

    def _set_right(self, value: float) -> None:
        drawn = self._desk.drawn
        bounds = bounds_of(drawn.outline) if drawn is not None else None
        if drawn is not None and bounds is not None:
            self._desk.put("Change right bearing", drawn.outline, bounds[2] + value)

    def _place(self, axis: int, value: float) -> None:
        drawn = self._desk.drawn
        if drawn is not None and self._canvas.chosen:
            self._desk.put("Move nodes", glyph_edits.placed(drawn.outline, self._canvas.chosen, axis, value))

    def _apply(self) -> None:
        fields = (self.slant, self.across, self.up, self.weight)
        for field in fields:
            field.submit()
        values = [self._number(field.text() or "0", field) for field in fields]
        if any(value is None for value in values):
            return
        slant, across, up, weight = (float(value) for value in values)  # type: ignore[arg-type]
        if abs(slant) > 80.0:
            self._desk.refused.emit(f"letters lean by at most 80 degrees, not {slant:g}")
            return
        across, up = 0.01 * across, 0.01 * up
        matrix = [[across, up * float(np.tan(np.radians(slant))), 0.0], [0.0, up, 0.0]]
        if matrix == [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]] and not weight:
            self._desk.refused.emit("these numbers leave the glyphs as they are: type a slant, a scale or a weight")
            return
        chosen = self._chosen()
        label = "Transform glyph" if len(chosen) == 1 else "Transform glyphs"
        self._desk.do("transform_glyphs", chosen, matrix, weight, label=label)
        for field, value in zip(fields, (0.0, 100.0, 100.0, 0.0), strict=True):
            field.set_value(value)


def _shown(value: float) -> float:
    return round(value, 3) + 0.0
