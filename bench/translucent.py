"""Faces in the order of a BSP tree against the depth buffer and depth peeling: frame times, and errors of translucency.

Twenty crossing parts (37,000 triangles) and single ones orbit in a window of 900 by 700 pixels. Errors are taken
against an A-buffer: all faces on the ray of a pixel, sorted and blended in floating point, of a smaller picture.
"""

from __future__ import annotations

import time

import manifold3d
import numpy as np
from vtkmodules.vtkRenderingCore import vtkActor, vtkRenderer

FRAMES = 9
SIZE = (900, 700)
SMALL = (225, 175)
OPACITY = 0.5
PEELS = (24, 100)
BOX = np.array([[-45.0] * 3, [45.0] * 3])


def part(rng: np.random.Generator, segments: int):
    """A cube with a drilled hole and a ball on it, somewhere."""
    from solidtree.model.solid.display import display_mesh

    cube, ball = manifold3d.Manifold.cube([18.0] * 3, True), manifold3d.Manifold.sphere(7.0, segments)
    drill = manifold3d.Manifold.cylinder(40.0, 5.0, 5.0, segments, True)
    body = cube - drill + ball.translate([9.0, 0.0, 0.0])
    mesh = body.rotate(rng.uniform(0, 360, 3)).translate(rng.uniform(-22, 22, 3)).to_mesh64()
    runs = np.arange(len(mesh.run_original_id), dtype=np.int32)
    return display_mesh(mesh, runs, tuple((f"n{i}",) for i in runs))


def scenes() -> dict[str, list]:
    rng = np.random.default_rng(11)
    plate = manifold3d.Manifold.cube([80.0, 80.0, 8.0], True)
    holes = [manifold3d.Manifold.cylinder(20.0, 3.0, 3.0, 48, True).translate([x, y, 0.0])
             for x in np.arange(-35.0, 36.0, 10.0) for y in np.arange(-35.0, 36.0, 10.0)]  # fmt: skip
    from solidtree.model.solid.display import display_mesh

    drilled = manifold3d.Manifold.batch_boolean([plate, *holes], manifold3d.OpType.Subtract).to_mesh64()
    runs = np.arange(len(drilled.run_original_id), dtype=np.int32)
    return {
        "plate of 64 holes": [display_mesh(drilled, runs, tuple((f"n{i}",) for i in runs))],
        "3 crossing parts": [part(rng, 32) for _ in range(3)],
        "20 crossing parts": [part(rng, 63) for _ in range(20)],
    }


class Window:
    """An off-screen window with the faces of some meshes in one of the ways."""

    def __init__(self, meshes: list, size: tuple[int, int], opacity: float, peels: int | None, colours: list) -> None:
        from solidtree.model.partition.build import build
        from solidtree.model.partition.faces import faces_of_meshes
        from solidtree.render.actors import faces_actor
        from solidtree.render.painter.painter import Painter
        from solidtree.render.polydata import set_cell_colours, surface_of
        from solidtree.render.shading import unlit
        from solidtree.render.window import offscreen_window

        self.window = offscreen_window(size)
        self.renderer = vtkRenderer()
        self.window.AddRenderer(self.renderer)
        self.renderer.SetBackground(1.0, 1.0, 1.0)
        self.renderer.SetUseOIT(False)
        self.opacity = opacity
        self.painter = None
        actors: list[vtkActor] = []
        if peels is None:
            self.painter = Painter(self.renderer)
            self.painter.show(build(faces_of_meshes(meshes)), meshes)
            self.painter.colour(np.concatenate(colours))
            actors.append(self.painter.actor)
        else:
            self.renderer.SetUseDepthPeeling(opacity < 1.0)
            self.renderer.SetMaximumNumberOfPeels(peels)
            self.renderer.SetOcclusionRatio(0.0)
            for mesh, own in zip(meshes, colours, strict=True):
                surface = surface_of(mesh)
                set_cell_colours(surface, own)
                actors.append(faces_actor(surface))
                self.renderer.AddActor(actors[-1])
        for actor in actors:
            unlit(actor)
            actor.GetProperty().SetOpacity(opacity)

    def draw(self, camera) -> float:
        """Seconds until the picture is there, its order included."""
        from solidtree.render.camera import apply

        begin = time.perf_counter()
        if self.painter is not None:
            self.painter.turn(camera, self.opacity >= 1.0, cull=True)
        apply(camera, self.renderer.GetActiveCamera(), BOX)
        self.window.Render()
        self.window.WaitForCompletion()
        return time.perf_counter() - begin

    def pixels(self) -> np.ndarray:
        from solidtree.render.window import pixels

        return pixels(self.window)[..., :3].astype(float)

    def close(self) -> None:
        from solidtree.render.window import close

        close(self.window)


