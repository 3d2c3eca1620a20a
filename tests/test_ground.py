"""The ground's grid: its step, its place, and that it counts for nothing."""

import dataclasses

import numpy as np
import pytest
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkRenderingCore import vtkRenderer

from solidtree.render.camera import Camera, pan, zoom
from solidtree.render.ground import Ground, major_every, step_for
from solidtree.render.look import DARK


def drawn(ground: Ground) -> np.ndarray:
    return vtk_to_numpy(ground.actor.GetMapper().GetInput().GetPoints().GetData())


def test_steps_are_1_2_5_and_never_too_dense():
    assert [step_for(height) for height in (40, 41, 80, 100, 200, 201, 400)] == [1, 2, 2, 5, 5, 10, 10]
    for height in np.geomspace(1e-3, 1e6, 200):
        step = step_for(float(height))
        assert 16 - 1e-6 <= height / step <= 40 + 1e-6
        leading = step / 10.0 ** np.floor(np.log10(step) + 1e-9)
        assert min(abs(leading - digit) for digit in (1, 2, 5)) < 1e-6
    assert [major_every(step) * step for step in (0.1, 0.2, 0.5, 1, 2, 5, 10)] == [1, 1, 5, 10, 10, 50, 100]


def test_it_is_drawn_on_z_0_about_the_target_and_only_when_it_changes():
    ground = Ground(vtkRenderer())
    camera = Camera((0.0, -80.0, 60.0), (0.0, 0.0, 0.0))
    ground.update(camera)
    points, first = drawn(ground), ground.actor.GetMapper().GetInput()
    rising = points[points[:, 2] != 0.0]
    assert (rising[:, :2] == 0.0).all() and (rising[:, 2] > 0.0).all()  # the z axis alone leaves the plane
    ground.update(pan(camera, 3.0, 2.0, (640, 480)))
    assert ground.actor.GetMapper().GetInput() is first
    ground.update(zoom(camera, 4.0))
    assert ground.actor.GetMapper().GetInput() is not first
    assert np.ptp(drawn(ground), axis=0)[0] < 0.6 * np.ptp(points, axis=0)[0]
    far = dataclasses.replace(camera, position=(1000.0, 920.0, 60.0), target=(1000.0, 1000.0, 0.0))
    ground.update(far)
    assert np.allclose(drawn(ground)[:-30, :2].mean(axis=0), (1000.0, 1000.0), atol=20.0)


def test_it_keeps_to_the_far_side_of_faces_on_the_ground():
    ground = Ground(vtkRenderer())
    for height, sign in ((50.0, -1), (-50.0, 1)):
        ground.update(Camera((0.0, -80.0, height)))
        z = ground.actor.GetPosition()[2]
        assert np.sign(z) == sign and abs(z) < 0.1


def test_it_does_not_count_for_bounds_nor_picking():
    renderer = vtkRenderer()
    ground = Ground(renderer)
    ground.update(Camera())
    bounds = renderer.ComputeVisiblePropBounds()
    assert bounds[0] > bounds[1]  # VTK's way to say none
    assert not ground.actor.GetPickable()


def test_off_and_dark():
    ground = Ground(vtkRenderer())
    assert ground.bounds is None
    ground.update(Camera())
    assert ground.bounds is not None
    before = ground.actor.GetMapper().GetInput()
    ground.set_look(DARK)
    ground.update(Camera())
    assert ground.actor.GetMapper().GetInput() is not before
    ground.set_visible(False)
    assert ground.bounds is None and not ground.visible


@pytest.mark.parametrize("eye", [(0.0, -50.0, 0.0), (0.0, 0.0, 50.0), (30.0, 30.0, -1e-9)])
def test_any_direction_will_do(eye):
    ground = Ground(vtkRenderer())
    ground.update(Camera(eye, (0.0, 0.0, 0.0)))
    assert np.isfinite(drawn(ground)).all()
