"""One picture that is kept up to date: window, scene, ground, view cube and camera. Knows no Qt."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray
from vtkmodules.vtkRenderingCore import vtkRenderer

from . import camera as camera_value
from .camera import Camera, fit, ray, with_projection
from .curves.line_pick import LinePicker
from .ghosts.ghosts import Ghost, Ghosts
from .ghosts.needles import NormalNeedles
from .ground import Ground
from .handles.overlay import Overlay
from .look import Look, look_of
from .pick import Pick, Picker
from .picture import union
from .scene import Scene
from .view_cube import ViewCube
from .views import standard_view
from .window import close, is_software, native_window, offscreen_window, pixels, smooth

if TYPE_CHECKING:
    from ..model.document.document import Section
    from ..model.partition.tree import Tree
    from ..model.solid.display import DisplayMesh
    from ..model.surface.light import Light


class Viewer:
    """The viewport without its widget.

    All sizes and pixel coordinates are logical pixels, y downward, as Qt's events give them; `scale` says how many
    device pixels one of them has. No method but `render` draws; each one that changes the picture says so by setting
    `needs_render`. The order is: construct, `resize`, then `render` when the native window is there to be painted.
    `close` before the native window goes.
    """

    def __init__(self, window_id: int | None = None, theme: Look | str = "light") -> None:
        """Draw into the native window `window_id` (a QWidget's winId()), which stays its owner's; or off screen."""
        look = look_of(theme) if isinstance(theme, str) else theme
        self.window = offscreen_window((300, 200)) if window_id is None else native_window(window_id)
        self.renderer = vtkRenderer()
        self.window.AddRenderer(self.renderer)
        self.scene = Scene(self.renderer, look)
        self.ground = Ground(self.renderer, look)
        self.scene.painter.over_ground()
        self.ghosts = Ghosts(self.renderer, look)
        self.needles = NormalNeedles(self.renderer, look)
        self.overlay = Overlay(self.window, look)
        self.cube = ViewCube(self.window, look, layer=2)
        self.camera = standard_view(Camera(), "iso")
        self.size = (300.0, 200.0)
        self.scale = 1.0
        self.clipping: tuple[float, float] | None = None
        self.needs_render = True
        self.changed_camera: Callable[[Camera], None] | None = None
        self._picker = Picker()
        self._line_picker = LinePicker()
        self._software: bool | None = None
        self._moving = False
        self._peeling = False
        self._closed = False

    # The window

    def resize(self, width: float, height: float, scale: float = 1.0) -> None:
        """The viewport's size in logical pixels, and the device pixels per logical one (Qt: devicePixelRatioF)."""
        self.size, self.scale = (max(float(width), 1.0), max(float(height), 1.0)), scale
        self.window.SetSize(max(round(self.size[0] * scale), 1), max(round(self.size[1] * scale), 1))
        self.window.SetDPI(round(96 * scale))
        self.scene.set_line_scale(scale)
        self.ground.set_line_scale(scale)
        self.ghosts.set_line_scale(scale)
        self.needles.set_line_scale(scale)
        self.cube.resize(*self.size, scale)
        self.needs_render = True

    def render(self) -> None:
        """Draw the picture now and show it. Does nothing after `close`."""
        if self._closed:
            return
        self.ground.update(self.camera)
        self.scene.before_render(self.camera, self.ground.height)
        camera_value.apply(self.camera, self.renderer.GetActiveCamera(), self.drawn_bounds)
        if self.clipping is not None:
            shift = self.renderer.GetActiveCamera().GetDistance() - self.camera.distance
            self.renderer.GetActiveCamera().SetClippingRange(*(distance + shift for distance in self.clipping))
        self.overlay.before_render(self.camera, self.size, self.scale)
        self.cube.turn(self.camera)
        if self._software is None or self._peeling != self.scene.peeling:
            self._software = is_software(self.window)
            self._smooth()
        self.window.Render()
        self.needs_render = False

    @property
    def drawn_bounds(self) -> NDArray[np.float64] | None:
        """(2, 3) of all that near and far plane are put about, ground and ghosts included; None for nothing."""
        return union(union(self.scene.visible_bounds(), self.ground.bounds), self.ghosts.bounds)

    def pixels(self) -> NDArray[np.uint8]:
        """What was rendered last: (height, width, 3) bytes in device pixels, first row on top."""
        return np.ascontiguousarray(pixels(self.window)[..., :3])

    def close(self) -> None:
        """Free the graphics card. Call it while the native window still exists; afterwards nothing is drawn."""
        if not self._closed:
            self._closed = True
            self.scene.show({})
            self.scene.painter.clear()
            self.ghosts.show(())
            close(self.window)

    # What is shown

    def show(self, solids: Mapping[str, tuple["DisplayMesh", Any]]) -> None:
        """See `Scene.show`."""
        self.scene.show(solids)
        self.needs_render = True

    def show_ghosts(self, ghosts: Iterable[Ghost]) -> None:
        """See `Ghosts.show`."""
        self.ghosts.show(ghosts)
        self.needs_render = True

    def show_needles(self, lines: Mapping[str, NDArray[np.float64]]) -> None:
        """Normals (n, 2, 3) from foot to tip by kind, "face" or "vertex"."""
        self.needles.show(lines, self.scene.sections)
        self.needs_render = True

    def set_selection(self, paths: Iterable[tuple[str | int, ...]]) -> None:
        """See `Scene.set_selection`."""
        self.scene.set_selection(paths)
        self.needs_render = True

    def set_hover(self, path: tuple[str | int, ...] | None) -> bool:
        """See `Scene.set_hover`; whether it changes the picture, so that a mouse move need not redraw."""
        if path == self.scene.hover:
            return False
        self.scene.set_hover(path)
        self.needs_render = True
        return True

    def set_faded(self, solid_ids: Iterable[str]) -> None:
        """See `Scene.set_faded`."""
        self.scene.set_faded(solid_ids)
        self.needs_render = True

    def set_moves(self, moves: Mapping[str, NDArray[np.float64]]) -> None:
        """See `Scene.set_moves`."""
        self.scene.set_moves(moves)
        self.needs_render = True

    def set_touched(self, solid_ids: Iterable[str]) -> None:
        """See `Scene.set_touched`."""
        self.scene.set_touched(solid_ids)
        self.needs_render = True

    def set_sections(self, sections: "Iterable[Section]", dragged: bool = False) -> None:
        """See `Scene.set_sections`."""
        self.scene.set_sections(sections, dragged)
        self.needles.clip(self.scene.sections)
        self.needs_render = True

    def set_theme(self, theme: Look | str) -> None:
        """ "light", "dark" or a look; ValueError for another name."""
        look = look_of(theme) if isinstance(theme, str) else theme
        self.scene.set_look(look)
        self.ground.set_look(look)
        self.ghosts.set_look(look)
        self.needles.set_look(look)
        self.overlay.set_look(look)
        self.cube.set_look(look)
        self.needs_render = True

    def set_style(self, style: str) -> None:
        """One of look.STYLES; ValueError for another."""
        self.scene.set_style(style)
        self.needs_render = True

    def set_shading(self, shading: str) -> None:
        """One of material.SHADINGS; ValueError for another."""
        self.scene.set_shading(shading)
        self.needs_render = True

    def set_lights(self, lights: "Sequence[Light]") -> None:
        """See `Scene.set_lights`."""
        self.scene.set_lights(lights)
        self.needs_render = True

    def set_opacity(self, opacity: float) -> None:
        """Of all faces, 0 to 1; ValueError outside."""
        self.scene.set_opacity(opacity)
        self.needs_render = True

    def set_hidden_surface(self, mode: str) -> None:
        """One of look.HIDDEN_SURFACES; ValueError for another. See `show_tree`."""
        self.scene.set_hidden_surface(mode)
        self.needs_render = True

    def show_tree(self, tree: "Tree | None", solid_ids: Sequence[str] = ()) -> None:
        """See `Scene.show_tree`."""
        self.scene.show_tree(tree, solid_ids)
        self.needs_render = True

    @property
    def painting(self) -> bool:
        """See `Scene.painting`."""
        return self.scene.painting

    def set_painted(self, count: int | None) -> None:
        """Draw only the first `count` fragments of the painter's order, None for all."""
        self.scene.painter.count = count
        self.needs_render = True

    def set_culling(self, culling: bool) -> None:
        """See `Scene.set_culling`."""
        self.scene.set_culling(culling)
        self.needs_render = True

    def set_clipping(self, clipping: tuple[float, float] | None) -> None:
        """Show only what lies between two distances before the eye, in mm; None for all that is there. In perspective
        the first one is above 0; ValueError for distances in the wrong order."""
        if clipping is not None and not (clipping[0] < clipping[1] and (self.camera.parallel or clipping[0] > 0.0)):
            raise ValueError(f"near and far planes cannot stand at {clipping}")
        self.clipping = clipping
        self.needs_render = True

    def set_ground(self, visible: bool) -> None:
        self.ground.set_visible(visible)
        self.needs_render = True

    def set_cube(self, visible: bool) -> None:
        self.cube.set_visible(visible)
        self.needs_render = True

    # The camera

    def set_camera(self, camera: Camera) -> None:
        """Look through another camera. Views and moves are functions on the value: see `camera` and `views`."""
        if camera != self.camera:
            self.camera = camera
            self.needs_render = True
            if self.changed_camera is not None:
                self.changed_camera(camera)

    def set_projection(self, parallel: bool) -> None:
        """Parallel or perspective; what lies at the target's depth keeps its size."""
        self.set_camera(with_projection(self.camera, parallel))

    def fitted(self, camera: Camera | None = None) -> Camera:
        """The camera (by default the present one) moved so that all that is shown fits, for an animated move."""
        aspect = self.size[0] / self.size[1]
        return fit(self.camera if camera is None else camera, self.scene.visible_bounds(), aspect)

    def fit(self) -> None:
        """Show all solids; with none, the middle of the ground."""
        self.set_camera(self.fitted())

    # The pointer

    def ray(self, x: float, y: float) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """The ray under pixel (x, y), origin and unit direction; in parallel projection it starts before all solids."""
        origin, direction = ray(self.camera, x, y, self.size)
        bounds = self.scene.visible_bounds()
        if self.camera.parallel and bounds is not None:
            middle = bounds.mean(axis=0)
            back = float(np.linalg.norm(np.ptp(bounds, axis=0))) + abs(float((middle - origin) @ direction))
            origin = origin - back * direction
        return origin, direction

    def pick(self, x: float, y: float) -> Pick | None:
        """The triangle or cut face under pixel (x, y), None for the background. Does not look at the view cube."""
        origin, direction = self.ray(x, y)
        sections = self.scene.sections
        found = self._picker.pick(self.scene.meshes, origin, direction, *sections.span(origin, direction))
        cut = sections.pick(origin, direction)
        found = cut if found is None or (cut is not None and cut.distance < found.distance) else found
        return self._line(found, x, y, origin, direction) or found

    def _line(
        self, found: Pick | None, x: float, y: float, origin: NDArray[np.float64], direction: NDArray[np.float64]
    ) -> Pick | None:
        """The curve of an outline under pixel (x, y), unless a solid's face lies before it."""
        line = self._line_picker.pick(self.scene.meshes, self.camera, self.size, x, y)
        if line is None or found is None or self.scene.meshes[found.solid_id].sheet:
            return line
        depth = float((np.asarray(line.point) - origin) @ direction)
        room = 1e-3 * self.camera.half_height
        return line if depth <= found.distance + room else None

    def pick_all(self, x: float, y: float) -> list[Pick]:
        """All that lies under pixel (x, y), front to back, faces turned away from the eye included."""
        origin, direction = self.ray(x, y)
        sections = self.scene.sections
        found = self._picker.pick_all(self.scene.meshes, origin, direction, *sections.span(origin, direction))
        cut = sections.pick(origin, direction)
        return found if cut is None else [cut, *found]

    def cube_hit(self, x: float, y: float) -> str | None:
        """The view cube's region under pixel (x, y) as a name for `views.standard_view`; None beside the cube."""
        return self.cube.hit(x, y)

    def set_cube_hover(self, name: str | None) -> bool:
        """Highlight a region of the view cube; whether that changes the picture."""
        changed = self.cube.set_hover(name)
        self.needs_render = self.needs_render or changed
        return changed

    def set_moving(self, moving: bool) -> None:
        """While something is dragged, pictures drawn by the processor are not smoothed, which is half of their time."""
        if moving != self._moving:
            self._moving = moving
            self._smooth()
            self.needs_render = self.needs_render or not moving

    def _smooth(self) -> None:
        """Four samples a pixel on a graphics card, FXAA on the processor and where depths are peeled."""
        if self._software is not None:
            self._peeling = self.scene.peeling
            samples = 0 if self._software or self._peeling else 4
            renderers = [self.renderer, self.overlay.renderer, self.cube.renderer]
            smooth(self.window, renderers, samples, samples == 0 and not (self._moving and self._software))
