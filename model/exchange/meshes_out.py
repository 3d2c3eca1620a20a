"""Solids into mesh files: STL, 3MF, OBJ, PLY, OFF and GLB. Equal solids make equal bytes."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import BinaryIO

import numpy as np

from ..document.errors import Refusal
from ..project.disk import replace_file
from .gltf_out import write_glb
from .obj import write_obj
from .off import write_off
from .ply import write_ply
from .solids import OutSolid
from .stl import write_stl
from .threemf import write_3mf

__all__ = ["WRITERS", "OutSolid", "check_ending", "holds_materials", "write_meshes"]

WRITERS: dict[str, Callable[[BinaryIO, Sequence[OutSolid]], None]] = {
    "stl": write_stl,
    "3mf": write_3mf,
    "obj": write_obj,
    "ply": write_ply,
    "off": write_off,
    "glb": write_glb,
}
"""By ending."""


def check_ending(path: str | os.PathLike[str]) -> str:
    """The ending of the path, small and without its dot. Raises Refusal where it names no format that is written."""
    ending = Path(path).suffix.lower().removeprefix(".")
    if ending not in WRITERS:
        known = ", ".join(f".{name}" for name in WRITERS)
        raise Refusal(
            f"cannot be written: {f'.{ending}' if ending else 'no ending'} names no mesh format; known are {known}"
        )
    return ending


def holds_materials(path: str | os.PathLike[str]) -> bool:
    """Whether the format of the path's ending holds materials, bitmaps and texture coordinates."""
    return Path(path).suffix.lower() in (".glb", ".obj")


def write_meshes(path: str | os.PathLike[str], solids: Sequence[OutSolid]) -> None:
    """Writes the solids in the format that the path's ending names, wholly or not at all. Raises Refusal.

    3MF, OBJ and GLB keep the solids apart with their names and colours, PLY keeps colours; STL and OFF do not. GLB and
    OBJ keep materials with their bitmaps, OBJ in files beside it.
    """
    writer = WRITERS[check_ending(path)]
    full = [solid for solid in solids if len(solid.triangles)]
    if not full:
        raise Refusal("cannot be written: there is nothing in it, for no solid has a face")
    for solid in full:
        if not np.isfinite(solid.vertices).all():
            raise Refusal(f"cannot be written: “{solid.name}” has a coordinate that is no finite number")
        if solid.triangles.min() < 0 or solid.triangles.max() >= len(solid.vertices):
            raise Refusal(f"cannot be written: a triangle of “{solid.name}” asks for a vertex that is not there")
    if writer is write_obj and any(solid.dress for solid in full):
        from .obj_dressed import write_dressed_obj

        write_dressed_obj(path, full)
        return
    replace_file(path, lambda stream: writer(stream, full))
