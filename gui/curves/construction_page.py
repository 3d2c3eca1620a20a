"""The Construction page of the Curve panel: a point of a segment, how it is made, and what it is made of."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtCore import QRectF, QSize, Qt, QTimer
from PySide6.QtGui import QColor, QHideEvent, QKeyEvent, QPainter, QPaintEvent
from PySide6.QtWidgets import (
    QCheckBox,
    QFrame,
    QGridLayout,
    QHBoxLayout,
    QLabel,
    QScrollArea,
    QSizePolicy,
    QSpinBox,
    QToolButton,
    QVBoxLayout,
    QWidget,
)

from ...model.document.errors import Refusal
from ...model.document.expression import Expression
from ...model.document.expression import number as number_of
from ..icons import icon
from ..panels.heading import heading
from ..panels.number_field import NumberField, Steps
from ..partition.order_bar import StepSlider
from ..theme import colours_now
from . import construction_words as words
from .construction import MOST_STEPS, MOST_STRINGS

if TYPE_CHECKING:
    from ...model.outline.construction import Construction
    from .active import ActiveCurve
    from .construction import ConstructionView

FINE = 1000  # steps of the slider
INTERVAL, LASTING = 30, 5000  # milliseconds from picture to picture, and from one end to the other
T = Steps(0.05, 0.01, 0.1, minimum=0.0, maximum=1.0)
ROW, GAP = 18, 4  # height of a bar with its numbers, and room beside it


class BasisBars(QWidget):
    """A bar for each control point: what it weighs in the point, in the colour that it has in the picture."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.values: tuple[float, ...] = ()
        self.first = 0
        self.setAccessibleName("What each control point weighs in the point")
        self.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Fixed)

    def show_values(self, values: tuple[float, ...], first: int) -> None:
        """`first` is the number of the first control point."""
        if len(values) != len(self.values):
            self.updateGeometry()
        self.values, self.first = values, first
        self.setAccessibleDescription(", ".join(f"P{n} {one:.3f}" for n, one in enumerate(values, first)))
        self.update()

    def sizeHint(self) -> QSize:
        return QSize(160, ROW * len(self.values))

    def minimumSizeHint(self) -> QSize:
        return QSize(100, ROW * len(self.values))

    def paintEvent(self, event: QPaintEvent) -> None:
        from ...render.curves.construction_colours import colour_of_point

        colours = colours_now()
        light = QColor(colours.text).lightness() < 128
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        metrics = self.fontMetrics()
        left = metrics.horizontalAdvance(f"P{self.first + len(self.values)}") + 2 * GAP
        right = metrics.horizontalAdvance("0.000") + 2 * GAP
        wide = max(self.width() - left - right, 10)
        for row, one in enumerate(self.values):
            tone, top = QColor(colour_of_point(self.first + row, light)), row * ROW
            painter.setPen(tone)
            painter.drawText(QRectF(0, top, left - GAP, ROW), _LEFT, f"P{self.first + row}")
            painter.setPen(Qt.PenStyle.NoPen)
            painter.setBrush(QColor(colours.border))
            painter.drawRoundedRect(QRectF(left, top + 5, wide, ROW - 10), 2, 2)
            painter.setBrush(tone)
            painter.drawRoundedRect(QRectF(left, top + 5, wide * min(max(one, 0.0), 1.0), ROW - 10), 2, 2)
            painter.setPen(QColor(colours.text))
            painter.drawText(QRectF(left + wide + GAP, top, right - GAP, ROW), _RIGHT, f"{one:.3f}")
        painter.end()


_LEFT = Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter
_RIGHT = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter


