"""What becomes of a node in the solid it stands in."""

from solidtree.model.document.tree import numbered
from solidtree.model.script import box, halfspace, hull, linear_array, sphere
from solidtree.model.solid.roles import Role, role_of, roles_along


def test_roles():
    tree = (box(1) - (sphere(1) & box(2)) - hull(box(1), sphere(1))) & halfspace()
    (root,) = numbered([tree + linear_array(box(1) - box(2), 3)])
    union_ = root
    cut, array = union_.children
    difference, plane = cut.children
    first, both, skin = difference.children

    def role(*nodes):
        return role_of([root], tuple(getattr(node, "id", node) for node in nodes))

    assert role(root) is Role.SHOWN and role(root, cut) is Role.SHOWN
    assert role(root, cut, plane) is Role.INTERSECTED
    assert role(root, cut, difference, first) is Role.INTERSECTED
    assert role(root, cut, difference, both) is Role.SUBTRACTED
    assert role(root, cut, difference, both, both.children[0]) is Role.SUBTRACTED
    assert role(root, cut, difference, skin) is Role.SUBTRACTED
    assert role(root, cut, difference, skin, skin.children[1]) is Role.ENCLOSED
    below = array.children[0]
    assert role(root, array, 2, below, below.children[0]) is Role.SHOWN
    path = (root.id, array.id, 2, below.id, below.children[1].id)
    assert roles_along([root], path)[-1] is Role.SUBTRACTED
    assert role_of([], ("n1",)) is Role.SHOWN and role_of([root], ()) is Role.SHOWN
