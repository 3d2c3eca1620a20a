"""A document with a little of everything, and project files made by hand."""

import io
import json
import zipfile

from solidtree.model.document.document import Document, Parameter
from solidtree.model.document.expression import Expression
from solidtree.model.document.nodes import Difference, Instance, LinearArray, Union
from solidtree.model.document.primitives import Box, Cylinder, ImportedMesh, Polyhedron, Sphere
from solidtree.model.project.assets import AssetStore

CUBE = {"format": 1, "nodes": {"n1": {"kind": "Box"}}, "solids": ["n1"]}
MESH = b"solid any bytes will do\n" * 9


def sample(store: AssetStore) -> Document:
    """A little of everything that a project file has to keep; its mesh is in the store."""
    plate = Difference(
        id="plate",
        name="Plate “A” — 板",
        colour="#336699",
        children=(
            Box(id="slab", size=(Expression("width"), 40, 5)),
            LinearArray(
                id="holes", count=3, step=(20, 0, 0), children=(Cylinder(id="hole", radius=2.5).at(10, 20, -1),)
            ),
        ),
    )
    pyramid = Polyhedron(
        id="pyramid",
        points=((0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 0.1)),
        faces=((0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)),
    )
    return Document(
        solids=(
            plate,
            Union(id="more", visible=False, note="two\nlines", children=(Sphere(id="ball").turned(z=30), pyramid)),
            ImportedMesh(id="mesh", asset=store.put(MESH), file_format="stl", part=2),
            Instance(id="again", definition="part"),
        ),
        definitions=(Box(id="part", size=(1, 2, 3)),),
        parameters=(Parameter("width", 100.0, minimum=10.0, maximum=200.0, note="of the plate"),),
        notes="Notes.",
    )


def packed(members, method=zipfile.ZIP_DEFLATED):
    """A zip of (name, bytes), names as they are."""
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", method) as archive:
        for name, data in members:
            archive.writestr(name, data)
    return stream.getvalue()


def project(table, *more):
    text = table if isinstance(table, bytes) else json.dumps(table).encode()
    return packed([("document.json", text), *more])
