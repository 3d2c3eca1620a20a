"""A part like a drill bit: a shank, a body with two twisted flutes and a pointed tip."""

from pathlib import Path

from solidtree.model.script import *

radius = parameter("radius", 5, minimum=1, maximum=20, note="of the body")
length = parameter("length", 60, minimum=20, maximum=200, note="of the fluted body")
turns = parameter("turns", 1.5, minimum=0.25, maximum=4, note="of the flutes along the body")

shank = cylinder(radius * 0.9, length / 2).at(z=-length / 2).named("shank")
body = cylinder(radius, length).named("body")
groove = circle(radius * 0.62, segments=40).at(radius)
flute = extrude(groove, length + 1, twist=360 * turns, tolerance=0.1).named("flute")
flute = flute.noted("A circle beside the axis, drawn up and twisted: it leaves a helical groove.")
flutes = polar_array(flute, 2).named("both flutes")
point = cone(4 * radius, 0, 4 * radius * 0.6).at(z=length - 4 * radius * 0.6).named("point")
point = point.noted("A wide cone with its tip on the axis; what lies outside of it is cut away.")

bit = union(shank, (body - flutes).named("fluted body")) & union(
    point, cylinder(4 * radius, length * 1.5 - 2.4 * radius).at(z=-length / 2)
)
save(Path(__file__).with_suffix(".solidtree"), drill_bit=bit.coloured("#8d9299"))
