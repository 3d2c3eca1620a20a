"""An angle bracket with a rib, screw holes and a rounded upright."""

from pathlib import Path

from solidtree.model.script import *

width = parameter("width", 40, minimum=20, maximum=120, note="of the bracket")
depth = parameter("depth", 50, minimum=25, maximum=150, note="of the foot")
height = parameter("height", 60, minimum=30, maximum=200, note="to the middle of the upright's rounding")
wall = parameter("wall", 5, minimum=2, maximum=12, note="thickness")
screw = parameter("screw", 2.7, minimum=1, maximum=6, note="radius of a screw hole")

foot = box(width, depth, wall).at(-width / 2).named("foot")
plate = box(width, wall, height).at(-width / 2).named("plate")
rounding = cylinder(width / 2, wall).turned(x=-90).at(0, 0, height).named("rounding")
side = polygon([(0, 0), (depth * 0.7, 0), (0, height * 0.7)])
rib = extrude(side, wall, centred=True).turned(x=90).turned(z=90).at(0, wall / 2, wall / 2).named("rib")
rib = rib.noted("A triangle drawn out by one wall, standing across the corner.")

eye = cylinder(width / 4, wall + 2).turned(x=-90).at(0, -1, height).named("eye")
countersunk = union(cylinder(screw, wall + 2).at(z=-1), cone(screw, 2 * screw, screw).at(z=wall - screw + 0.01))
countersunk = countersunk.named("countersunk hole").at(width / 3, depth - width / 4)
screws = mirror(countersunk).named("pair of screws")

bracket = (union(foot, plate, rounding, rib).named("body") - eye - screws).turned(z=180)
save(Path(__file__).with_suffix(".solidtree"), bracket=bracket.coloured("#c79a5b"))
