"""OBJ written with its material file and bitmaps beside it."""

from __future__ import annotations

import os
import re
from collections.abc import Sequence
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np
from numpy.typing import NDArray

from ..document.colours import rgb
from ..project.disk import replace_file
from .dress import Coat, height_map, is_translucent, texture_file
from .solids import OutSolid, lines, plain_name


def write_dressed_obj(path: str | os.PathLike[str], solids: Sequence[OutSolid]) -> None:
    """NAME.obj, NAME.mtl, and the bitmaps as NAME_MATERIAL.png: `map_Kd` of textures, `map_Bump` of heights.

    Each solid is an object, in millimetres and with z up. Files of these names are replaced. Raises Refusal.
    """
    path = Path(path)
    names: dict[Coat | str, str] = {}
    files: dict[str, bytes] = {}
    rows: list[str] = []
    for solid in solids:
        for coat in solid.dress.coats if solid.dress is not None else ():
            if coat not in names:
                names[coat] = _free(coat.material.name, names.values())
                rows += _material(coat, names[coat], path.stem, files)
        if solid.colour and solid.colour not in names:
            names[solid.colour] = _free(solid.colour.removeprefix("#"), names.values())
            rows += [f"newmtl {names[solid.colour]}", f"Kd {_numbers(solid.colour)}", "illum 1", ""]
    for name, data in files.items():
        replace_file(path.with_name(name), lambda stream, data=data: stream.write(data))
    text = "# written by Solidtree\n" + "\n".join(rows)
    replace_file(path.with_suffix(".mtl"), lambda stream: stream.write(text.encode()))
    replace_file(path, lambda stream: _write(stream, path.with_suffix(".mtl").name, solids, names))


def _write(stream: BinaryIO, library: str, solids: Sequence[OutSolid], names: dict[Coat | str, str]) -> None:
    stream.write(f"# written by Solidtree, millimetres\nmtllib {library}\n".encode())
    before = flat = 1
    for number, solid in enumerate(solids, 1):
        stream.write(f"o {plain_name(solid.name) or f'solid {number}'}\n".encode())
        stream.writelines(lines("v %r %r %r\n", solid.vertices + 0.0))
        triangles = solid.triangles.astype(np.int64) + before
        before += len(solid.vertices)
        dress = solid.dress
        bare = f"usemtl {names[solid.colour]}\n".encode() if solid.colour else b""
        if dress is None:
            stream.write(bare)
            stream.writelines(lines("f %d %d %d\n", triangles))
            continue
        for coat in np.unique(dress.coat).tolist():
            mine = np.flatnonzero(dress.coat == coat)
            if coat < 0:
                stream.write(bare)
                stream.writelines(lines("f %d %d %d\n", triangles[mine]))
                continue
            places, which = np.unique(dress.coordinates[mine].reshape(-1, 2), axis=0, return_inverse=True)
            stream.writelines(lines("vt %.9g %.9g\n", places + 0.0))
            stream.write(f"usemtl {names[dress.coats[coat]]}\n".encode())
            corners = np.stack((triangles[mine], which.reshape(-1, 3) + flat), axis=2).reshape(-1, 6)
            stream.writelines(lines("f %d/%d %d/%d %d/%d\n", corners))
            flat += len(places)


def _material(coat: Coat, name: str, stem: str, files: dict[str, bytes]) -> list[str]:
    """Lines of the material file; the bitmaps that they name are put into `files`."""
    material = coat.material
    colour = np.array(rgb(coat.colour or "#ffffff")) / 255.0
    rows = [
        f"newmtl {name}",
        f"Ka {_three(material.ambient * colour)}",
        f"Kd {_three(material.diffuse * colour)}",
        f"Ks {_three(np.full(3, material.specular))}",
        f"Ns {material.shininess:g}",
        f"d {material.opacity:g}",
        f"illum {2 if material.specular else 1}",
    ]
    clamp = "-clamp on " if material.wrap == "clamp" else ""
    if material.texture:
        data, kind = texture_file(coat)
        file = f"{_safe(stem)}_{name}.{'jpg' if kind == 'jpeg' else kind}"
        files[file] = data
        rows.append(f"map_Kd {clamp}{file}")
        if is_translucent(coat) and kind == "png":
            rows.append(f"map_d {clamp}{file}")
    if material.bump:
        file = f"{_safe(stem)}_{name}_bump.png"
        files[file] = height_map(material)
        rows.append(f"map_Bump {clamp}-bm {material.bump_height:g} {file}")
    return [*rows, ""]


def _free(wanted: str, taken: Any) -> str:
    name = stem = _safe(wanted)
    number = 2
    while name in taken:
        name, number = f"{stem}_{number}", number + 1
    return name


def _safe(name: str) -> str:
    """A name without what a material file, or a file system, could not hold: OBJ has no quotation marks."""
    return re.sub(r"[^\w.-]+", "_", name).strip("._") or "material"


def _numbers(colour: str) -> str:
    return _three(np.array(rgb(colour)) / 255.0)


def _three(values: NDArray[np.float64]) -> str:
    return " ".join(f"{value:.4f}" for value in values)
