"""OBJ written with its material file and bitmaps beside it."""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import BinaryIO

import numpy as np
from numpy.typing import NDArray

from ..document.colours import rgb
from ..project.disk import replace_file
from .dress import Coat, height_map, is_translucent, normal_map, pieces_of, texture_file
from .solids import OutSolid, lines, plain_name

BARE = "bare"
"""The material of what has neither a material nor a colour: OBJ goes on with the last one otherwise."""
LONGEST = 60  # characters of a name that become part of a file's


def write_dressed_obj(path: str | os.PathLike[str], solids: Sequence[OutSolid]) -> None:
    """NAME.obj, NAME.mtl, and the bitmaps as NAME_MATERIAL.png: `map_Kd` of textures, `map_Bump` of heights, `norm` of
    normal maps.

    Each solid is an object, in millimetres and with z up. Files of these names are replaced. Raises Refusal.
    """
    path = Path(path)
    names: dict[Coat | str, str] = {BARE: BARE}
    files = Files(path.stem)
    rows = [f"newmtl {BARE}", "Kd 0.8 0.8 0.8", "illum 1", ""]
    for solid in solids:
        for coat in solid.dress.coats if solid.dress is not None else ():
            if coat not in names:
                names[coat] = _free(_safe(coat.material.name), names.values())
                rows += _material(coat, names[coat], files)
        if solid.colour and solid.colour not in names:
            names[solid.colour] = _free(_safe(solid.colour), names.values())
            rows += [f"newmtl {names[solid.colour]}", f"Kd {_numbers(solid.colour)}", "illum 1", ""]
    for name, data in files.data.items():
        replace_file(path.with_name(name), lambda stream, data=data: stream.write(data))
    text = "# written by Solidtree\n" + "\n".join(rows)
    replace_file(path.with_suffix(".mtl"), lambda stream: stream.write(text.encode()))
    replace_file(path, lambda stream: _write(stream, path.with_suffix(".mtl").name, solids, names))


class Files:
    """The bitmaps that go beside a file of this stem, by their names, which differ in more than capitals."""

    def __init__(self, stem: str) -> None:
        self._stem = _safe(stem)
        self.data: dict[str, bytes] = {}

    def add(self, name: str, ending: str, data: bytes) -> str:
        """The name that these bytes are given."""
        stem = _free(f"{self._stem}_{name}", (known.rpartition(".")[0] for known in self.data))
        self.data[f"{stem}.{ending}"] = data
        return f"{stem}.{ending}"


def _write(stream: BinaryIO, library: str, solids: Sequence[OutSolid], names: dict[Coat | str, str]) -> None:
    stream.write(f"# written by Solidtree, millimetres\nmtllib {library}\n".encode())
    before = flat = 1
    for number, solid in enumerate(solids, 1):
        stream.write(f"o {plain_name(solid.name) or f'solid {number}'}\n".encode())
        stream.writelines(lines("v %r %r %r\n", solid.vertices + 0.0))
        bare = f"usemtl {names[solid.colour or BARE]}\n".encode()
        if solid.dress is None:
            stream.write(bare)
            stream.writelines(lines("f %d %d %d\n", solid.triangles.astype(np.int64) + before))
        else:
            for piece in pieces_of(solid.vertices, solid.triangles, solid.dress):
                vertex = piece.vertex[piece.triangles] + before
                if piece.coat is None:
                    stream.write(bare)
                    stream.writelines(lines("f %d %d %d\n", vertex))
                    continue
                stream.writelines(lines("vt %.9g %.9g\n", piece.coordinates + 0.0))
                stream.write(f"usemtl {names[piece.coat]}\n".encode())
                corners = np.stack((vertex, piece.triangles + flat), axis=2).reshape(-1, 6)
                stream.writelines(lines("f %d/%d %d/%d %d/%d\n", corners))
                flat += len(piece.coordinates)
        before += len(solid.vertices)


def _material(coat: Coat, name: str, files: Files) -> list[str]:
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
        file = files.add(name, "jpg" if kind == "jpeg" else kind, data)
        rows.append(f"map_Kd {clamp}{file}")
        if is_translucent(coat) and kind == "png":
            rows.append(f"map_d {clamp}{file}")
    if material.bump and material.bump_kind == "normals":
        rows.append(f"norm {clamp}{files.add(f'{name}_normals', 'png', normal_map(material, (1.0, 1.0)))}")
    elif material.bump:
        file = files.add(f"{name}_bump", "png", height_map(material))
        rows.append(f"map_Bump {clamp}-bm {material.bump_height:g} {file}")
    return [*rows, ""]


def _free(wanted: str, taken: Iterable[str]) -> str:
    """The name, or with a number where one that differs in capitals at most is taken."""
    known = {name.casefold() for name in taken}
    name, number = wanted, 2
    while name.casefold() in known:
        name, number = f"{wanted}_{number}", number + 1
    return name


def _safe(name: str) -> str:
    """A name without what a material file, or a file system, could not hold: OBJ has no quotation marks."""
    return re.sub(r"[^\w.-]+", "_", name)[:LONGEST].strip("._") or "material"


def _numbers(colour: str) -> str:
    return _three(np.array(rgb(colour)) / 255.0)


def _three(values: NDArray[np.float64]) -> str:
    return " ".join(f"{value:.4f}" for value in values)
