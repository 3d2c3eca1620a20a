"""The textbook's dumbbell: two spheres joined by a bar, cut flat below so that it does not roll away."""

from pathlib import Path

from solidtree.model.script import *

left = sphere(10).at(-20).named("left weight").noted("A ball of radius 10, moved 20 to the left.")
right = sphere(10).at(20).named("right weight").noted("The same ball, moved 20 to the right.")
bar = cylinder(radius=4, height=40).turned(y=90).at(-20).named("bar")
bar = bar.noted("A cylinder stands on z = 0; it is turned to lie along x and reaches from ball to ball.")
whole = union(left, right, bar).named("weights and bar").noted("All that lies in any of the three.")
floor = halfspace(normal=(0, 0, 1), point=(0, 0, -7)).named("foot")
floor = floor.noted("Keeps what is above z = -7, the side that its normal points to.")
dumbbell = (whole & floor).coloured("#6f8fb5").noted("Whole and foot, intersected: the weights get a flat foot.")

save(Path(__file__).with_suffix(".solidtree"), dumbbell=dumbbell)
