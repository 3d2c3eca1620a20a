"""The corpus' scenes of hidden surfaces: polygons with ids, views, and who owns each pixel."""

import itertools
import json
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader

from solidtree.model.solid.display import DisplayMesh
from solidtree.render.camera import Camera


@dataclass(frozen=True)
class View:
    name: str
    size: tuple[int, int]
    camera: Camera
    owners: np.ndarray  # (height, width) ids, 0 for the background
    skipped: np.ndarray  # (height, width) where nothing is to be compared


@dataclass(frozen=True)
class Scene:
    mesh: DisplayMesh
    numbers: np.ndarray  # (t,) the id of each triangle's polygon
    views: list[View]


def read_scene(folder: Path, name: str) -> Scene:
    scenes = json.loads((folder / "scenes.json").read_text(encoding="utf-8"))["scenes"]
    points, triangles, numbers, number = [], [], [], 0
    for line in (folder / "scenes" / f"{name}.obj").read_text(encoding="utf-8").splitlines():
        kind, *words = line.split() or [""]
        if kind == "v":
            points.append([float(word) for word in words])
        elif kind in ("g", "o"):
            number = int(words[0].removeprefix("id"))
        elif kind == "f":
            corners = [int(word.split("/")[0]) - 1 for word in words]
            triangles += [[corners[0], *pair] for pair in itertools.pairwise(corners[1:])]
            numbers += [number] * (len(corners) - 2)
    views = []
    for view in scenes[name]["views"]:
        size, camera = camera_of_scene(view["camera"])
        own, skip = (read_png(folder / "scenes" / view[key]) for key in ("own", "skip"))
        views.append(View(view["own"], size, camera, own, skip != 0))
    return Scene(flat_mesh(np.array(points), np.array(triangles, np.int32)), np.array(numbers), views)


def names_of_scenes(folder: Path) -> list[str]:
    return sorted(json.loads((folder / "scenes.json").read_text(encoding="utf-8"))["scenes"])


def flat_mesh(points, triangles) -> DisplayMesh:
    """Triangles that each are a facet of their own, all of one owner."""
    count = len(triangles)
    single = np.asarray(points, np.float32)
    return DisplayMesh(
        single, np.tile(np.float32([0, 0, 1]), (len(points), 1)), triangles, np.zeros(count, np.int32), (("mesh",),),
        np.zeros(count, bool), np.arange(count, dtype=np.int32), single[:0], np.zeros((0, 2), np.int32),
        np.zeros((0, 2), np.int32), np.array([single.min(axis=0), single.max(axis=0)], float),
        np.asarray(points, float), triangles, np.zeros(1, bool),
    )  # fmt: skip


def camera_of_scene(values) -> tuple[tuple[int, int], Camera]:
    size = values["width"], values["height"]
    if values["kind"] == "orthographic":
        centre, direction = np.array(values["center"], float), np.array(values["direction"], float)
        eye = tuple(centre - 100.0 * direction)
        return size, Camera(eye, tuple(centre), tuple(values["up"]), 30.0, True, values["half_height"])
    eye = np.array(values["eye"], float)
    target = eye + np.array(values["direction"], float) if "direction" in values else values["target"]
    return size, Camera(tuple(eye), tuple(target), tuple(values["up"]), values["fovy_deg"])


def read_png(path: Path) -> np.ndarray:
    reader = vtkPNGReader()
    reader.SetFileName(str(path))
    reader.Update()
    image = reader.GetOutput()
    width, height, _ = image.GetDimensions()
    return np.flipud(vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width))
