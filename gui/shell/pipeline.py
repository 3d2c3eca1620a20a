"""`solidtree pipeline`: a point on its way to its pixel, and how many polygons and pixels there are at each stage."""

from __future__ import annotations

import argparse
import json

from ...model.document.errors import Refusal
from ...model.document.tree import chosen_solids
from ..command_line import NOT_IN_ORDER, TOLERANCE, Bar, positive
from .messages import told
from .parameters import add_options as add_parameter_options
from .parameters import read_with_values
from .render import add_view_options, camera_wanted, picture_size
from .section import vector


def add_options(command: argparse.ArgumentParser) -> None:
    """The options of `pipeline`."""
    command.add_argument("file", metavar="FILE", help="a project or anything that can be imported")
    command.add_argument("--point", type=vector, metavar="x,y,z", help="a point of the world that is followed")
    command.add_argument("--solid", metavar="NAME", help="this solid alone; default: all that are visible")
    command.add_argument("--size", type=picture_size, default=(1200, 800), metavar="WxH", help="default 1200x800")
    add_view_options(command)
    command.add_argument("--near", type=positive, metavar="MM", help="the near plane before the eye; default as shown")
    command.add_argument("--far", type=positive, metavar="MM", help="the far plane before the eye; default as shown")
    command.add_argument("--cull", action="store_true", help="leave out the faces that are turned away from the eye")
    command.add_argument("--tolerance", type=positive, default=TOLERANCE, metavar="MM", help="default 0.05")
    add_parameter_options(command)


def pipeline(options: argparse.Namespace) -> int:
    """Tell matrices, stages and counts; the status is 1 where there is nothing to be seen, or a solid failed."""
    from ...model.pipeline.counts import counted, joined
    from ...model.pipeline.way import follow, rows
    from ...model.solid.results import evaluate_document

    document = read_with_values(options)
    ids = [root.id for root in chosen_solids(document, options.solid)]
    bar = Bar(document)
    try:
        evaluation = evaluate_document(document, options.tolerance, ids, progress=bar)
    finally:
        bar.end()
    status = told(options.file, evaluation.messages, document)
    found = [evaluation.display(result) for result in evaluation.solids if result.root.id in ids]
    meshes = [mesh for mesh in found if mesh is not None]

    import numpy as np

    from ...render.camera import Camera
    from ...render.pipeline import clipping_about, matrices_of
    from ...render.views import camera_of

    boxes = [mesh.bounds for mesh in meshes if len(mesh.triangles)]
    bounds = np.array([np.min(boxes, axis=0)[0], np.max(boxes, axis=0)[1]]) if boxes else None
    camera, perspective = camera_wanted(options, meshes)
    if not isinstance(camera, Camera):
        camera = camera_of(bounds, options.size[0] / options.size[1], camera, perspective=perspective)
    near, far = clipping_about(camera, bounds)
    near, far = options.near or near, options.far or far
    if far <= near:
        raise Refusal(f"the far plane, at {far:g} mm, must lie behind the near one, at {near:g} mm")
    matrices = matrices_of(camera, options.size, (near, far))
    points, triangles = joined([(mesh.vertices, mesh.corners) for mesh in meshes])
    result = counted(points, triangles, matrices, options.size, options.cull)
    assert result is not None
    answer = {
        "eye": list(camera.position),
        "target": list(camera.target),
        "clipping": [near, far],
        "matrices": rows(matrices),
        "point": None if options.point is None else follow(matrices, options.point).json(),
        "counts": result.counts.json(),
    }
    print(json.dumps(answer, indent=2, ensure_ascii=False, allow_nan=False))
    return status if result.counts.pixels and len(meshes) == len(found) else NOT_IN_ORDER
