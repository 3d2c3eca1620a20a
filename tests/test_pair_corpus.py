"""Five hundred random pairs of other people's solids: gaps against brute force, overlaps against the boolean."""

import json

import numpy as np
import pytest
from csg_reader import read_csg
from manifold3d import Manifold, Mesh64

from solidtree.model.document.errors import Refusal
from solidtree.model.exchange.meshes_in import read_mesh_file
from solidtree.model.proximity.bodies import Body, relation, relations
from solidtree.model.solid.evaluate import Evaluator
from solidtree.model.solid.results import arrays_of

PAIRS, MOST = 500, 300


def solids_of(corpus):
    """Closed solids of at most so many triangles, from the mesh files and the boolean cases, about 1 in size."""
    found = []
    for path in sorted((corpus / "mesh").rglob("*")):
        if path.suffix.lower() in (".stl", ".off", ".ply", ".obj") and path.stat().st_size < 200_000:
            try:
                parts = read_mesh_file(path, path.suffix[1:].lower())
            except Refusal:
                continue
            found += [(part.vertices, part.triangles) for part in parts if part.closed and len(part.triangles) <= MOST]
    cases = json.loads((corpus / "boolean" / "expected.json").read_text())
    for path in sorted((corpus / "boolean" / "csg").glob("*.csg")):
        entry = Evaluator().evaluate(read_csg(path.read_text())) if path.stem in cases else None
        if entry is not None and entry.solid is not None and 0 < entry.solid.num_tri() <= MOST:
            found.append(arrays_of(entry.solid.to_mesh64()))
    solids = []
    for vertices, triangles in found:
        points = (vertices - vertices.mean(axis=0)) / max(np.ptp(vertices, axis=0).max(), 1e-12)
        solid = Manifold(Mesh64(np.ascontiguousarray(points), np.ascontiguousarray(triangles, np.uint64)))
        if not solid.is_empty() and solid.volume() > 1e-6:
            solids.append(solid)
    return solids


def placed(solid, rng):
    """At random, some small, or on a grid by quarter turns, where faces come to lie in faces."""
    if rng.random() < 0.5:
        turned = solid.rotate((90 * rng.integers(0, 4, 3)).tolist())
        return turned.translate((rng.integers(-1, 2, 3) - np.array(turned.bounding_box()[:3])).tolist())
    small = solid.scale(3 * (rng.choice([0.15, 1, 1]),))
    return small.rotate(rng.uniform(0, 360, 3).tolist()).translate(rng.uniform(-0.5, 0.5, 3).tolist())


def edges_of(triangles):
    sides = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    return np.unique(np.sort(sides, axis=1), axis=0)


def to_segments(points, start, way):
    """(n, m) distances of points to segments."""
    off = points[:, None] - start
    share = np.clip((off * way).sum(-1) / (way * way).sum(-1), 0, 1)
    return np.linalg.norm(off - share[..., None] * way, axis=-1)


def to_planes(points, mesh):
    """(n, m) signed heights of points over triangles, and whether they are over the inside."""
    sides = np.roll(mesh, -1, axis=1) - mesh
    normal = np.cross(sides[:, 0], sides[:, 1])
    normal = normal / np.linalg.norm(normal, axis=1)[:, None]
    height = np.einsum("nmi,mi->nm", points[:, None] - mesh[:, 0], normal)
    return height, over(points, mesh, sides, normal)


def over(points, mesh, sides, normal):
    inward = np.cross(normal[:, None], sides)  # (m, 3, 3)
    return np.stack([np.einsum("nmi,mi->nm", points[:, None] - mesh[:, k], inward[:, k]) >= 0 for k in range(3)]).all(0)


