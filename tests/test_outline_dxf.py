"""Outlines as DXF, read back by ezdxf: layers, units, closed polylines and their areas."""

import ezdxf
import numpy as np
import pytest
from ezdxf.units import MM

from solidtree.model.exchange.outlines_out import NamedOutline, write_outlines
from solidtree.model.script import box, cylinder, section

PLATE = box(40, 20, 5) - cylinder(4, 9, segments=48).at(10, 12, -2)


def signed_area(points):
    x, y = np.array(points).T
    return 0.5 * float(x @ np.roll(y, -1) - y @ np.roll(x, -1))


def test_a_solid_is_a_layer_of_closed_polylines_in_millimetres(tmp_path):
    outline = section(PLATE, (0, 0, 2), (0, 0, 1))
    other = section(box(10).at(60), (0, 0, 2), (0, 0, 1))
    file = tmp_path / "cut.dxf"
    write_outlines(file, [NamedOutline("plate: lid/β", "#ff8000", outline), NamedOutline("box", None, other)])
    drawing = ezdxf.readfile(file)
    assert drawing.units == MM and not drawing.audit().has_errors
    lines = list(drawing.modelspace())
    assert {line.dxftype() for line in lines} == {"LWPOLYLINE"} and all(line.closed for line in lines)
    areas = {}
    for line in lines:
        areas.setdefault(line.dxf.layer, []).append(signed_area(line.get_points("xy")))
    assert set(areas) == {"plate_ lid_β", "box"}
    assert sum(areas["plate_ lid_β"]) == pytest.approx(outline.area, rel=1e-12)
    assert sorted(np.sign(areas["plate_ lid_β"])) == [-1, 1] and areas["box"] == pytest.approx([100.0])
    assert tuple(drawing.layers.get("plate_ lid_β").rgb) == (255, 128, 0)


def test_names_that_dxf_takes_for_the_same_become_layers_of_their_own(tmp_path):
    outline = section(box(10), (0, 0, 2), (0, 0, 1))
    named = [NamedOutline(name, None, outline) for name in ("a/b", "A:B", "0", " ")]
    write_outlines(tmp_path / "cut.dxf", named)
    layers = {line.dxf.layer for line in ezdxf.readfile(tmp_path / "cut.dxf").modelspace()}
    assert len(layers) == 4 and "0" not in layers
