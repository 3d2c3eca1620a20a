"""Which colour each face of a result gets: the one of the node that made it, or of the nearest above it."""

import numpy as np
import pytest

from solidtree.gui.view.occurrences import maker_of, paint_of
from solidtree.model.document.colours import rgb
from solidtree.model.document.distinct_colours import distinct_colour
from solidtree.model.document.document import Document
from solidtree.model.document.nodes import Instance
from solidtree.model.document.resolve import resolve
from solidtree.model.document.tree import numbered, walk
from solidtree.model.script import box, cylinder, hull, linear_array, minkowski, mirror, sphere
from solidtree.model.solid.evaluate import Evaluator
from solidtree.model.solid.results import display_of, result_of
from solidtree.render.look import LIGHT, palette

RED, BLUE, GREEN = "#ff0000", "#0000ff", "#008000"
DRILL = cylinder(2, 30, segments=8).at(5, 5, -9).named("drill")


def colours(node, by_node=False, definitions=()):
    """The colours of a tree's faces, as bytes, by the name of the node that made them."""
    (root,) = numbered([node])
    document = Document(solids=(root,), definitions=definitions)
    resolved, evaluator = resolve(document).solids[0], Evaluator()
    mesh = display_of(result_of(resolved, evaluator.evaluate(resolved)), evaluator)
    table = palette(mesh, paint_of(document, root, mesh, by_node), LIGHT)
    names = {node.id: node.name for node in walk(*document.roots)}
    found: dict[str, set] = {}
    for owner, subtracted in zip(mesh.owner, mesh.subtracted.astype(int), strict=True):
        name = names[maker_of(mesh.owners[owner])]
        found.setdefault(name, set()).add(tuple(np.round(255 * table[owner, subtracted]).astype(int).tolist()))
    return found


def test_colours_survive_in_the_result():
    part = box(10).named("cube")
    assert colours((part - DRILL.coloured(RED)).coloured(BLUE)) == {"cube": {rgb(BLUE)}, "drill": {rgb(RED)}}
    tinted = colours((part - DRILL).coloured(BLUE))
    assert tinted["cube"] == {rgb(BLUE)}
    ((red, green, blue),) = tinted["drill"]
    assert (red, green) == (0, 0) and blue == round(255 * LIGHT.tint[2])  # the solid's, tinted
    array = linear_array(box(1).coloured(RED).named("copy"), 3) + mirror(sphere(1).at(9, 9).named("image")).coloured(
        BLUE
    )
    assert colours(array) == {"copy": {rgb(RED)}, "image": {rgb(BLUE)}}
    skins = hull(box(1).coloured(RED), sphere(1).at(4)).named("skin").coloured(GREEN)
    sums = minkowski(box(1).at(20), box(1).coloured(RED)).named("sum")
    assert colours(skins + sums) == {"skin": {rgb(GREEN)}, "sum": {rgb(LIGHT.solid)}}


def test_instances_show_the_definitions_colours_and_their_own_above():
    definition = (box(4).with_(id="q", name="plain") - DRILL.with_(id="d", colour=RED)).with_(id="def")
    both = Instance(definition="def", name="a") + Instance(definition="def", name="b", colour=BLUE).at(20)
    found = colours(both, definitions=(definition,))
    assert found["drill"] == {rgb(RED)} and found["plain"] == {rgb(LIGHT.solid), rgb(BLUE)}


def test_a_colour_for_each_node_instead():
    tree = (box(10).named("cube").coloured(RED) - DRILL) + linear_array(box(1).at(30).named("copy"), 3)
    (root,) = numbered([tree])
    ids = {node.name: node.id for node in walk(root)}
    found = colours(tree, by_node=True)
    assert found == {name: {rgb(distinct_colour(ids[name]))} for name in ("cube", "drill", "copy")}


@pytest.mark.parametrize(("path", "maker"), [(("a", 3, "b"), "b"), (("a", "b", 2), "b"), (("a",), "a")])
def test_the_maker_of_a_face_is_the_last_node_of_its_path(path, maker):
    assert maker_of(path) == maker
