"""What the tree costs over bare manifold3d calls, and what a small change costs: ratios within one run.

The bare side makes the same solids with the same calls (batches, segments, mesh extraction) and keeps no tree.
"""

from __future__ import annotations

import gc
import os
import sys
import time
from pathlib import Path

import numpy as np
from manifold3d import CrossSection, FillRule, Manifold, Mesh64, OpType

ROOT = Path(__file__).parent.parent
sys.path.insert(0, str(ROOT / "tests"))

from csg_reader import Call, fragments, parse, read_csg, sphere_mesh  # noqa: E402

from solidtree.model.document.document import Document  # noqa: E402
from solidtree.model.document.tree import change, numbered  # noqa: E402
from solidtree.model.script import box, cylinder, union  # noqa: E402
from solidtree.model.solid.evaluate import Evaluator  # noqa: E402

CORPUS = Path(os.environ.get("SOLIDTREE_CORPUS", ROOT.parent / "shared" / "corpus"))
BATCHES = {"difference": OpType.Subtract, "intersection": OpType.Intersect}


def bare_leaf(call: Call) -> Manifold | CrossSection:
    a = call.arguments
    match call.word:
        case "cube":
            return Manifold.cube(tuple(map(float, a["size"])), bool(a.get("center")))
        case "cylinder":
            low, high = a.get("r1", a.get("r")), a.get("r2", a.get("r"))
            return Manifold.cylinder(a["h"], low, high, fragments(max(low, high), a), bool(a.get("center")))
        case "square":
            return CrossSection.square(tuple(map(float, a["size"])), bool(a.get("center")))
        case "polygon":
            points = np.array(a["points"], dtype=float)
            return CrossSection([points[loop] for loop in a.get("paths") or [range(len(points))]], FillRule.EvenOdd)
    points, faces = sphere_mesh(a["r"], fragments(a["r"], a)) if call.word == "sphere" else (a["points"], a["faces"])
    sign = 1 if call.word == "sphere" else -1
    triangles = [(f[0], f[i], f[i + 1])[::sign] for f in faces for i in range(1, len(f) - 1)]
    mesh = Mesh64(np.array(points, dtype=float), np.array(triangles, dtype=np.uint64))
    solid = Manifold(mesh)
    if solid.is_empty():
        mesh.merge()
        solid = Manifold(mesh)
    return solid


def bare(call: Call) -> Manifold:
    """The same tree in bare calls: one batch for each operation, nothing kept."""
    made: list = []
    stack = [(call, False)]
    while stack:
        call, ready = stack.pop()
        if not call.below and call.word not in ("group", "union", *BATCHES):
            made.append(bare_leaf(call))
            continue
        if not ready:
            stack.append((call, True))
            stack += [(below, False) for below in reversed(call.below)]
            continue
        size = len(call.below)
        solids = made[len(made) - size :]
        del made[len(made) - size :]
        if call.word == "linear_extrude":
            scale = call.arguments.get("scale", [1, 1])
            made.append(solids[0].extrude(call.arguments["height"], 0, 0.0, (float(scale[0]), float(scale[1]))))
            continue
        solid = solids[0] if size == 1 else Manifold.batch_boolean(solids, BATCHES.get(call.word, OpType.Add))
        if call.word == "multmatrix":
            solid = solid.transform(np.array(call.arguments[0], dtype=float)[:3])
        made.append(solid)
    return made[0]


def mesh_of(solid: Manifold) -> int:
    mesh = solid.to_mesh64()
    return len(np.asarray(mesh.vert_properties)) + len(np.asarray(mesh.tri_verts))


def seconds(function) -> float:
    gc.collect()
    start = time.perf_counter()
    function()
    return time.perf_counter() - start


def alternately(ours, theirs, rounds: int) -> tuple[float, float]:
    """The least time of each, taken turn by turn, so that a noisy machine troubles both alike."""
    pairs = [(seconds(ours), seconds(theirs)) for _ in range(rounds)]
    return min(pair[0] for pair in pairs), min(pair[1] for pair in pairs)