class ConstructionPage(QScrollArea):
    """Shows and steers a `ConstructionView`. Playing goes from 0 to 1 and back until it is stopped."""

    def __init__(self, active: ActiveCurve, view: ConstructionView, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._active, self._view = active, view
        self.setWidgetResizable(True)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setFrameShape(QFrame.Shape.NoFrame)
        body = QWidget(self)
        self.switch = QCheckBox("Show", body)
        self.switch.setToolTip("Show in the viewport how a point of the curve is constructed")
        self.back = _button("arrow_left", "The segment before", body)
        self.forward = _button("arrow_right", "The next segment", body)
        self.where = _words(body)
        self.play = _button("play", "Play t from 0 to 1 and back (Space)", body)
        self.slider = StepSlider(Qt.Orientation.Horizontal, body)
        self.slider.setRange(0, FINE)
        self.slider.setPageStep(FINE // 10)
        self.slider.setSingleStep(FINE // 100)
        self.slider.setAccessibleName("t, along the segment")
        self.slider.setToolTip("Where on the segment: t from 0 to 1")
        self.field = NumberField(T, body)
        self.field.setAccessibleName("t")
        self.field.setToolTip("Where on the segment: t from 0 to 1")
        self.field.setMaximumWidth(64)
        self.split = QCheckBox("Split polygons", body)
        self.split.setToolTip("The control polygons of the two curves into which the point cuts this one")
        self.strings = _counter("Strings", MOST_STRINGS, "Lines that touch the curve, at even t: string art", body)
        self.steps = _counter("Steps", MOST_STEPS, "Chords in place of the curve; 0 for the curve alone", body)
        self.deviation = _words(body)
        self.bars = BasisBars(body)
        self.sum = _words(body)
        self.lerp = _words(body)
        self.interval = _words(body)
        self.polynomials = QLabel(body)
        self.value = QLabel(body)
        for label in (self.polynomials, self.value):
            label.setWordWrap(True)
            label.setTextFormat(Qt.TextFormat.PlainText)
            label.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        self.details = QWidget(body)
        self._lay_out(body)
        self.setWidget(body)
        self._clock = QTimer(self)
        self._clock.setInterval(INTERVAL)
        self._clock.timeout.connect(self._tick)
        self._way = 1.0
        self.switch.toggled.connect(view.set_on)
        self.back.clicked.connect(lambda: view.go(-1))
        self.forward.clicked.connect(lambda: view.go(1))
        self.play.clicked.connect(self.toggle)
        self.slider.valueChanged.connect(lambda value: view.set_t(value / FINE))
        self.field.typed.connect(self._typed)
        self.field.stepping.connect(view.set_t)
        self.split.toggled.connect(view.set_split)
        for counter in (self.strings, self.steps):
            counter.valueChanged.connect(lambda _: view.set_counts(self.strings.value(), self.steps.value()))
        view.changed.connect(self.follow)
        self.follow()

    def applies(self) -> bool:
        path = self._active.path
        return path is not None and bool(path.contours)

    def _lay_out(self, body: QWidget) -> None:
        first = QHBoxLayout()
        first.setSpacing(2)
        first.addWidget(self.switch, 1)
        first.addWidget(self.back)
        first.addWidget(self.forward)
        along = QHBoxLayout()
        along.setSpacing(4)
        along.addWidget(self.play)
        along.addWidget(self.slider, 1)
        along.addWidget(QLabel("t", body))
        along.addWidget(self.field)
        counts = QGridLayout()
        counts.setHorizontalSpacing(8)
        counts.setVerticalSpacing(6)
        for row, (title, counter) in enumerate((("Strings", self.strings), ("Steps", self.steps))):
            label = QLabel(title, body)
            label.setBuddy(counter)
            label.setToolTip(counter.toolTip())
            counts.addWidget(label, row, 0)
            counts.addWidget(counter, row, 1)
        counts.addWidget(self.split, 0, 2)
        counts.addWidget(self.deviation, 1, 2)
        counts.setColumnStretch(2, 1)
        inside = QVBoxLayout(self.details)
        inside.setContentsMargins(0, 0, 0, 0)
        inside.setSpacing(6)
        inside.addLayout(along)
        inside.addWidget(self.interval)
        inside.addWidget(self.value)
        inside.addWidget(heading("Levels", body))
        inside.addWidget(self.lerp)
        inside.addLayout(counts)
        inside.addWidget(heading("Basis", body))
        inside.addWidget(self.bars)
        inside.addWidget(self.sum)
        inside.addWidget(heading("Polynomial", body))
        inside.addWidget(self.polynomials)
        layout = QVBoxLayout(body)
        layout.setContentsMargins(10, 8, 10, 8)
        layout.setSpacing(6)
        layout.addLayout(first)
        layout.addWidget(self.where)
        layout.addWidget(self.details)
        layout.addStretch(1)

    # Playing.

    @property
    def playing(self) -> bool:
        return self._clock.isActive()

    def toggle(self) -> None:
        """Play or stop; it begins with what it shows."""
        if self.playing:
            self.stop()
        elif self._view.made is not None:
            self._clock.start()
            self._show_state()

    def stop(self) -> None:
        self._clock.stop()
        self._show_state()

    def _show_state(self) -> None:
        self.play.setIcon(icon("pause" if self.playing else "play"))

    def _tick(self) -> None:
        t = self._view.t + self._way * INTERVAL / LASTING
        if not 0.0 < t < 1.0:
            self._way = -1.0 if t >= 1.0 else 1.0
        self._view.set_t(t)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.key() == Qt.Key.Key_Space:
            self.toggle()
        else:
            super().keyPressEvent(event)

    def hideEvent(self, event: QHideEvent) -> None:
        super().hideEvent(event)
        self.stop()

    # What is shown.

    def _typed(self, text: str) -> None:
        try:
            found = number_of(text, "t")
            if isinstance(found, Expression):
                found = found.evaluate({})
            if not 0.0 <= found <= 1.0:
                raise Refusal(f"t is from 0 to 1 on a segment, not {found:g}")
        except Refusal as refusal:
            self.field.set_fault(True)
            self._active.refused.emit(str(refusal))
            return
        self.field.setModified(False)
        self._view.set_t(found)
        self._show_t()

    def _show_t(self) -> None:
        self.slider.blockSignals(True)
        self.slider.setValue(round(self._view.t * FINE))
        self.slider.blockSignals(False)
        self.field.set_value(round(self._view.t, 4))

    def follow(self) -> None:
        """Show the construction as it is now."""
        view, path = self._view, self._active.path
        made = view.made
        self.switch.blockSignals(True)
        self.switch.setChecked(view.on)
        self.switch.blockSignals(False)
        count = 0 if path is None else sum(len(contour) for contour in path.contours)
        for button in (self.back, self.forward):
            button.setEnabled(view.on and count > 1)
        self.details.setVisible(made is not None)
        self._show_t()
        if made is None or path is None or view.segment is None:
            self.where.setText("How a point of the curve is constructed: levels, strings, basis and polynomial.")
            if self.playing:
                self.stop()
            return
        where = words.place(path, view.at, view.segment)
        self.where.setText(where[0].upper() + where[1:])
        self.deviation.setText(f"off by {words.number(view.deviation)} mm" if view.steps else "the curve alone")
        self._tell(made)

    def _tell(self, made: Construction) -> None:
        values = tuple(made.basis.tolist())
        self.bars.show_values(values, made.first)
        self.sum.setText(f"Sum {sum(values):.3f}: the point is the mean of the control points in these shares.")
        self.lerp.setText(words.lerp(made))
        self.interval.setText(words.interval(made))
        self.interval.setVisible(bool(self.interval.text()))
        self.value.setText(words.value(made))
        self.polynomials.setText(words.polynomials(made))


def _button(name: str, tip: str, parent: QWidget) -> QToolButton:
    button = QToolButton(parent)
    button.setProperty("flat", True)
    button.setIcon(icon(name))
    button.setToolTip(tip)
    button.setAccessibleName(tip)
    return button


def _counter(name: str, most: int, tip: str, parent: QWidget) -> QSpinBox:
    box = QSpinBox(parent)
    box.setRange(0, most)
    box.setAccessibleName(name)
    box.setToolTip(tip)
    return box


def _words(parent: QWidget) -> QLabel:
    label = QLabel(parent)
    label.setProperty("muted", True)
    label.setWordWrap(True)
    return label
