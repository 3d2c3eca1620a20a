"""The handle of the chosen light: a point light is moved, a directional one turned about the model's middle."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from PySide6.QtCore import QObject, Signal

from ....model.surface.light import Light
from .handle_tool import Drag, HandleTool

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from ....model.editing.session import Session
    from ....render.handles.handle import Handle
    from ....render.handles.handle_marks import HandleMarks
    from ....render.viewer import Viewer
    from ...view.viewport import Viewport


class LightTool(HandleTool):
    """`picked` tells the name of a light whose marker was clicked."""

    picked = Signal(str)

    def __init__(self, session: Session, viewport: Viewport, parent: QObject | None = None) -> None:
        super().__init__(session, viewport, parent)
        self.name = ""

    @property
    def light(self) -> Light | None:
        """The one that has handles."""
        return next((light for light in self._session.document.lights if light.name == self.name), None)

    def choose(self, name: str) -> None:
        """Show the handles of this light; "" for none."""
        if name != self.name:
            self.name = name
            self.show_handles()

    def make_marks(self) -> HandleMarks:
        from .light_handles import FollowingMarks

        return FollowingMarks(self._with_camera)

    def _with_camera(self) -> tuple[Handle, ...] | None:
        """The handles of a light that goes with the camera, where the camera is now."""
        light, viewer = self.light, self._viewer
        return self.handles(viewer) if light is not None and light.with_camera and viewer is not None else None

    def handles(self, viewer: Viewer) -> tuple[Handle, ...]:
        light = self.light
        if light is None or not light.active or self.aside:
            return ()
        from .light_handles import light_handles

        others = tuple(other for other in self._session.document.lights if other.name != self.name)
        return light_handles(light, others, viewer.camera, self._middle(viewer))

    def begin(self, viewer: Viewer, handle: Handle, x: float, y: float) -> Drag | None:
        from .light_handles import OTHER, TURN

        light = self.light
        if light is None:
            return None
        if handle.name.startswith(OTHER):
            self.picked.emit(handle.name.removeprefix(OTHER))
            return None
        if handle.name == TURN:
            return self._turn(viewer, light, x, y)
        return self._move(viewer, handle, light, x, y)

    def _turn(self, viewer: Viewer, light: Light, x: float, y: float) -> Drag:
        from ....render.camera import frame
        from ....render.handles.drag import view_direction
        from .light_handles import on_sphere, rounded, towards

        middle = self._middle(viewer)
        far = bool(towards(light, viewer.camera) @ view_direction(viewer.camera, middle) < 0.0)
        grabbed = towards(light, viewer.camera) - on_sphere(middle, viewer.camera, viewer.size, viewer.ray(x, y), far)

        def follow(x: float, y: float, fine: bool) -> tuple[dict[str, Any], str]:
            way = on_sphere(middle, viewer.camera, viewer.size, viewer.ray(x, y), far) + grabbed
            if light.with_camera:
                way = frame(viewer.camera) @ way
            direction = rounded(-way / max(float((way @ way) ** 0.5), 1e-9), 4)
            return {"direction": direction}, f"{light.name}: shines to {_words(direction)}"

        return Drag(f"Turn {light.name}", "set_light", (light.name,), follow)

    def _move(self, viewer: Viewer, handle: Handle, light: Light, x: float, y: float) -> Drag | None:
        from ....render.camera import frame
        from ....render.handles.drag import pixel_length, step_for, stepped
        from .light_handles import moved_place, place_of, rounded

        place = place_of(light, viewer.camera)
        start = moved_place(handle, viewer.camera, viewer.ray(x, y), place)
        if start is None:
            return None

        def follow(x: float, y: float, fine: bool) -> tuple[dict[str, Any], str] | None:
            found = moved_place(handle, viewer.camera, viewer.ray(x, y), place)
            if found is None:
                return None
            step = step_for(pixel_length(viewer.camera, place, viewer.size), 4.0) * (0.1 if fine else 1.0)
            by = found - start
            if light.with_camera:
                by = frame(viewer.camera) @ by
            pairs = zip(light.position, by.tolist(), strict=True)
            position = rounded([stepped(old + change, step) if abs(change) > 1e-9 else old for old, change in pairs], 6)
            return {"position": position}, f"{light.name}: at {_words(position)} mm"

        return Drag(f"Move {light.name}", "set_light", (light.name,), follow)

    def _middle(self, viewer: Viewer) -> NDArray[np.float64]:
        import numpy as np

        bounds = viewer.scene.visible_bounds()
        return np.zeros(3) if bounds is None else bounds.mean(axis=0)


def _words(values: tuple[float, ...]) -> str:
    return ", ".join(f"{value:.6g}" for value in values)