def corpus_cases() -> None:
    if not CORPUS.is_dir():
        print("corpus not here: skipped")
        return
    mine = others = 0.0
    count = 0
    for path in sorted([*CORPUS.glob("boolean/csg/*.csg"), *CORPUS.glob("thingicsg/basic/*.csg")]):
        text = path.read_text()
        root, call = read_csg(text), Call("group", {}, parse(text))
        ours, theirs = alternately(
            lambda r=root: mesh_of(Evaluator().evaluate(r).solid), lambda c=call: mesh_of(bare(c)), 7
        )
        mine, others, count = mine + ours, others + theirs, count + 1
        if theirs > 0.01:
            print(f"  {path.stem:32} {1e3 * ours:8.1f} ms {1e3 * theirs:8.1f} ms  {ours / theirs:5.2f}")
    print(
        f"{count} boolean and thingicsg cases, cold  {1e3 * mine:8.1f} ms {1e3 * others:8.1f} ms  {mine / others:5.2f}"
    )


def plate(count: int = 1000) -> Document:
    """A plate with holes that all have a node of their own."""
    holes = [cylinder(2, 12, segments=32).at(5 + i // 25 * 6, 5 + i % 25 * 6, -1) for i in range(count)]
    return Document(solids=numbered([(box(245, 155, 10) - union(*holes)).named("plate")]))


def bare_plate(count: int = 1000) -> Manifold:
    holes = [Manifold.cylinder(12, 2, 2, 32).translate((5 + i // 25 * 6, 5 + i % 25 * 6, -1)) for i in range(count)]
    return Manifold.batch_boolean([Manifold.cube((245, 155, 10)), *holes], OpType.Subtract)


def thousand_holes() -> None:
    document = plate()
    root = document.solids[0]
    ours, theirs = alternately(lambda: mesh_of(Evaluator().evaluate(root).solid), lambda: mesh_of(bare_plate()), 7)
    print(f"plate of 1,000 holes, cold             {1e3 * ours:8.1f} ms {1e3 * theirs:8.1f} ms  {ours / theirs:5.2f}")

    evaluator = Evaluator(incremental=True)
    colds: list[float] = []
    steps: dict[str, list[float]] = {
        "first, the hole not selected before": [],
        "first, the hole selected": [],
        "next": [],
    }
    rng = np.random.default_rng(1)
    for turn, hole in enumerate(rng.choice(1000, 16, replace=False)):
        colds.append(seconds(lambda: mesh_of(Evaluator(incremental=True).evaluate(root).solid)))
        if turn == 0:
            evaluator.evaluate(root)
        hole_id = document.solids[0].children[1].children[hole].id
        if turn % 2:  # what the window's worker does when a hole is selected
            evaluator.evaluate(change(document, hole_id, lambda n: None).solids[0])
        for step in range(5):
            document = change(document, hole_id, lambda n: n.at(0.1, 0.05))
            moved = document.solids[0]
            took = seconds(lambda r=moved: mesh_of(evaluator.evaluate(r).solid))
            kind = "next" if step else "first, the hole selected" if turn % 2 else "first, the hole not selected before"
            steps[kind].append(took)
    cold = float(np.median(colds))
    for kind, times in steps.items():
        median = float(np.median(times))
        print(f"moving one, {kind:38} {1e3 * median:8.1f} ms, {cold / median:5.1f} times faster than cold")
    before = evaluator.evaluations
    undone = seconds(lambda: mesh_of(evaluator.evaluate(root).solid))
    print(f"going back to the first: {evaluator.evaluations - before} evaluations, {1e3 * undone:.1f} ms")


if __name__ == "__main__":
    print(f"{'':38} {'ours':>8}    {'bare':>8}     ratio")
    corpus_cases()
    thousand_holes()
