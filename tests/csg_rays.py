"""An independent judge of results: rays cast at the operands, each built alone by bare calls of manifold3d.

Nothing of `solidtree.model.solid` is used. A tree's inside is told from the insides of its leaves along the ray (Roth,
"Ray casting for modeling solids", 1982), triangles are hit by the test of Möller and Trumbore (1997).
"""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from manifold3d import CrossSection, Manifold, Mesh64

from solidtree.model.document.from_outlines import Extrude
from solidtree.model.document.nodes import (
    Difference,
    Hull,
    Intersection,
    LinearArray,
    Minkowski,
    Mirror,
    Node,
    PolarArray,
)  # fmt: skip
from solidtree.model.document.outlines import Rectangle
from solidtree.model.document.primitives import Box, Cone, Cylinder, Polyhedron, Sphere

PAIRS = 1 << 21  # of rays and triangles at a time


@dataclass
class Operand:
    """One leaf in its place. `corners` (t, 3, 3) in the world's axes, counter-clockwise from outside."""

    path: tuple
    leaf: Node
    corners: np.ndarray
    subtracted: bool


@dataclass
class Step:
    """One node of the tree in evaluation order: a leaf's number, or a function of steps before it."""

    kind: str
    sources: list[int]


def placed(node):
    """(4, 4) a node's own placement."""
    return np.vstack([node.placement.matrix(), [0, 0, 0, 1]])


def copies_of(node):
    """(4, 4) maps of the copies that arrays and mirrors make, by their formulas."""
    if isinstance(node, LinearArray):
        maps = [np.eye(4) for _ in range(int(node.count))]
        for i, matrix in enumerate(maps):
            matrix[:3, 3] = i * np.array(node.step)
        return maps
    if isinstance(node, PolarArray):
        axis = np.array(node.axis) / np.linalg.norm(node.axis)
        cross = np.cross(np.eye(3), axis)
        step = np.radians(node.angle / node.count if node.angle % 360 == 0 else node.angle / (node.count - 1))
        maps = []
        for i in range(int(node.count)):
            matrix = np.eye(4)
            # Rodrigues' formula (1840).
            matrix[:3, :3] += np.sin(i * step) * cross + (1 - np.cos(i * step)) * cross @ cross
            matrix[:3, 3] = np.array(node.point) - matrix[:3, :3] @ node.point
            maps.append(matrix)
        return maps
    if isinstance(node, Mirror):
        normal = np.array(node.normal) / np.linalg.norm(node.normal)
        image = np.eye(4)
        image[:3, :3] -= 2 * np.outer(normal, normal)
        image[:3, 3] = 2 * normal * (normal @ node.point)
        return [np.eye(4), image] if node.keep else [image]
    return [np.eye(4)]


def bare(node):
    """A leaf's solid before its placement; hulls and Minkowski sums are leaves here."""
    match node:
        case Box():
            return Manifold.cube(node.size, node.centred)
        case Cone():
            return Manifold.cylinder(node.height, node.radius, node.top_radius, int(node.segments), node.centred)
        case Cylinder():
            return Manifold.cylinder(node.height, node.radius, node.radius, int(node.segments), node.centred)
        case Sphere():
            return Manifold.sphere(node.radius, int(node.segments))
        case Polyhedron():
            fans = [(face[0], b, c) for face in node.faces for b, c in pairwise(face[1:])]
            mesh = Mesh64(np.array(node.points, np.float64), np.array(fans, np.uint64))
            mesh.merge()
            return Manifold(mesh)
        case Extrude(children=(Rectangle() as outline,)):
            section = CrossSection.square((outline.width, outline.height), outline.centred)
            solid = Manifold.extrude(section, node.height)
            return solid.translate((0, 0, -node.height / 2)) if node.centred else solid
        case Hull():
            return Manifold.batch_hull([bare_placed(child) for child in node.children])
        case Minkowski():
            solids = [bare_placed(child) for child in node.children]
            return solids[0].minkowski_sum(solids[1])
    raise ValueError(f"no bare solid of {node!r}")


def bare_placed(node):
    return bare(node).transform(node.placement.matrix())


