"""A motion of 300 parts in 50 steps: contacts of every step, against cutting the parts, exact booleans and min_gap of
the pairs whose boxes are near, in a few of the steps and scaled to all of them."""

import time

import numpy as np
from manifold3d import Manifold, OpType

from solidtree.model.document.document import Document
from solidtree.model.document.expression import Expression
from solidtree.model.mesh.faults.box_pairs import meeting
from solidtree.model.proximity.checks import Checks
from solidtree.model.proximity.moving.parts import document_at
from solidtree.model.proximity.moving.playing import play
from solidtree.model.script import cylinder, document_of, motion, parameter
from solidtree.model.solid.results import evaluate_document

PARTS, STEPS, CLEARANCE, SAMPLED = 300, 50, 0.2, 3


def pistons() -> Document:
    """Half of the parts are sleeves, the others pistons in them that go up and down, each at its own time."""
    t = parameter("t", 0)
    parts = []
    for number in range(PARTS // 2):
        x, y = 12.0 * (number % 15), 12.0 * (number // 15)
        sleeve = cylinder(5, 20, segments=48) - cylinder(4, 30, segments=48).at(0, 0, -5)
        height = Expression(f"6 * sin(t * 360 + {7 * number})", t.declares)
        parts.append(sleeve.at(x, y).named(f"sleeve {number}"))
        parts.append(cylinder(3.9, 8, segments=48).at(x, y, height).named(f"piston {number}"))
    return motion(document_of(*parts), "run", steps=STEPS).with_(checks=Checks(CLEARANCE))


def main() -> None:
    document = pistons()
    start = time.perf_counter()
    played = play(document)
    ours = time.perf_counter() - start
    asked, count, cut = 0.0, 0, 0.0
    for step in np.linspace(0, STEPS, SAMPLED).astype(int).tolist():
        start = time.perf_counter()
        found = evaluate_document(document_at(document, document.motions[0], step / STEPS)).solids
        solids = [result.solid for result in found if result.solid is not None]
        cut += time.perf_counter() - start
        boxes = np.array([solid.bounding_box() for solid in solids]).reshape(-1, 2, 3)
        start = time.perf_counter()
        near = [
            pair
            for left, right in meeting(boxes[:, 0] - CLEARANCE / 2, boxes[:, 1] + CLEARANCE / 2)
            for pair in zip(left.tolist(), right.tolist(), strict=True)
        ]
        told = 0
        for one, other in near:
            shared = Manifold.batch_boolean([solids[one], solids[other]], OpType.Intersect).volume()
            told += shared > 0.0 or solids[one].min_gap(solids[other], CLEARANCE) < CLEARANCE
        asked += time.perf_counter() - start
        count += len(near)
        assert told == len(played.touches[step]), (told, len(played.touches[step]))
    theirs = (asked + cut) / SAMPLED * (STEPS + 1)
    listed = sum(map(len, played.touches))
    print(f"{PARTS} parts, {STEPS} steps, {count / SAMPLED:.0f} pairs of near boxes a step, {listed:,} contacts in all")
    print(
        f"solidtree {ours:.2f} s; cutting, booleans and min_gap of near pairs {theirs:.2f} s: "
        f"{theirs / ours:.1f} times as long, of which {asked / SAMPLED * (STEPS + 1):.2f} s are the pairs"
    )


if __name__ == "__main__":
    main()
