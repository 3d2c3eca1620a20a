"""3MF: the printing format; a zip that holds an XML model with units, names, colours and places.

Read after the 3MF Core Specification 1.3 and its materials and production extensions. What the specification says
must fail is refused, except for attributes of foreign namespaces and unknown names of metadata, which slicers write.
"""

from __future__ import annotations

import io
import zipfile
from collections.abc import Sequence
from dataclasses import dataclass
from typing import BinaryIO
from xml.sax.saxutils import quoteattr

import numpy as np
from numpy.typing import NDArray

from ..document.errors import Refusal
from ..document.placement import product
from ..project.archive import allowance, member, members_of, open_archive, unpacked
from .parts import MAX_PARTS, Part, check_parts, check_total, make_part, placed
from .solids import OutSolid, lines, plain_name
from .threemf_model import Model, XmlReader

UNITS = {"micron": 0.001, "millimeter": 1.0, "centimeter": 10.0, "inch": 25.4, "foot": 304.8, "meter": 1000.0}
MAX_UNPACKED = 2_000_000_000
MAX_DEPTH = 50
_CORE = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02"
_MODEL_TYPE = "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"
_TEXT = "application/vnd.ms-package.3dmanufacturing-3dmodel+xml"


def read_3mf(data: bytes) -> list[Part]:
    """A part for each item of the build, its components in one. Raises Refusal."""
    stream = io.BytesIO(data)
    try:
        archive = open_archive(stream)
    except Refusal as refusal:
        raise Refusal(f"is no 3MF file: {refusal}") from None
    with archive:
        return _Package(archive, min(MAX_UNPACKED, allowance(stream))).parts()


@dataclass(frozen=True)
class _Relation:
    kind: str
    target: str
    outside: bool


class _Relations(XmlReader):
    def __init__(self, name: str) -> None:
        super().__init__(name)
        self.relations: list[_Relation] = []

    def start(self, tag: str, attributes: dict[str, str]) -> None:
        if tag.endswith(" Relationship"):
            target = attributes.get("Target", "")
            outside = attributes.get("TargetMode") == "External" or ":" in target
            self.relations.append(_Relation(attributes.get("Type", ""), target.lstrip("/"), outside))


class _Package:
    def __init__(self, archive: zipfile.ZipFile, most: int) -> None:
        self.archive, self.left = archive, most
        # Names of parts are compared without regard to case (Open Packaging Conventions).
        self.members = {name.lower(): info for name, info in members_of(archive).items()}
        self.models: dict[str, Model] = {}

    def parts(self) -> list[Part]:
        starts = [relation for relation in self._relations("_rels/.rels") if relation.kind == _MODEL_TYPE]
        if len(starts) != 1:
            raise Refusal(f"_rels/.rels names {len(starts) or 'no'} 3D model{'s' if starts else ''}; there must be one")
        main = starts[0].target
        folder, _, name = main.rpartition("/")
        for relation in self._relations(f"{folder}/_rels/{name}.rels"):
            if relation.outside:
                raise Refusal(f"{folder}/_rels/{name}.rels leads out of the file, to {relation.target[:80]!r}")
        model = self._model(main)
        if model.items is None:
            raise Refusal(f"{main} has no <build>, so it says nothing of what is to be made")
        if not model.resources:
            raise Refusal(f"{main} has no <resources>")
        check_parts(len(model.items))
        parts, total = [], 0
        for item in model.items:
            leaves = self._leaves(item.path or main, item.object, item.matrix, item.line)
            total += sum(len(mesh.triangles) for mesh, _ in leaves)
            check_total(total)
            owner = self._model(item.path or main).objects[item.object]
            part = _joined(owner.name or item.number, leaves, UNITS[model.unit])
            if part is not None:
                parts.append(part)
        return parts

    def _relations(self, name: str) -> list[_Relation]:
        found = _Relations(name)
        if name.lower() in self.members:
            found.read(self._unpacked(name))
        return found.relations

    def _unpacked(self, name: str):
        info = self.members.get(name.lower())
        if info is None:
            raise Refusal(f"{name[:80]} is missing from the file")
        for chunk in unpacked(self.archive, info, self.left):
            self.left -= len(chunk)
            yield chunk

    def _model(self, name: str) -> Model:
        name = name.lstrip("/")
        if name not in self.models:
            self.models[name] = model = Model(name).read(self._unpacked(name))
            if model.unit not in UNITS:
                raise Refusal(f"{name}: {model.unit[:40]!r} is no unit; known are {', '.join(UNITS)}")
        return self.models[name]

    def _leaves(self, path: str, number: int, matrix: NDArray[np.float64], line: int):
        """The meshes below an object, each with where it stands."""
        leaves = []
        stack = [(path, number, matrix, line, 0)]
        visits = 0
        while stack:
            path, number, matrix, line, depth = stack.pop()
            model = self._model(path)
            thing = model.objects.get(number)
            visits += 1
            if thing is None:
                raise Refusal(f"{path}, line {line}: there is no object {number}")
            if depth > MAX_DEPTH or visits > 10 * MAX_PARTS:
                raise Refusal(f"{path}, line {thing.line}: object {number} holds itself, or far too many components")
            if len(thing.triangles):
                leaves.append((thing, matrix))
            stack += [
                (below.path or path, below.object, product(matrix, below.matrix), below.line, depth + 1)
                for below in reversed(thing.components)
            ]
            check_total(sum(len(mesh.triangles) for mesh, _ in leaves) if visits % 1000 == 0 else 0)
        return leaves


