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


OPEN_BOX = """v 0 0 0
v 10 0 0
v 10 10 0
v 0 10 0
v 0 0 10
v 10 0 10
v 10 10 10
v 0 10 10
f 4 3 2 1
f 1 2 6 5
f 2 3 7 6
f 3 4 8 7
f 4 1 5 8
"""
"""An open box: no lid."""


def faces_that_look_outwards(driver):
    """How many of the five sides do, by their needles."""
    from solidtree.model.mesh.needles import face_needles

    (mesh,) = driver.window.viewport.viewer.scene.meshes.values()
    needles = face_needles(mesh)
    return int((np.einsum("ij,ij->i", needles.feet - 5, needles.normals) > 0).sum()), needles.total


def test_faces_of_an_imported_mesh_are_turned_and_made_to_agree(make_window, tmp_path):
    path = tmp_path / "open box.obj"
    path.write_text(OPEN_BOX.replace("f 2 3 7 6", "f 6 7 3 2"))
    driver = make_window()
    driver.window.files.import_file(str(path))
    driver.qtbot.waitUntil(lambda: not driver.window.files.background.working and bool(driver.document.solids))
    driver.settle()
    root = driver.document.solids[0].id
    driver.session.select([root])
    outwards, total = faces_that_look_outwards(driver)
    assert 0 < outwards < total

    def run(name):
        driver.window.actions_.run(name)
        driver.qtbot.waitUntil(lambda: not driver.window.files.background.working)
        driver.settle()

    run("consistent_normals")
    assert faces_that_look_outwards(driver) == (total, total)
    steps = len(driver.session.log)
    assert driver.session.log[-1] == f"repair_mesh('{root}', ['orient'])"
    run("consistent_normals")
    assert len(driver.session.log) == steps and "agree already" in driver.window.status.currentMessage()
    run("flip_normals")
    assert faces_that_look_outwards(driver) == (0, total)
    driver.session.undo()
    driver.settle()
    assert faces_that_look_outwards(driver) == (total, total)


def test_faces_of_what_is_no_mesh_are_not_turned(make_window):
    driver = make_window(document_of(part=box(10)))
    assert not driver.window.actions_["flip_normals"].isEnabled()
    driver.session.select([driver.node("part").id])
    assert "“part” is no mesh" in driver.window.actions_["flip_normals"].toolTip()
