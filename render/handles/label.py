"""A few words beside a place of the picture, on a ground of their own."""

from __future__ import annotations

from collections.abc import Sequence

from vtkmodules.vtkRenderingCore import vtkProp, vtkTextActor

from ..camera import Camera
from ..look import Look, mixed, rgb

LETTERS = 10.5  # points
ASIDE = (18.0, 18.0)  # logical pixels from the place to the label's corner
MARGIN = 6.0  # between the label and the picture's border


class Label:
    """A `Mark`. It keeps within the picture."""

    def __init__(self) -> None:
        self._actor = vtkTextActor()
        self._actor.VisibilityOff()
        self._actor.PickableOff()
        letters = self._actor.GetTextProperty()
        letters.SetFontFamilyToArial()
        letters.SetVerticalJustificationToTop()
        letters.SetLineOffset(2.0)
        self._fault = False
        self.text = ""
        self._place = (0.0, 0.0)

    @property
    def props(self) -> Sequence[vtkProp]:
        return (self._actor,)

    def show(self, text: str, x: float = 0.0, y: float = 0.0, fault: bool = False) -> None:
        """These words beside pixel (x, y), none for ""; `fault` says that something is wrong with them."""
        self.text, self._place = text, (x, y)
        self._actor.SetVisibility(bool(text))
        if text:
            self._actor.SetInput(f" {text} ")
        if fault != self._fault:
            self._fault = fault
            self.set_look(self._look)

    def set_look(self, look: Look) -> None:
        self._look = look
        ground = rgb(look.cube_face)
        letters = self._actor.GetTextProperty()
        letters.SetColor(*rgb(look.cube_text))
        letters.SetBackgroundColor(*mixed(ground, rgb("#d03a30"), 0.45) if self._fault else ground)
        letters.SetBackgroundOpacity(0.94)
        letters.SetFrame(True)
        letters.SetFrameColor(*mixed(ground, rgb(look.cube_text), 0.4))

    def before_render(self, camera: Camera, size: tuple[float, float], scale: float) -> None:
        if not self.text:
            return
        letters = self._actor.GetTextProperty()
        letters.SetFontSize(round(LETTERS * scale * 96 / 72))
        letters.SetFrameWidth(max(1, round(scale)))
        box = [0.0, 0.0, 0.0, 0.0]
        renderers = self._actor.GetConsumer(0) if self._actor.GetNumberOfConsumers() else None
        width = height = 0.0
        if renderers is not None:
            self._actor.GetBoundingBox(renderers, box)
            width, height = (box[1] - box[0]) / scale, (box[3] - box[2]) / scale
        x, y = self._place[0] + ASIDE[0], self._place[1] + ASIDE[1]
        if x + width > size[0] - MARGIN:
            x = max(self._place[0] - ASIDE[0] - width, MARGIN)
        if y + height > size[1] - MARGIN:
            y = max(self._place[1] - ASIDE[1] - height, MARGIN)
        self._actor.SetDisplayPosition(round(x * scale), round((size[1] - y) * scale))