def pierced(start, way, mesh):
    """Whether a segment goes through a triangle."""
    sides = np.roll(mesh, -1, axis=1) - mesh
    normal = np.cross(sides[:, 0], sides[:, 1])
    rise = way @ normal.T
    with np.errstate(divide="ignore", invalid="ignore"):
        share = np.einsum("nmi,mi->nm", mesh[:, 0] - start[:, None], normal) / rise
    n, m = np.nonzero((share >= 0) & (share <= 1))
    at = start[n] + share[n, m, None] * way[n]
    inward = np.cross(normal[m, None], sides[m])
    return ((at[:, None] - mesh[m]) * inward).sum(-1).min(axis=1, initial=np.inf).max(initial=-np.inf) > 0


def brute(one, other):
    """The least distance between two surfaces, by every pair of their corners, edges and faces."""
    (p, a), (q, b) = one, other
    e, f = edges_of(a), edges_of(b)
    u, v = p[e[:, 1]] - p[e[:, 0]], q[f[:, 1]] - q[f[:, 0]]
    if pierced(p[e[:, 0]], u, q[b]) or pierced(q[f[:, 0]], v, p[a]):
        return 0.0
    found = [to_segments(p, q[f[:, 0]], v).min(), to_segments(q, p[e[:, 0]], u).min()]
    for points, mesh in ((p, q[b]), (q, p[a])):
        height, inside = to_planes(points, mesh)
        found.append(np.abs(height[inside]).min(initial=np.inf))
    # Lines that cross between their ends.
    w = p[e[:, 0]][:, None] - q[f[:, 0]]
    uu, vv, uv = (u * u).sum(-1)[:, None], (v * v).sum(-1)[None], u @ v.T
    uw, vw = np.einsum("ni,nmi->nm", u, w), np.einsum("mi,nmi->nm", v, w)
    spread = uu * vv - uv * uv
    with np.errstate(divide="ignore", invalid="ignore"):
        s, t = (uv * vw - vv * uw) / spread, (uu * vw - uv * uw) / spread
    n, m = np.nonzero((spread > 1e-9 * uu * vv) & (s > 0) & (s < 1) & (t > 0) & (t < 1))
    apart = w[n, m] + s[n, m, None] * u[n] - t[n, m, None] * v[m]
    return min(*found, np.linalg.norm(apart, axis=1).min(initial=np.inf))


def test_random_pairs_of_corpus_solids(corpus):
    solids = solids_of(corpus)
    assert len(solids) >= 30
    rng = np.random.default_rng(2026)
    pairs = [[placed(solids[k], rng) for k in rng.integers(0, len(solids), 2)] for _ in range(PAIRS)]
    bodies = [Body("", *arrays_of(solid.to_mesh64()), solid) for pair in pairs for solid in pair]
    ends = [(2 * k, 2 * k + 1) for k in range(PAIRS)]
    together = relations(bodies, ends, [100.0] * PAIRS)
    kinds = dict.fromkeys(("apart", "touching", "overlapping", "inside", "around"), 0)
    for (i, j), (one, other), all_at_once in zip(ends, pairs, together, strict=True):
        found = relation(bodies[i], bodies[j])
        kinds[found.kind] += 1
        assert all_at_once.kind == found.kind and all_at_once.gap == pytest.approx(found.gap, abs=1e-9)
        assert found.overlap == pytest.approx((one ^ other).volume(), abs=1e-9)
        if found.points is None:
            assert found.overlap > 0 and found.gap == 0
            continue
        meshes = [(body.vertices, body.triangles) for body in (bodies[i], bodies[j])]
        assert found.gap == pytest.approx(brute(*meshes), abs=1e-9)
        for relation_ in (found, all_at_once):
            assert np.linalg.norm(relation_.points[0] - relation_.points[1]) == pytest.approx(found.gap, abs=1e-9)
            for point, (vertices, triangles) in zip(relation_.points, meshes, strict=True):
                edges = edges_of(triangles)
                near = to_segments(point[None], vertices[edges[:, 0]], np.diff(vertices[edges], axis=1)[:, 0]).min()
                height, inside = to_planes(point[None], vertices[triangles])
                assert min(near, np.abs(height[inside]).min(initial=np.inf)) < 1e-9
    assert min(kinds["apart"], kinds["overlapping"]) > 50 and kinds["touching"] > 5 and kinds["inside"] > 0
