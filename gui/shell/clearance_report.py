"""The report of a check as a file, with pictures of the worst findings."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping, Sequence
from datetime import date
from typing import TYPE_CHECKING

import numpy as np
from manifold3d import Mesh64

from ...model.image.pictures import encoded
from ...model.project.disk import replace_file
from ...model.proximity.boxes import Floats
from ...model.proximity.findings import OVERLAP, Finding, Triangles
from ...model.proximity.report_page import ONE, OTHER, SHARED, Figure, page_of
from ...model.solid.display import DisplayMesh, display_mesh
from ...render.camera import Camera, fit, project
from ...render.look import Paint
from ...render.picture import picture
from ...render.views import standard_view, view_direction

if TYPE_CHECKING:
    from ...model.document.document import Document
    from ...model.proximity.findings import Report

PICTURED = 12
"""Findings with pictures: each takes a second or two where no graphics card helps, and 50 kB."""
SIZE = (600, 420)
"""Of a picture, in pixels; on the page it is half the width of an A4 sheet."""
VIEWS = ("front-right-top", "front-left-top")
"""Whichever looks more across the gap is taken."""
AROUND_OVERLAP, AROUND_GAP = 2.5, 6.0
"""The close picture shows so many times the place."""
LEAST = 0.02
"""And at least this part of the whole pair."""
OPACITY = 0.45


def write_report(
    path: str | os.PathLike[str],
    title: str,
    document: Document,
    report: Report,
    surfaces: Mapping[str, Triangles],
    tolerance: float,
    told: Callable[[int, int], None] | None = None,
) -> None:
    """Write the report of a document's check as HTML; `surfaces` are those of its solids by the ids of their roots,
    within `tolerance` mm. `told` hears of how many findings pictures are made. Raises Refusal."""
    figures = {}
    pictured = report.findings[:PICTURED]
    for number, finding in enumerate(pictured):
        if told is not None:
            told(number, len(pictured))
        figures[number] = figures_of(finding, [surfaces[node_id] for node_id in finding.ids])
    page = page_of(report, document, title, tolerance, date.today().isoformat(), figures)
    replace_file(path, lambda stream: stream.write(page.encode()))


def figures_of(finding: Finding, pair: Sequence[Triangles]) -> list[Figure]:
    """The pair as a whole, and the place close by where that shows more."""
    meshes = [_shown(surface) for surface in pair]
    bounds = np.array([mesh.bounds for mesh in meshes])
    whole = np.array([bounds[:, 0].min(axis=0), bounds[:, 1].max(axis=0)])
    middle, size = finding.bounds.mean(axis=0), float(np.ptp(whole, axis=0).max())
    around = AROUND_OVERLAP if finding.fault == OVERLAP else AROUND_GAP
    half = max(around * float(np.ptp(finding.bounds, axis=0).max()), LEAST * size) / 2.0
    place = np.array([middle - half, middle + half])
    view = _view_across(finding)
    found = [_figure(finding, meshes, _camera(view, whole), "The pair")]
    if half < 0.4 * size:
        found.append(_figure(finding, meshes, _camera(view, place), "The place"))
    return found


def _figure(finding: Finding, meshes: Sequence[DisplayMesh], camera: Camera, caption: str) -> Figure:
    pixels = picture(
        list(zip(meshes, (Paint(ONE), Paint(OTHER)), strict=True)), SIZE, camera, style="edges", opacity=OPACITY,
        background="#ffffff",
    )  # fmt: skip
    if finding.body is not None:
        body = _shown(finding.body)
        over = picture([(body, Paint(SHARED))], SIZE, camera, style="edges", background="transparent")
        share = over[..., 3:] / 255.0
        pixels = np.round(share * over[..., :3] + (1.0 - share) * pixels).astype(np.uint8)
    rgba = np.dstack((pixels, np.full(pixels.shape[:2], 255, np.uint8)))
    line = None if finding.points is None else project(camera, finding.points, SIZE)[:, :2]
    return Figure(encoded(rgba, "PNG"), SIZE, caption, line)


def _view_across(finding: Finding) -> str:
    """The view that looks most across the gap."""
    way = np.zeros(3) if finding.points is None else finding.points[1] - finding.points[0]
    if not way.any():
        return VIEWS[0]
    way = way / np.linalg.norm(way)
    directions = np.array([view_direction(view) for view in VIEWS])
    along = np.abs(directions @ way) / np.linalg.norm(directions, axis=1)
    return VIEWS[int(np.argmin(along.round(9)))]


def _camera(view: str, bounds: Floats) -> Camera:
    return fit(standard_view(Camera(parallel=True), view), bounds, SIZE[0] / SIZE[1], 1.25)


def _shown(surface: Triangles) -> DisplayMesh:
    triangles = np.array(surface.triangles, np.uint64, order="C")
    runs = np.array([0, 3 * len(triangles)], np.uint64)
    vertices = np.array(surface.vertices, np.float64, order="C")  # its own: manifold3d takes no read-only ones
    mesh = Mesh64(vertices, triangles, run_index=runs, run_original_id=np.zeros(1, np.uint32))
    return display_mesh(mesh, np.zeros(1, np.int32), ((),))