def read(root):
    """The operands of a tree and its steps, the last one being the root."""
    operands, steps, made = [], [], {}
    stack = [((root.id,), root, placed(root), False, False)]
    while stack:
        path, node, matrix, subtracted, ready = stack.pop()
        if not node.children or isinstance(node, Extrude | Hull | Minkowski):
            solid = bare(node).to_mesh64()
            points = np.asarray(solid.vert_properties)[:, :3] @ matrix[:3, :3].T + matrix[:3, 3]
            corners = points[np.asarray(solid.tri_verts).astype(int)]
            if np.linalg.det(matrix[:3, :3]) < 0:
                corners = corners[:, ::-1]
            made[path] = len(steps)
            steps.append(Step("leaf", [len(operands)]))
            operands.append(Operand(path, node, corners, subtracted))
            continue
        below = []
        several = isinstance(node, LinearArray | PolarArray | Mirror)
        for number, copy in enumerate(copies_of(node)):
            for place, child in enumerate(node.children):
                minus = subtracted != (isinstance(node, Difference) and place > 0)
                way = (*path, *((number,) if several else ()), child.id)
                below.append((way, child, matrix @ copy @ placed(child), minus, False))
        if ready:
            kind = {Difference: "difference", Intersection: "intersection"}.get(type(node), "union")
            made[path] = len(steps)
            steps.append(Step(kind, [made[way] for way, *_ in below]))
        else:
            stack.append((path, node, matrix, subtracted, True))
            stack += reversed(below)
    return operands, steps


def inside(steps, leaves):
    """(k,) whether points lie in the tree, from whether they lie in its leaves (k, l)."""
    values = []
    for step in steps:
        if step.kind == "leaf":
            values.append(leaves[:, step.sources[0]])
            continue
        below = [values[source] for source in step.sources]
        if step.kind == "union":
            values.append(np.logical_or.reduce(below) if below else np.zeros(len(leaves), bool))
        elif step.kind == "intersection":
            values.append(np.logical_and.reduce(below))
        else:
            values.append(below[0] & ~np.logical_or.reduce([np.zeros(len(leaves), bool), *below[1:]]))
    return values[-1]


def hits(corners, origins, directions):
    """Every hit of rays on triangles (t, 3, 3): numbers of rays, and distances."""
    rays, distances = [], []
    a = corners[:, 0]
    first, second = corners[:, 1] - a, corners[:, 2] - a
    middle = corners.mean(axis=0) if not len(corners) else (corners.min(axis=(0, 1)) + corners.max(axis=(0, 1))) / 2
    reach = np.linalg.norm(corners - middle, axis=2).max(initial=0.0) * (1 + 1e-9)
    offset = middle - origins
    along = np.einsum("rk,rk->r", offset, directions)
    near = np.flatnonzero(np.linalg.norm(offset - along[:, None] * directions, axis=1) <= reach)
    step = max(1, PAIRS // max(len(corners), 1))
    for start in range(0, len(near), step):
        chosen = near[start : start + step]
        o, d = origins[chosen, None], directions[chosen, None]
        across = np.cross(d, second)
        with np.errstate(divide="ignore", invalid="ignore"):
            scale = 1 / np.einsum("tk,rtk->rt", first, across)
            u = np.einsum("rtk,rtk->rt", o - a, across) * scale
            turned = np.cross(o - a, first)
            v = np.einsum("rtk,rtk->rt", np.broadcast_to(d, turned.shape), turned) * scale
            t = np.einsum("tk,rtk->rt", second, turned) * scale
            ray, triangle = np.nonzero((u >= 0) & (v >= 0) & (u + v <= 1) & (t > 0) & np.isfinite(scale))
        rays.append(chosen[ray])
        distances.append(t[ray, triangle])
    return np.concatenate(rays or [np.zeros(0, int)]), np.concatenate(distances or [np.zeros(0)])


def first_change(operands, steps, origins, directions, tolerance):
    """Where each ray first enters or leaves the tree: distance (inf where never), and the paths of the operands whose
    surfaces it crosses there, all of those that coincide."""
    found = [hits(operand.corners, origins, directions) for operand in operands]
    ray = np.concatenate([rays for rays, _ in found])
    distance = np.concatenate([distances for _, distances in found])
    leaf = np.repeat(np.arange(len(operands)), [len(rays) for rays, _ in found])
    order = np.lexsort((distance, ray))
    ray, distance, leaf = ray[order], distance[order], leaf[order]
    starts, ends = np.searchsorted(ray, [np.arange(len(origins)), np.arange(len(origins)) + 1])
    result = []
    for start, end in zip(starts, ends, strict=True):
        crossed, at = leaf[start:end], distance[start:end]
        toggles = np.zeros((end - start + 1, len(operands)), int)
        toggles[np.arange(1, end - start + 1), crossed] = 1
        # Beyond the last hit it is outside of everything: parity is counted from there.
        parity = (toggles.sum(axis=0) - toggles.cumsum(axis=0)) % 2 == 1
        state = inside(steps, parity)
        # Between hits in the same place there is nothing.
        stable = np.append(np.diff(at, prepend=-np.inf) > tolerance, True)
        stops = np.flatnonzero(stable)
        change = np.flatnonzero(state[stops[1:]] != state[stops[:-1]])
        if not len(change):
            result.append((np.inf, set()))
            continue
        one, other = stops[change[0]], stops[change[0] + 1]
        result.append((at[one], {operands[i].path for i in crossed[one:other]}))
    return result
