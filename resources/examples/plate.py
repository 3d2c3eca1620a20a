"""A perforated plate: its size, the holes and their spacing are parameters."""

from pathlib import Path

from solidtree.model.script import *

across = parameter("across", 10, minimum=1, maximum=40, note="holes along x", group="holes")
along = parameter("along", 6, minimum=1, maximum=40, note="holes along y", group="holes")
radius = parameter("radius", 3, minimum=0.5, maximum=20, note="of a hole", group="holes")
spacing = parameter("spacing", 10, minimum=2, maximum=60, note="from hole to hole", group="holes")
thickness = parameter("thickness", 4, minimum=0.4, maximum=30, note="of the plate", group="plate")

blank = (
    box(across * spacing, along * spacing, thickness).named("blank").noted("Half a spacing is left around the holes.")
)
hole = cylinder(radius, thickness + 2).at(spacing / 2, spacing / 2, -1).named("hole")
hole = hole.noted("One longer than the plate on both sides, so that the cut is clean.")
row = linear_array(hole, across, (spacing, 0, 0)).named("row of holes")
holes = linear_array(row, along, (0, spacing, 0)).named("holes")

save(Path(__file__).with_suffix(".solidtree"), plate=(blank - holes).coloured("#a7adb5"))