def layered(meshes: list, colours: list, opacity: float, camera) -> np.ndarray:
    """The A-buffer (height, width, 3) of a parallel camera."""
    from solidtree.render.camera import frame

    width, height = SMALL
    right, up, backward = frame(camera)
    pixel = 2.0 * camera.parallel_scale / height
    hits: list[tuple[np.ndarray, np.ndarray, np.ndarray]] = []
    for mesh, own in zip(meshes, colours, strict=True):
        seen = (mesh.vertices - camera.target) @ np.array([right, -up, backward]).T
        seen[:, :2] = seen[:, :2] / pixel + (0.5 * width - 0.5, 0.5 * height - 0.5)
        for corners, ink in zip(seen[mesh.corners], own, strict=True):
            a, u, v = corners[0], corners[1] - corners[0], corners[2] - corners[0]
            det = u[0] * v[1] - u[1] * v[0]
            low = np.maximum(np.ceil(corners[:, :2].min(axis=0)), 0).astype(int)
            high = np.minimum(np.floor(corners[:, :2].max(axis=0)), (width - 1, height - 1)).astype(int)
            if det == 0.0 or (high < low).any():
                continue
            x, y = (w.reshape(-1) for w in np.meshgrid(*(np.arange(low[i], high[i] + 1) for i in (0, 1))))
            s = ((x - a[0]) * v[1] - (y - a[1]) * v[0]) / det
            t = (u[0] * (y - a[1]) - u[1] * (x - a[0])) / det
            inside = (s >= 0.0) & (t >= 0.0) & (s + t <= 1.0)
            depth = (a[2] + s * u[2] + t * v[2])[inside]
            hits.append(((y * width + x)[inside], depth, np.broadcast_to(ink, (len(depth), 3))))
    place, depth, ink = (np.concatenate([hit[i] for hit in hits]) for i in range(3))
    order = np.lexsort((depth, place))
    place, ink = place[order], ink[order].astype(float)
    layer = np.arange(len(place)) - np.searchsorted(place, place)
    result = np.full((width * height, 3), 255.0)
    for number in range(int(layer.max(initial=-1)) + 1):
        now = layer == number
        result[place[now]] = opacity * ink[now] + (1.0 - opacity) * result[place[now]]
    return result.reshape(height, width, 3)


def main() -> None:
    from solidtree.render.camera import Camera, fit, orbit
    from solidtree.render.views import standard_view

    print(f"{'scene':20}{'triangles':>10}{'':16}{'ms':>8}{'times BSP':>11}{'mean error':>12}")
    for name, meshes in scenes().items():
        rng = np.random.default_rng(3)
        colours = [rng.integers(0, 256, (len(mesh.triangles), 3), np.uint8) for mesh in meshes]
        camera = fit(standard_view(Camera(), "iso"), BOX, SIZE[0] / SIZE[1])
        level = orbit(Camera((0.0, -200.0, 0.0), (0.0, 0.0, 0.0), parallel=True, parallel_scale=45.0), 31.0, 23.0)
        wanted = layered(meshes, colours, OPACITY, level)
        count = sum(len(mesh.triangles) for mesh in meshes)
        rows: list[tuple[str, float, int | None]] = [
            ("opaque, BSP", 1.0, None),
            ("opaque, z-buffer", 1.0, 0),
            ("BSP", OPACITY, None),
            *((f"{peels} peels", OPACITY, peels) for peels in PEELS),
        ]
        windows = [Window(meshes, SIZE, opacity, peels, colours) for _, opacity, peels in rows]
        frames = [[window.draw(orbit(camera, 9.0 * i, 3.0)) for window in windows] for i in range(FRAMES + 1)]
        seconds = np.median(frames[1:], axis=0)
        for (label, opacity, peels), window, time_ in zip(rows, windows, seconds, strict=True):
            window.close()
            error = ""
            if opacity < 1.0:
                small = Window(meshes, SMALL, opacity, peels, colours)
                small.draw(level)
                error = f"{np.abs(small.pixels() - wanted).mean():.3f}"
                small.close()
            ratio = time_ / seconds[0 if opacity >= 1.0 else 2]
            print(f"{name:20}{count:10,}  {label:16}{1e3 * time_:6.0f}{ratio:11.1f}{error:>12}")


if __name__ == "__main__":
    main()
