"""The editor of one light: kind, colour, intensity, where it stands and where it shines."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from PySide6.QtWidgets import QWidget

from ..panels.number_field import LENGTH, STEPS, Steps
from .rows import MemberForm

if TYPE_CHECKING:
    from ..window import MainWindow

INTENSITY = Steps(0.05, 0.01, 0.25, 0.0, maximum=100.0)
KIND_WORDS = (("ambient", "ambient"), ("directional", "directional"), ("point", "point"))


class LightForm(MemberForm):
    """Rows that a kind of light has no use for are hidden."""

    def __init__(self, window: MainWindow, parent: QWidget | None = None) -> None:
        super().__init__(window.session, "set_light", parent)
        self._viewport = window.viewport
        self.choice("kind", "Kind", KIND_WORDS, "From everywhere, from far away, or from a place")
        self.colour("colour", "Colour", "of the light")
        self.slider("intensity", "Intensity", (0.0, 1.0, 2.0), "Times the colour; 1 is the light of a plain room",
                    INTENSITY)  # fmt: skip
        with self.where(lambda light: light.kind == "directional"):
            for place, axis in enumerate("xyz"):
                label = f"Shines to {axis}" if place == 0 else axis
                self.component("direction", place, label, "", STEPS["direction"], "The direction in which it shines")
        with self.where(lambda light: light.kind == "point"):
            for place, axis in enumerate("xyz"):
                label = f"Position {axis}" if place == 0 else axis
                self.component("position", place, label, "mm", LENGTH, "Where it stands")
        with self.where(lambda light: light.kind != "ambient"):
            tip = "It moves with the eye: x to the right, y up, z towards the eye"
            self.tick("with_camera", "With camera", tip, self._carry)
            self.tick("shadows", "Shadows", "Faces keep its light from what lies behind them")
        self.column.addStretch(1)

    def _carry(self, with_camera: bool) -> None:
        """Keep the light where it shines now when it begins to go with the camera, or ends to."""
        changes: dict[str, Any] = {"with_camera": with_camera}
        viewer = self._viewport.viewer
        if viewer is not None:
            from .handles.light_handles import carried

            changes = carried(self.member, viewer.camera, with_camera)
        self.session.do("set_light", self.name, label="Change with camera", **changes)
