"""The scene follows by identity, and colours triangles by the node that made them."""

import dataclasses

import numpy as np
import pytest
from render_meshes import ball, box, drilled
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkRenderingCore import vtkRenderer

from solidtree.render.actors import HOVERED, SELECTED
from solidtree.render.camera import Camera
from solidtree.render.look import DARK, LIGHT, STYLES, Paint, palette, rgb
from solidtree.render.outline import Adjacency
from solidtree.render.polydata import lines_of, surface_of
from solidtree.render.scene import Scene


@pytest.fixture
def scene() -> Scene:
    return Scene(vtkRenderer())


def colours(scene: Scene, solid_id: str) -> np.ndarray:
    return vtk_to_numpy(scene.surface(solid_id).GetCellData().GetScalars())


def bytes_of(colour, other=None, share=0.0) -> np.ndarray:
    mixed = np.array(rgb(colour)) * (1.0 - share) + share * np.array(rgb(other or colour))
    return np.round(255.0 * mixed)


def test_polydata_shares_the_memory_of_the_mesh():
    mesh = drilled()
    surface = surface_of(mesh)
    for array, own in (
        (surface.GetPoints().GetData(), mesh.points),
        (surface.GetPointData().GetNormals(), mesh.normals),
        (surface.GetPolys().GetConnectivityArray(), mesh.triangles),
        (lines_of(mesh.edge_points, mesh.edges).GetLines().GetConnectivityArray(), mesh.edges),
    ):
        assert np.shares_memory(vtk_to_numpy(array), own)
        assert np.array_equal(vtk_to_numpy(array).reshape(own.shape), own)
    assert surface.GetNumberOfCells() == len(mesh.triangles)


def test_what_is_the_same_object_is_not_uploaded_again(scene):
    mesh, other = box(), drilled()
    empty = scene.renderer.GetActors().GetNumberOfItems()
    scene.show({"a": (mesh, None), "b": (other, None)})
    surfaces = {key: scene.surface(key) for key in "ab"}
    stamps = {key: surface.GetMTime() for key, surface in surfaces.items()}
    actors = scene.renderer.GetActors().GetNumberOfItems()

    scene.show({"b": (other, None), "a": (mesh, None)})
    scene.set_style("edges")
    scene.set_look("light")
    assert all(scene.surface(key) is surfaces[key] for key in "ab")
    assert {key: surface.GetMTime() for key, surface in surfaces.items()} == stamps

    scene.show({"a": (box(), None), "b": (other, None)})
    assert scene.surface("a") is not surfaces["a"]
    assert scene.surface("b") is surfaces["b"] and surfaces["b"].GetMTime() == stamps["b"]
    assert scene.renderer.GetActors().GetNumberOfItems() == actors

    scene.show({"b": (other, None)})
    assert list(scene.meshes) == ["b"]
    assert scene.renderer.GetActors().GetNumberOfItems() == (empty + actors) // 2


def test_colours_alone_change_colours_alone(scene):
    mesh = box()
    scene.show({"a": (mesh, Paint("#112233"))})
    points = scene.surface("a").GetPoints().GetMTime()
    assert (colours(scene, "a") == bytes_of("#112233")).all()
    before = scene.surface("a").GetMTime()
    scene.show({"a": (mesh, Paint("#112233"))})
    assert scene.surface("a").GetMTime() == before
    scene.show({"a": (mesh, Paint("#112233", ("#ff0000",)))})
    assert (colours(scene, "a")[mesh.owner == 0] == (255, 0, 0)).all()
    assert (colours(scene, "a")[mesh.owner == 1] == bytes_of("#112233")).all()
    assert scene.surface("a").GetPoints().GetMTime() == points


def test_every_way_to_give_colours():
    mesh = box()
    array = np.array([[255, 0, 0], [0, 0, 255]], np.uint8)
    wanted = np.array([[[1, 0, 0]] * 2, [[0, 0, 1]] * 2], float)
    for given in (
        array,
        ["#ff0000", "blue"],
        lambda index: ((1.0, 0.0, 0.0), "#00f")[index],
        Paint(None, ("red", "blue")),
    ):
        assert np.allclose(palette(mesh, given, LIGHT), wanted)
    with pytest.raises(ValueError, match="colour"):
        rgb((1.0, 2.0))


def test_subtracted_faces_are_tinted_or_take_the_subtracted_colour(scene):
    mesh = drilled()
    scene.show({"part": (mesh, None)})
    plain, tinted = (colours(scene, "part")[mesh.subtracted == flag] for flag in (False, True))
    assert (plain == bytes_of(LIGHT.solid)).all()
    assert (tinted == np.round(255.0 * np.multiply(rgb(LIGHT.solid), LIGHT.tint))).all()
    scene.show({"part": (mesh, [None, "#cc6655"])})
    assert (colours(scene, "part")[mesh.subtracted] == bytes_of("#cc6655")).all()


