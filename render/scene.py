"""The shown solids as actors of one renderer, updated by identity: what is the same object is not uploaded again."""

from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray
from vtkmodules.vtkCommonDataModel import vtkPolyData

from ..model.surface.appearance import DEFAULT
from .actors import Path, SolidActors, dress_faces
from .look import LIGHT, STYLES, Look, check_hidden_surface, light_up, look_of, set_background
from .painter.painter import Painter
from .sections import Sections
from .surfaces.surfaces import Surfaces, check_shading

if TYPE_CHECKING:
    from vtkmodules.vtkRenderingCore import vtkRenderer

    from ..model.document.document import Section
    from ..model.partition.tree import Tree
    from ..model.solid.display import DisplayMesh
    from ..model.surface.appearance import Appearance
    from ..model.surface.light import Light
    from .camera import Camera


class Scene:
    """Solids by the id of their root. Nothing is drawn by any method here: render the window afterwards."""

    def __init__(self, renderer: "vtkRenderer", look: Look = LIGHT) -> None:
        self.renderer = renderer
        self.look = look
        self.style = "shaded"
        self.shading = "phong"
        self.opacity = 1.0
        self.culling = False
        self.line_scale = 1.0
        self.selection: frozenset[Path] = frozenset()
        self.hover: Path | None = None
        self.faded: frozenset[str] = frozenset()
        self.touched: frozenset[str] = frozenset()
        self.moves: dict[str, NDArray[np.float64]] = {}
        """Matrices (4, 4) of solids that are drawn elsewhere than they are, by id."""
        self.hidden_surface = "zbuffer"
        self.painter = Painter(renderer)
        self._tree: Tree | None = None
        self._tree_meshes: dict[str, DisplayMesh] = {}
        self._face_colours: tuple[NDArray[np.uint8], ...] = ()
        self._background: Any = None
        self._solids: dict[str, SolidActors] = {}
        self.sections = Sections(renderer)
        self.surfaces = Surfaces()
        self._worn_faces: tuple[object, ...] | None = None
        light_up(renderer)
        self._restyle()

    def show(self, solids: Mapping[str, tuple["DisplayMesh", Any]]) -> None:
        """Show exactly these solids: id -> (mesh, colours).

        `colours` is a `look.Paint`, or one colour per owner (None: the solid's) as a sequence, an array (o, 3) or a
        function of the owner's index, or None. A mesh that is the very object shown before is kept as it is; its
        colours are compared with `is`, Paint with `==`.
        """
        for solid_id in [key for key in self._solids if key not in solids]:
            self._remove(solid_id)
        fresh: list[SolidActors] = []
        for solid_id, (mesh, colours) in solids.items():
            entry = self._solids.get(solid_id)
            if entry is not None and entry.mesh is mesh:
                if entry.colours is not colours and not _same(entry.colours, colours):
                    entry.colours = colours
                    fresh.append(entry)
                continue
            if entry is not None:
                self._remove(solid_id)
            entry = SolidActors(mesh, colours)
            entry.faded = solid_id in self.faded
            entry.touched = solid_id in self.touched
            entry.set_move(self.moves.get(solid_id))
            self._solids[solid_id] = entry
            for actor in entry.actors:
                self.renderer.AddActor(actor)
            self.sections.clip(entry.actors)
            fresh.append(entry)
        everything = self._wear()
        for entry in self._solids.values() if everything else fresh:
            self._style(entry)
            self._paint(entry)
        if everything or any(entry.looks for entry in fresh):
            self._style_painter()
        self.sections.set_solids(
            {key: (entry.mesh, entry.colours) for key, entry in self._solids.items() if not entry.mesh.sheet}
        )

    def set_sections(self, sections: Iterable["Section"], dragged: bool = False) -> None:
        """Open the picture by those of the sections that are active; `dragged` while they are on their way."""
        if self.sections.set_planes(sections, dragged):
            self.sections.clip(self.painter.actors)
            for entry in self._solids.values():
                self.sections.clip(entry.actors)

    def set_hidden_surface(self, mode: str) -> None:
        """How faces hide each other, one of look.HIDDEN_SURFACES, else ValueError: by a depth buffer, or drawn in the
        order of the tree. See `show_tree`."""
        check_hidden_surface(mode)
        self.hidden_surface = mode

    def show_tree(self, tree: "Tree | None", solid_ids: Sequence[str] = ()) -> None:
        """Order faces by a tree over the triangles of the shown solids with these ids, one solid after the other.

        It holds as long as these very meshes are shown and no others; from then on, and with None, the depth buffer is
        used. So is it where the tree does not fit what is shown.
        """
        meshes = {key: self._solids[key].mesh for key in solid_ids if key in self._solids}
        count = sum(len(mesh.triangles) for mesh in meshes.values())
        fits = tree is not None and len(meshes) == len(solid_ids) and tree.faces.count == count
        self._tree, self._tree_meshes = (tree, meshes) if fits else (None, {})

    @property
    def painting(self) -> bool:
        """Whether faces are drawn in the order of a tree: the mode is bsp, and there is one of what is shown, none of
        it faded or moved."""
        if self.hidden_surface != "bsp" or self._tree is None or self.moves or self.faded & self._solids.keys():
            return False
        shown = {key: mesh for key, mesh in self.solid_meshes.items() if len(mesh.triangles)}
        ordered = {key: mesh for key, mesh in self._tree_meshes.items() if len(mesh.triangles)}
        return shown.keys() == ordered.keys() and all(shown[key] is ordered[key] for key in shown)

    @property
    def peeling(self) -> bool:
        """Whether translucent faces are depth-peeled."""
        return self.translucent and not self.painting

    @property
    def translucent(self) -> bool:
        """Whether light comes through any face."""
        looks = (look for entry in self._solids.values() for look in entry.looks)
        return self.opacity < 1.0 or self.surfaces.translucent(looks)

    def set_lights(self, lights: "Sequence[Light]") -> None:
        """Light the faces by these; see `lights_of`."""
        before = self.surfaces.casting
        self.surfaces.lights = tuple(lights)
        if self.surfaces.casting != before:
            self._restyle()

    @property
    def meshes(self) -> dict[str, "DisplayMesh"]:
        return {solid_id: entry.mesh for solid_id, entry in self._solids.items()}

    @property
    def solid_meshes(self) -> dict[str, "DisplayMesh"]:
        """Those of solids, without the sheets of outlines."""
        return {solid_id: entry.mesh for solid_id, entry in self._solids.items() if not entry.mesh.sheet}

    def surface(self, solid_id: str) -> vtkPolyData:
        """The triangles of a shown solid; raises KeyError. For reading: pickers share it."""
        return self._solids[solid_id].surface

    def set_selection(self, paths: Iterable[Path]) -> None:
        """Highlight every triangle whose owner's path begins with one of the paths, and outline it."""
        selection = frozenset(paths)
        if selection != self.selection:
            changed = {path[0] for path in selection ^ self.selection}
            self.selection = selection
            self._paint_some(changed)

    def set_hover(self, path: Path | None) -> None:
        """Tint what stands at or below the path; None ends it."""
        if path != self.hover:
            changed = {end[0] for end in (path, self.hover) if end}
            self.hover = path
            self._paint_some(changed)

    def set_faded(self, solid_ids: Iterable[str]) -> None:
        """Draw these solids as faint lines without faces, so that others stand out."""
        faded = frozenset(solid_ids)
        changed, self.faded = faded ^ self.faded, faded
        for solid_id in changed & self._solids.keys():
            entry = self._solids[solid_id]
            entry.faded = solid_id in faded
            self._style(entry)

    def set_moves(self, moves: Mapping[str, NDArray[np.float64]]) -> None:
        """Draw these solids, and no others, moved by matrices (4, 4); those that are not shown count when they are."""
        before, self.moves = self.moves, dict(moves)
        for solid_id in (before.keys() | self.moves.keys()) & self._solids.keys():
            self._solids[solid_id].set_move(self.moves.get(solid_id))

    def set_touched(self, solid_ids: Iterable[str]) -> None:
        """Colour these solids as such that touch others."""
        touched = frozenset(solid_ids)
        changed, self.touched = touched ^ self.touched, touched
        for solid_id in changed & self._solids.keys():
            self._solids[solid_id].touched = solid_id in touched
        self._paint_some(changed)

    def set_style(self, style: str) -> None:
        """One of look.STYLES, else ValueError."""
        if style not in STYLES:
            raise ValueError(f"no style is called {style!r}: take one of {', '.join(STYLES)}")
        if style != self.style:
            self.style = style
            self._restyle()

    def set_shading(self, shading: str) -> None:
        """One of material.SHADINGS, else ValueError."""
        check_shading(shading)
        if shading != self.shading:
            self.shading = shading
            self._restyle()

    def set_look(self, look: Look | str) -> None:
        """A look, or a theme's name (ValueError for an unknown one)."""
        self.look = look_of(look) if isinstance(look, str) else look
        self._restyle()

    def set_opacity(self, opacity: float) -> None:
        """Of all faces, 0 to 1; below 1 they are depth-peeled or blended in the tree's order. Raises ValueError
        outside."""
        if not 0.0 <= opacity <= 1.0:
            raise ValueError(f"an opacity lies between 0 and 1, not at {opacity}")
        if opacity != self.opacity:
            self.opacity = opacity
            self._restyle()

    def set_culling(self, culling: bool) -> None:
        """Leave out the faces of solids that are turned away from the eye, whether or not something hides them."""
        if culling != self.culling:
            self.culling = culling
            self._restyle()

    def set_line_scale(self, scale: float) -> None:
        """Device pixels per logical pixel; lines are as many times wider."""
        if scale != self.line_scale:
            self.line_scale = scale
            self._restyle()

    def set_background(self, colour: Any) -> None:
        """A colour (see look.rgb) instead of the look's gradient, None for the look's again."""
        self._background = colour
        self._restyle()

    def visible_bounds(self) -> NDArray[np.float64] | None:
        """The box (2, 3) around all shown solids, without ground and highlights; None where there is nothing."""
        boxes = [self._box(key, entry.mesh) for key, entry in self._solids.items() if len(entry.mesh.triangles)]
        if not boxes:
            return None
        lower, upper = np.min(boxes, axis=0)[0], np.max(boxes, axis=0)[1]
        return np.array([lower, upper], float)

    def _box(self, solid_id: str, mesh: "DisplayMesh") -> NDArray[np.float64]:
        """(2, 3) around a solid, where it is drawn."""
        box = np.reshape(mesh.bounds, (2, 3))
        move = self.moves.get(solid_id)
        if move is None:
            return box
        corners = box[np.indices((2, 2, 2)).reshape(3, 8).T, np.arange(3)] @ move[:3, :3].T + move[:3, 3]
        return np.array([corners.min(axis=0), corners.max(axis=0)])

    @property
    def _solid_bounds(self) -> NDArray[np.float64] | None:
        boxes = [np.reshape(mesh.bounds, (2, 3)) for mesh in self.solid_meshes.values() if len(mesh.triangles)]
        return np.array([np.min(boxes, axis=(0, 1)), np.max(boxes, axis=(0, 1))], float) if boxes else None

    def before_render(self, camera: "Camera", ground: float | None = None) -> None:
        """Bring up to date what depends on the camera: the order of faces, silhouettes in the styles that draw them.

        `ground` is the height of the ground's lines, which translucent faces are blended below and above.
        """
        self._order_faces(camera, ground)
        faces = [entry.faces for entry in self._solids.values() if not entry.mesh.sheet]
        self.surfaces.shadows.update(self.surfaces.lights, faces, self._solid_bounds, camera)
        self.surfaces.turn((*self.painter.actors, *faces), camera)
        window = self.renderer.GetRenderWindow()
        height = 1 if window is None else max(window.GetSize()[1], 1)
        pixel = 2.0 * camera.half_height / height * self.line_scale
        for entry in self._solids.values():
            if entry.faded or self.style in ("wireframe", "hidden-line"):
                entry.turn_silhouette(camera, pixel)
        if window is not None:
            self.sections.before_render(
                self.style, self.look, self._ground, self.selection, self.hover, self._line_width, pixel
            )

    def _order_faces(self, camera: "Camera", ground: float | None) -> None:
        """Draw faces by the painter or by their own actors."""
        painting = self.painting
        by_painter = painting and self.style != "wireframe"
        for entry in self._solids.values():
            entry.faces.SetVisibility((not by_painter or entry.mesh.sheet) and not entry.faded)
        self.renderer.SetUseDepthPeeling(self.peeling)
        if not by_painter:
            self.painter.hide()
            if not self._solids:
                self.painter.clear()
            return
        tree, meshes = self._tree, tuple(self._tree_meshes.values())
        assert tree is not None
        if self.painter.tree is not tree or self.painter.meshes != meshes:
            self.painter.show(tree, meshes)
            self._face_colours = ()
            self._worn_faces = None
        colours = tuple(self._solids[key].face_colours for key in self._tree_meshes)
        if len(colours) != len(self._face_colours) or any(
            a is not b for a, b in zip(colours, self._face_colours, strict=True)
        ):
            self._face_colours = colours
            by_face = [
                palette[m.owner, m.subtracted.astype(np.intp)] for palette, m in zip(colours, meshes, strict=True)
            ]
            self.painter.colour(np.concatenate([*by_face, np.zeros((0, 3), np.uint8)]))
        self._dress_painter(self._solids[key] for key in self._tree_meshes)
        lit = self.style in ("shaded", "edges")
        self.painter.light_at_corners(lit and self._lights_corners)
        opaque = not lit or not self.translucent
        self.painter.turn(camera, opaque, not self.sections.planes, ground)

    def _remove(self, solid_id: str) -> None:
        for actor in self._solids.pop(solid_id).actors:
            self.renderer.RemoveActor(actor)

    def _restyle(self) -> None:
        plain = self.style == "hidden-line"
        set_background(self.renderer, self.look, plain, self._background)
        self.renderer.SetUseOIT(False)
        self.renderer.SetMaximumNumberOfPeels(24)
        self.renderer.SetOcclusionRatio(0.0)
        self._wear()
        self._style_painter()
        for entry in self._solids.values():
            self._style(entry)
            self._paint(entry)

    @property
    def _looks(self) -> "list[Appearance]":
        """Of all owners; none where nobody wears a material."""
        looks = [look for entry in self._solids.values() for look in entry.looks]
        return [DEFAULT, *looks] if looks else []

    @property
    def _lights_corners(self) -> bool:
        shadings = {look.material.shading for look in self._looks if look.material is not None}
        return any(shading.startswith("gouraud") for shading in (self.shading, *shadings))

    def _wear(self) -> bool:
        """Bring the table of materials up to date; whether all shaders have to be."""
        changed = self.surfaces.wear(self._looks, self.shading, self.look)
        for entry in self._solids.values():
            if entry.looks:
                entry.wear(self.surfaces.numbers(entry.looks), self.surfaces.frames)
        return changed

    def _dress_painter(self, entries: Iterable[SolidActors]) -> None:
        """Hand the painter what its faces wear, where that has changed."""
        if not self._looks:
            self.painter.wear(None)
            return
        entries = list(entries)
        worn = tuple((entry.looks, entry.mesh) for entry in entries), self._looks
        if worn == self._worn_faces:
            return
        self._worn_faces = worn
        of_face = []
        for entry in entries:
            numbers = self.surfaces.numbers(entry.looks or [DEFAULT] * max(len(entry.mesh.owners), 1))
            of_face.append(numbers[entry.mesh.owner])
        self.painter.wear(np.concatenate([*of_face, np.zeros(0, np.float32)]), self.surfaces.frames)

    def _style_painter(self) -> None:
        dressed = bool(self._looks)
        for actor in self.painter.actors:
            dress_faces(actor, self.style, self.shading, self.look, self.opacity, self.surfaces, dressed, pieces=True)
            actor.SetForceTranslucent(dressed and self.translucent)
            actor.GetProperty().SetBackfaceCulling(self.culling)

    @property
    def _ground(self) -> Any:
        return self.look.plain_background if self._background is None else self._background

    @property
    def _line_width(self) -> float:
        return 1.25 * self.line_scale

    def _style(self, entry: SolidActors) -> None:
        entry.set_style(self.style, self.shading, self.look, self.opacity, self._line_width, self.surfaces)
        entry.faces.GetProperty().SetBackfaceCulling(self.culling and not entry.mesh.sheet)

    def _paint(self, entry: SolidActors) -> None:
        entry.paint(self.style, self.look, self.selection, self.hover, self._ground)

    def _paint_some(self, solid_ids: Iterable[str | int]) -> None:
        for solid_id in solid_ids:
            entry = self._solids.get(str(solid_id))
            if entry is not None:
                self._paint(entry)


def _same(a: Any, b: Any) -> bool:
    if isinstance(a, np.ndarray) or isinstance(b, np.ndarray):
        return isinstance(a, np.ndarray) and isinstance(b, np.ndarray) and np.array_equal(a, b)
    return bool(a == b)
