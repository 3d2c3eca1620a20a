"""Normals in the real window: needles that follow, the crease among the properties and its commands."""

import numpy as np

from solidtree.model.mesh.needles import MOST
from solidtree.model.script import box, cylinder, document_of, sphere

pytest_plugins = ["window_driver"]


def pixels(driver):
    viewer = driver.window.viewport.viewer
    viewer.render()
    return viewer.pixels().astype(int)


def count(driver):
    return driver.window.viewport.viewer.needles.count


def test_needles_stand_on_what_is_selected_and_follow_it(make_window):
    driver = make_window(document_of(left=box(10), right=box(10).at(40)))
    driver.look_from("iso")
    plain = pixels(driver)
    driver.keys("Alt+N", driver.window.viewport)
    assert count(driver) == 12
    spot = driver.pixel_of((5, 5, 10 + 1.5))
    assert np.abs(pixels(driver)[spot.y() - 3 : spot.y() + 4, spot.x() - 3 : spot.x() + 4]
                  - plain[spot.y() - 3 : spot.y() + 4, spot.x() - 3 : spot.x() + 4]).max() > 60  # fmt: skip
    driver.session.select([driver.node("left").id])
    assert count(driver) == 6
    driver.window.actions_.run("vertex_normals")
    assert count(driver) == 6 + 24
    driver.window.actions_.run("vertex_normals")
    driver.window.actions_.run("face_normals")
    driver.session.select(())
    assert count(driver) == 0 and np.abs(pixels(driver) - plain).max() <= 2


def test_needles_of_a_drag_stand_on_its_pictures(make_window):
    driver = make_window(document_of(part=box(10)))
    driver.keys("Alt+N", driver.window.viewport)
    from solidtree.model.operations.operations import OPERATIONS

    driver.session.preview(OPERATIONS["set_field"](driver.document, driver.node("part").id, "size", (10, 10, 50)))
    driver.settle()
    actor = driver.window.viewport.viewer.needles._actor
    assert actor.GetMapper().GetInput().GetBounds()[5] > 50.0
    driver.session.cancel()


def test_it_says_where_a_part_of_the_normals_is_drawn(make_window):
    driver = make_window(document_of(ball=sphere(10, segments=256)))
    said = []
    driver.window.needles.said.connect(said.append)
    driver.window.actions_.run("face_normals")
    assert count(driver) <= MOST
    assert said == [f"{count(driver):,} of {8 * 64 * 64:,} face normals are drawn"]


def test_the_crease_is_typed_among_the_properties_and_taken_away_again(make_window):
    driver = make_window(document_of(bar=cylinder(5, 20, segments=16)))
    scene = driver.window.viewport.viewer.scene
    root = driver.node("bar").id
    driver.session.select([root])
    field = driver.field("crease")
    assert field.placeholderText() == "auto" and field.text() == ""
    driver.type_into(field, "0")
    driver.settle()
    assert driver.node("bar").crease == 0.0 and len(scene.meshes[root].edges) == 48
    assert driver.session.log[-1] == f"set_crease(['{root}'], 0)"
    driver.type_into(field, "200")
    assert driver.node("bar").crease == 0.0 and "from 0 to 180" in field.parent().fault.text()
    driver.keys("Escape", field)
    driver.window.actions_.run("smooth_faces")
    driver.settle()
    assert field.text() == "180" and len(scene.meshes[root].edges) == 0
    driver.window.actions_.run("own_creases")
    driver.settle()
    assert driver.node("bar").crease is None and len(scene.meshes[root].edges) == 32


def test_a_crease_dragged_is_seen_on_the_way(make_window):
    driver = make_window(document_of(bar=cylinder(5, 20, segments=16)))
    from solidtree.model.operations.operations import OPERATIONS

    root = driver.node("bar").id
    driver.session.preview(OPERATIONS["set_crease"](driver.document, [root], 0))
    driver.settle()
    assert len(driver.window.viewport.viewer.scene.meshes[root].edges) == 48
    driver.session.cancel()
    driver.settle()
    assert len(driver.window.viewport.viewer.scene.meshes[root].edges) == 32


def test_split_by_angle_leads_to_the_field_and_a_part_follows_its_parent(make_window):
    driver = make_window(document_of(part=(box(10) + sphere(3).named("ball")).creased(40)))
    driver.session.select([driver.node("ball").id])
    assert driver.field("crease").placeholderText() == "as its parent: 40"
    driver.window.actions_.run("split_normals")
    assert driver.window.focusWidget() is driver.field("crease")