def test_selection_is_by_the_beginning_of_the_path(scene):
    mesh, other = box(root="one"), box(root="two")
    scene.show({"one": (mesh, None), "two": (other, None)})
    scene.set_selection([("one", "b")])
    selected = bytes_of(LIGHT.solid, LIGHT.selection, SELECTED)
    assert (colours(scene, "one")[mesh.owner == 1] == selected).all()
    assert (colours(scene, "one")[mesh.owner == 0] == bytes_of(LIGHT.solid)).all()
    assert (colours(scene, "two") == bytes_of(LIGHT.solid)).all()
    scene.set_selection([("two",)])
    assert (colours(scene, "two") == selected).all()
    assert (colours(scene, "one") == bytes_of(LIGHT.solid)).all()
    scene.set_selection([("tw",), ("two", "a", "below")])
    assert (colours(scene, "two") == bytes_of(LIGHT.solid)).all()


def test_hover_tints_and_ends(scene):
    mesh = box()
    scene.show({"box": (mesh, None)})
    scene.set_hover(("box", "a"))
    assert (colours(scene, "box")[mesh.owner == 0] == bytes_of(LIGHT.solid, LIGHT.hover, HOVERED)).all()
    scene.set_hover(None)
    assert (colours(scene, "box") == bytes_of(LIGHT.solid)).all()


def test_selected_parts_are_outlined_by_their_own_edges(scene):
    mesh = box()
    scene.show({"box": (mesh, None)})
    outline = scene._solids["box"].outline.GetMapper().GetInput()
    assert outline.GetNumberOfCells() == 0
    scene.set_selection([("box", "a")])  # the two faces across x: eight edges, none of them along x
    cells = vtk_to_numpy(outline.GetLines().GetConnectivityArray()).reshape(-1, 2)
    assert len(cells) == 8
    assert (mesh.edge_points[cells[:, 0], 0] == mesh.edge_points[cells[:, 1], 0]).all()
    scene.set_selection([])
    assert outline.GetNumberOfCells() == 0


def test_adjacency_of_closed_meshes():
    for mesh, edges in ((box(), 18), (ball(32), None)):
        adjacency = Adjacency(mesh)
        assert len(adjacency.edges) == (edges or 3 * len(mesh.triangles) // 2)
        assert (adjacency.sides >= 0).all()
        assert (np.bincount(adjacency.sides.ravel()) == 3).all()
    open_mesh = dataclasses.replace(box(), triangles=box().triangles[:-2], owner=box().owner[:-2])
    assert (Adjacency(open_mesh).sides < 0).sum() == 4
    nothing = dataclasses.replace(box(), triangles=box().triangles[:0], owner=box().owner[:0])
    assert len(Adjacency(nothing).edges) == 0


def test_silhouettes():
    mesh = box()
    adjacency = Adjacency(mesh)
    for eye, count in (((1, 1, 1), 6), ((0, -1, 0.0), 4), ((1, 1, 0.0), 6)):
        assert len(adjacency.silhouette(eye, parallel=True)) == count
    sphere = ball(128, 10.0)
    ring = sphere.points[Adjacency(sphere).silhouette((0.0, 0.0, 20.0))]
    assert len(ring) >= 32
    assert np.allclose(ring[..., 2], 10.0 * 10.0 / 20.0, atol=1.0)  # the polar plane of the eye


def test_visible_bounds(scene):
    assert scene.visible_bounds() is None
    empty = dataclasses.replace(box(), triangles=box().triangles[:0], bounds=np.zeros((2, 3)) + 99.0)
    scene.show({"a": (box((0, 0, 0), (1, 2, 3)), None), "b": (box((-5, 1, 1), (0, 9, 2)), None), "c": (empty, None)})
    assert np.array_equal(scene.visible_bounds(), [[-5, 0, 0], [1, 9, 3]])


def test_styles_looks_and_refusals(scene):
    scene.show({"a": (box(), None)})
    for style in STYLES:
        scene.set_style(style)
        scene.before_render(Camera())
    assert (colours(scene, "a") == bytes_of(LIGHT.plain_background)).all()
    scene.set_style("shaded")
    scene.set_look("dark")
    assert (colours(scene, "a") == bytes_of(DARK.solid)).all()
    for call in (scene.set_style, scene.set_shading, scene.set_look):
        with pytest.raises(ValueError, match="sepia"):
            call("sepia")
    with pytest.raises(ValueError, match="opacity"):
        scene.set_opacity(1.5)
