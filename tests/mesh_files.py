"""A unit cube in every dialect of every mesh format, made by hand, and what the tests of meshes measure."""

import base64
import io
import json
import struct
import zipfile

import numpy as np

CORNERS = np.array([[x, y, z] for x in (0.0, 1) for y in (0.0, 1) for z in (0.0, 1)])
CUBE = np.array([
    [0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1], [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4],
    [1, 5, 7], [1, 7, 3],
])  # fmt: skip
QUADS = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]


def volume(part):
    a, b, c = (part.vertices[part.triangles[:, i]] for i in range(3))
    return float(np.einsum("ij,ij->", a, np.cross(b, c))) / 6


def area(part):
    a, b, c = (part.vertices[part.triangles[:, i]] for i in range(3))
    return float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum()) / 2


def stl(corners, header=b"", attribute=0):
    rows = b"".join(struct.pack("<12fH", 0, 0, 0, *triangle.ravel(), attribute) for triangle in corners)
    return header.ljust(80, b"\0") + struct.pack("<I", len(corners)) + rows


def stl_text(corners, name=b"cube"):
    facets = b"".join(
        b"facet normal 0 0 0\nouter loop\n"
        + b"".join(b"  vertex %g %g %g\n" % tuple(point) for point in triangle)
        + b"endloop\nendfacet\n"
        for triangle in corners
    )
    return b"solid " + name + b"\n" + facets + b"endsolid\n"


def obj(faces=QUADS, offset=1):
    points = "".join("v {} {} {}\n".format(*point) for point in CORNERS)
    return (points + "".join("f " + " ".join(str(i + offset) for i in face) + "\n" for face in faces)).encode()


def ply(faces, order="<"):
    name = {"<": "binary_little_endian", ">": "binary_big_endian", "": "ascii"}[order]
    head = (
        f"ply\nformat {name} 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\n"
        f"element face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n"
    )
    if not order:
        rows = [" ".join(map(str, point)) for point in CORNERS] + [" ".join(map(str, [len(f), *f])) for f in faces]
        return (head + "\n".join(rows) + "\n").encode()
    body = b"".join(struct.pack(order + "3f", *point) for point in CORNERS)
    return head.encode() + body + b"".join(struct.pack(f"{order}B{len(f)}i", len(f), *f) for f in faces)


def off(header="OFF", faces=QUADS):
    rows = [" ".join(map(str, point)) for point in CORNERS] + [" ".join(map(str, [len(f), *f])) for f in faces]
    return f"{header}\n# a comment\n8 {len(faces)} 12\n{chr(10).join(rows)}\n".encode()


def threemf(body, head='unit="millimeter"', more=(), start="/3D/3dmodel.model"):
    space = "http://schemas.microsoft.com/3dmanufacturing"
    kind = f"{space}/2013/01/3dmodel"
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as archive:
        rels = "http://schemas.openxmlformats.org/package/2006/relationships"
        relation = f'<Relationship Id="r" Target="{start}" Type="{kind}"/>'
        archive.writestr("_rels/.rels", f'<Relationships xmlns="{rels}">{relation}</Relationships>')
        archive.writestr(
            "3D/3dmodel.model",
            f'<model {head} xmlns="{space}/core/2015/02" xmlns:m="{space}/material/2015/02" '
            f'xmlns:p="{space}/production/2015/06">{body}</model>',
        )
        for name, data in more:
            archive.writestr(name, data)
    return stream.getvalue()


MESH = (
    "<mesh><vertices>"
    + "".join('<vertex x="{}" y="{}" z="{}"/>'.format(*point) for point in CORNERS)
    + "</vertices><triangles>"
    + "".join('<triangle v1="{}" v2="{}" v3="{}"/>'.format(*face) for face in CUBE)
    + "</triangles></mesh>"
)
PLAIN = f'<resources><object id="1">{MESH}</object></resources><build><item objectid="1"/></build>'


def gltf(content=None, **changes):
    """A unit cube as glTF: positions as f32, indices as u16, then what changes."""
    data = CORNERS.astype("<f4").tobytes() + CUBE.astype("<u2").tobytes()
    table = {
        "asset": {"version": "2.0"},
        "buffers": [{"byteLength": len(data), "uri": "data:;base64," + base64.b64encode(data).decode()}],
        "bufferViews": [
            {"buffer": 0, "byteLength": 96},
            {"buffer": 0, "byteOffset": 96, "byteLength": 72},
        ],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 8},
            {"bufferView": 1, "componentType": 5123, "type": "SCALAR", "count": 36},
        ],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "nodes": [{"mesh": 0, "name": "cube"}],
        "scenes": [{"nodes": [0]}],
    }
    table.update(changes)
    return json.dumps(content or table).encode()


GOOD = [
    ("stl", stl(CORNERS[CUBE])),
    ("stl", stl(CORNERS[CUBE], b"solid but binary")),
    ("stl", stl(CORNERS[CUBE]) + b"\0\0\0"),
    ("stl", stl_text(CORNERS[CUBE])),
    ("stl", stl_text(CORNERS[CUBE]).replace(b"\n", b"\r\n").upper().replace(b"SOLID", b"solid")),
    ("obj", obj()),
    ("obj", obj(offset=-8)),
    ("obj", obj().replace(b"f 1 2", b"f 1/1/1 \\\n2//7")),
    ("ply", ply(QUADS)),
    ("ply", ply(QUADS, ">")),
    ("ply", ply(QUADS, "")),
    ("ply", ply([*QUADS[:5], [1, 5, 7], [1, 7, 3]])),
    ("ply", ply([*QUADS[:5], [1, 5, 7], [1, 7, 3]], "")),
    ("off", off()),
    ("off", off(faces=[*QUADS[:5], [1, 5, 7], [1, 7, 3]])),
    ("3mf", threemf(PLAIN)),
]