def _joined(name: str, leaves: list, unit: float) -> Part | None:
    vertices, triangles, count = [], [], 0
    for mesh, matrix in leaves:
        mirrored = np.linalg.det(matrix[:, :3]) < 0
        if mesh.triangles.min() < 0 or mesh.triangles.max() >= len(mesh.vertices):
            make_part(mesh.name, None, mesh.vertices, mesh.triangles)  # says which one
        vertices.append(placed(mesh.vertices, matrix))
        triangles.append((mesh.triangles[:, ::-1] if mirrored else mesh.triangles) + count)
        count += len(mesh.vertices)
    if not vertices:
        return None
    colours = {mesh.colour for mesh, _ in leaves}
    note = next((mesh.note for mesh, _ in leaves if mesh.note), "")
    return make_part(
        name,
        colours.pop() if len(colours) == 1 else None,
        np.concatenate(vertices),
        np.concatenate(triangles),
        unit=unit,
        note=note,
    )


def write_3mf(stream: BinaryIO, solids: Sequence[OutSolid]) -> None:
    """Each solid as an object and an item of the build, with its name and colour, in millimetres."""
    colours = list(dict.fromkeys(solid.colour for solid in solids if solid.colour))
    large = sum(len(solid.triangles) for solid in solids) > 10_000_000
    with zipfile.ZipFile(stream, "w") as archive:
        archive.writestr(
            member("[Content_Types].xml", zipfile.ZIP_DEFLATED),
            '<?xml version="1.0" encoding="UTF-8"?>\n'
            '<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types">\n'
            '<Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/>\n'
            f'<Default Extension="model" ContentType="{_TEXT}"/>\n</Types>\n',
        )
        archive.writestr(
            member("_rels/.rels", zipfile.ZIP_DEFLATED),
            '<?xml version="1.0" encoding="UTF-8"?>\n'
            '<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">\n'
            f'<Relationship Id="rel0" Target="/3D/3dmodel.model" Type="{_MODEL_TYPE}"/>\n</Relationships>\n',
        )
        with archive.open(member("3D/3dmodel.model", zipfile.ZIP_DEFLATED), "w", force_zip64=large) as model:
            model.write(
                f'<?xml version="1.0" encoding="UTF-8"?>\n<model unit="millimeter" xml:lang="en-US" xmlns="{_CORE}">\n'
                '<metadata name="Application">Solidtree</metadata>\n<resources>\n'.encode()
            )
            if colours:
                bases = "".join(f'<base name={quoteattr(c)} displaycolor="{c.upper()}"/>\n' for c in colours)
                model.write(f'<basematerials id="{len(solids) + 1}">\n{bases}</basematerials>\n'.encode())
            for number, solid in enumerate(solids, 1):
                name = f" name={quoteattr(plain_name(solid.name))}" if plain_name(solid.name) else ""
                paint = f' pid="{len(solids) + 1}" pindex="{colours.index(solid.colour)}"' if solid.colour else ""
                model.write(f'<object id="{number}" type="model"{name}{paint}>\n<mesh>\n<vertices>\n'.encode())
                for piece in lines('<vertex x="%r" y="%r" z="%r"/>\n', solid.vertices + 0.0):
                    model.write(piece)
                model.write(b"</vertices>\n<triangles>\n")
                for piece in lines('<triangle v1="%d" v2="%d" v3="%d"/>\n', solid.triangles):
                    model.write(piece)
                model.write(b"</triangles>\n</mesh>\n</object>\n")
            items = "".join(f'<item objectid="{number}"/>\n' for number in range(1, len(solids) + 1))
            model.write(f"</resources>\n<build>\n{items}</build>\n</model>\n".encode())
