"""The search language: what finds which nodes."""

import pytest

from solidtree.model.document.query import query
from solidtree.model.document.tree import walk
from solidtree.model.script import box, cylinder, document_of, halfspace, instance, parameter, sphere, union

WIDTH = parameter("width", 3)
# n1 (n2 box, n3 sphere), n4 cylinder, n5 half-space, n6 instance
DOCUMENT = document_of(
    union(
        box(WIDTH).named("Left wing").coloured("red"), sphere(1).noted("check: radius").hidden()
    ).named("Body"),
    cylinder(1).at(WIDTH).named("hidden pin"),
    halfspace(),
    instance("n1").named("again"),
)  # fmt: skip


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("", "n1 n2 n3 n4 n5 n6"),
        ("wing", "n2"),
        ("WING left", "n2"),
        ('"left wing"', "n2"),
        ('"wing left"', ""),
        ('"left w', "n2"),
        ("kind:sphere", "n3"),
        ("kind:half-space", "n5"),
        ("kind:halfspace", "n5"),
        ("kind:", "n1 n2 n3 n4 n5 n6"),
        ("sphere", "n3"),
        ("note:radius", "n3"),
        ("check:", "n3"),
        ("check:radius", ""),
        ("name:body", "n1"),
        ("name:sphere", ""),
        ("colour:red", "n2"),
        ("color:#f00", "n2"),
        ("colour:any", "n2"),
        ("colour:none", "n1 n3 n4 n5 n6"),
        ("uses:width", "n2 n4"),
        ("uses:wid", ""),
        ("id:N4", "n4"),
        ("hidden", "n3 n4"),
        ('"hidden"', "n4"),
        ("problem", "n5"),
        ("-problem -hidden -operation", "n2 n6"),
        ("instance", "n6"),
        ("operation", "n1"),
        ("-kind:box wing", ""),
    ],
)
def test_a_query_finds(text, found):
    asked = query(text)
    nodes = walk(*DOCUMENT.roots)
    assert " ".join(node.id for node in nodes if asked.matches(node, {"n5"})) == found and not asked.fault


def test_a_colour_that_is_none_is_told_and_finds_nothing():
    asked = query("colour:blurple wing")
    assert "blurple" in asked.fault and not any(asked.matches(node) for node in walk(*DOCUMENT.roots))
