"""The command line as programs use it: the answer on standard output, one line of words on standard error, a status."""

import json
import math
import subprocess
import sys
import zipfile

import numpy as np
import pytest

from solidtree.model.script import (
    box,
    cylinder,
    halfspace,
    linear_array,
    open_document,
    parameter,
    save,
    sphere,
)


def process(*words):
    return subprocess.run([sys.executable, "-m", "solidtree.gui.command_line", *map(str, words)],
                          capture_output=True, text=True, timeout=60)  # fmt: skip


@pytest.fixture
def dumbbell(tmp_path):
    body = sphere(10).at(-20) + sphere(10).at(20) + cylinder(radius=4, height=40).turned(y=90).at(-20)
    save(tmp_path / "dumbbell.solidtree", dumbbell=body & halfspace(normal=(0, 0, 1), point=(0, 0, -7)))
    return tmp_path / "dumbbell.solidtree"


def dumbbell_formulae():
    """Volume and area of the dumbbell: two balls less caps of height 3, a bar between them less its ends in the balls.

    The bar meets a ball in a circle of radius 4 at a = sqrt(100 - 16) from its centre; within a ball lies the bar's
    part up to there and the ball's cap behind it.
    """
    r, s, height, a = 10, 4, 3, math.sqrt(100 - 16)
    cap_volume, cap_area = math.pi * height**2 * (3 * r - height) / 3, 2 * math.pi * r * height
    foot = math.pi * (r**2 - (r - height) ** 2)
    bump = math.pi * (r - a) ** 2 * (3 * r - (r - a)) / 3
    bump_area = 2 * math.pi * r * (r - a)
    # The bar is 40 long from centre to centre: 2 a of it lies within the balls.
    volume = 2 * (4 / 3 * math.pi * r**3 - cap_volume) + math.pi * s**2 * (40 - 2 * a) - 2 * bump
    area = 2 * (4 * math.pi * r**2 - cap_area + foot - bump_area) + 2 * math.pi * s * (40 - 2 * a)
    return volume, area


def test_info_of_the_dumbbell_converges_to_the_formula(solidtree, dumbbell):
    volume, area = dumbbell_formulae()
    errors = []
    for tolerance in (0.2, 0.05, 0.0125):
        status, out, err = solidtree("info", dumbbell, "--tolerance", tolerance)
        (solid,) = json.loads(out)["solids"]
        assert status == 0 and err == "" and solid["genus"] == 0 and solid["components"] == 1 and solid["closed"]
        # No surface is farther from the true one than the tolerance.
        assert abs(solid["volume"] - volume) <= tolerance * area
        errors.append((abs(solid["volume"] - volume) / volume, abs(solid["area"] - area) / area))
    assert np.all(np.array(errors[1]) < np.array(errors[0]) / 2)
    assert np.all(np.array(errors[2]) < np.array(errors[1]) / 2)


def test_info_has_every_key_that_programs_rely_on(solidtree, tmp_path):
    save(tmp_path / "two.solidtree", a=box(2), b=box(3).at(1), hidden=box(1).at(50).hidden())
    status, out, _ = solidtree("info", tmp_path / "two.solidtree")
    answer = json.loads(out)
    assert status == 0 and set(answer) == {"solids", "total", "profiles", "warnings"}
    keys = {"volume", "area", "bounds", "centroid", "triangles", "components", "genus", "closed", "inertia"}
    keys |= {"principal_moments"}
    assert [set(solid) for solid in answer["solids"]] == [keys | {"name"}] * 3 and set(answer["total"]) == keys
    assert answer["total"]["volume"] == pytest.approx(8 + 27 - 4) and answer["total"]["bounds"] == [
        [0, 0, 0],
        [4, 3, 3],
    ]


def test_info_measures_every_node_where_it_stands(solidtree, tmp_path):
    holes = linear_array(cylinder(1, 9, segments=4).named("hole").at(2, 2, -1), 2, (5, 0, 0)).named("holes")
    save(tmp_path / "plate.solidtree", plate=(box(10, 4, 3) - holes).at(100), endless=halfspace())
    status, out, _ = solidtree("info", tmp_path / "plate.solidtree", "--nodes")
    answer = json.loads(out)
    assert status == 1
    rows = {row["name"]: row for row in answer["nodes"]}
    assert list(rows) == ["plate", "Box", "holes", "hole", "endless"]
    assert rows["hole"]["path"] == ["plate", "holes", 0, "hole"] and rows["hole"]["volume"] == pytest.approx(18)
    assert rows["hole"]["centroid"] == pytest.approx([102, 2, 3.5])
    assert rows["holes"]["volume"] == pytest.approx(36) and rows["Box"]["bounds"] == [[100, 0, 0], [110, 4, 3]]
    assert rows["plate"]["volume"] == pytest.approx(120 - 12) and rows["endless"]["volume"] is None


def test_info_estimates_the_least_wall(solidtree, tmp_path):
    save(tmp_path / "tray.solidtree", tray=box(20) - box(16, 16, 20).at(2, 2, 1.5), endless=halfspace())
    answer = json.loads(solidtree("info", tmp_path / "tray.solidtree", "--walls")[1])
    tray, endless = answer["solids"]
    assert tray["thinnest_wall"]["length"] == pytest.approx(1.5, abs=1e-9) and tray["thinnest_wall"]["rays"] == 2000
    assert endless["thinnest_wall"] is None


def test_info_tells_what_failed_and_what_is_empty(solidtree, tmp_path):
    save(tmp_path / "bad.solidtree", good=box(1), endless=halfspace(), nothing=box(1) & box(1).at(5))
    status, out, err = solidtree("info", tmp_path / "bad.solidtree")
    answer = json.loads(out)
    good, endless, nothing = answer["solids"]
    assert status == 1 and err == ""
    assert good["volume"] == pytest.approx(1)
    assert endless["volume"] is None and endless["closed"] is False
    assert nothing["volume"] == 0 and nothing["bounds"] is None
    assert {warning["node"] for warning in answer["warnings"]} == {"endless", "nothing"}


def test_a_point_may_begin_with_a_minus(solidtree, tmp_path):
    save(tmp_path / "block.solidtree", block=box(10))
    status, out, err = solidtree("ray", tmp_path / "block.solidtree", "--origin", "-5,5,5", "--direction", "1,0,0")
    assert (status, err) == (0, "") and json.loads(out)["hit"]["distance"] == pytest.approx(5)
    status, out, err = solidtree("ray", tmp_path / "block.solidtree", "--from", "-.5,5,5", "--to", "-1e1,5,5")
    assert (status, err) == (0, "") and json.loads(out)["sees"] is True


def test_a_picture_of_nothing_says_so(solidtree, tmp_path):
    save(tmp_path / "none.solidtree")
    status, out, err = solidtree("render", tmp_path / "none.solidtree", tmp_path / "none.png")
    assert (status, out) == (1, "") and err.endswith("there is nothing to be seen\n") and err.count("\n") == 1


def test_info_of_an_open_mesh(solidtree, tmp_path):
    (tmp_path / "tent.off").write_text(
        "OFF\n5 4 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n.5 .5 1\n3 0 1 4\n3 1 2 4\n3 2 3 4\n3 3 0 4\n"
    )
    status, out, _ = solidtree("info", tmp_path / "tent.off")
    (solid,) = json.loads(out)["solids"]
    assert status == 1 and solid["volume"] is None and solid["closed"] is False and solid["triangles"] == 4
    assert solid["area"] == pytest.approx(4 * math.hypot(1, 0.5) / 2) and solid["bounds"] == [[0, 0, 0], [1, 1, 1]]


@pytest.mark.parametrize("ending", ["stl", "3mf", "obj", "ply", "off", "glb"])
def test_export_and_back_keeps_the_measures(solidtree, dumbbell, tmp_path, ending):
    out = tmp_path / f"out.{ending}"
    assert solidtree("export", dumbbell, out) == (0, "", "")
    before = json.loads(solidtree("info", dumbbell)[1])["total"]
    after = json.loads(solidtree("info", out)[1])["total"]
    assert after["volume"] == pytest.approx(before["volume"], rel=1e-5)
    assert after["area"] == pytest.approx(before["area"], rel=1e-5)
    assert np.allclose(after["bounds"], before["bounds"], atol=1e-4)
    assert (after["components"], after["genus"], after["closed"]) == (1, 0, True)


def test_export_of_one_solid_and_its_tolerance(solidtree, tmp_path):
    save(tmp_path / "two.solidtree", ball=sphere(10), cube=box(2))
    for tolerance, few in ((1, True), (0.01, False)):
        arguments = ("--solid", "ball", "--tolerance", tolerance)
        assert solidtree("export", tmp_path / "two.solidtree", tmp_path / "ball.stl", *arguments)[0] == 0
        triangles = json.loads(solidtree("info", tmp_path / "ball.stl")[1])["total"]["triangles"]
        assert (triangles < 1000) is few
    for bad in (tmp_path / "x.foo", tmp_path / "nowhere" / "x.stl"):
        status, out, err = solidtree("export", tmp_path / "two.solidtree", bad)
        assert (status, out) == (2, "") and err.startswith(f"solidtree: {bad}: ") and err.count("\n") == 1
    status, out, err = solidtree("export", tmp_path / "two.solidtree", tmp_path / "x.stl", "--solid", "cone")
    assert (status, out) == (2, "") and "“cone”" in err and "“ball”" in err and not (tmp_path / "x.stl").exists()


def test_convert(solidtree, tmp_path):
    save(tmp_path / "cube.stl", box(2))
    assert solidtree("convert", tmp_path / "cube.stl", tmp_path / "cube.obj")[0] == 0
    assert solidtree("convert", tmp_path / "cube.obj", tmp_path / "cube.solidtree")[0] == 0
    assert json.loads(solidtree("info", tmp_path / "cube.solidtree")[1])["total"]["volume"] == pytest.approx(8)


def test_run_gives_a_script_the_names_and_its_arguments(solidtree, tmp_path):
    script = tmp_path / "make.py"
    script.write_text("import sys\nsave(sys.argv[1], cube=box(float(sys.argv[2])) - sphere(1))\n")
    assert solidtree("run", script, tmp_path / "out.solidtree", "5")[0] == 0
    assert open_document(tmp_path / "out.solidtree").solids[0].name == "cube"


@pytest.mark.parametrize(
    ("text", "where"),
    [
        ("x = 1\nbox(-1) @ 3\n", ":2:"),
        ("def f(:\n", ":1:"),
        ("\n\nbox(float('nan'))\n", ":3:"),
        ("raise SystemError", ":1:"),
    ],
)
def test_a_script_that_fails_names_its_own_line(solidtree, tmp_path, text, where):
    script = tmp_path / "bad.py"
    script.write_text(text)
    status, out, err = solidtree("run", script)
    assert (status, out) == (2, "") and err.count("\n") == 1
    assert err.startswith(f"solidtree: {script}{where} ")


@pytest.mark.parametrize(
    "words",
    [
        ("info", "missing.solidtree"),
        ("export", "missing.solidtree", "out.stl"),
        ("render", "missing.solidtree", "out.png"),
        ("run", "missing.py"),
        ("info", "."),
        ("missing.solidtree",),
        ("info",),
        ("frobnicate", "--really"),
        ("info", "a.solidtree", "--tolerance", "nan"),
        ("info", "a.solidtree", "--tolerance", "-1"),
        ("render", "a.solidtree", "b.png", "--size", "0x9"),
        ("render", "a.solidtree", "b.png", "--eye", "1,2"),
        ("--nonsense",),
    ],
)
def test_what_cannot_be_done_is_one_line_and_status_2(solidtree, tmp_path, monkeypatch, words):
    monkeypatch.chdir(tmp_path)
    status, out, err = solidtree(*words)
    assert (status, out) == (2, "")
    assert err.startswith("solidtree") and err.count("\n") == 1 and "Traceback" not in err


def test_files_that_are_not_what_they_say(solidtree, tmp_path):
    for name, data in {
        "page.stl": b"<html><body>not found</body></html>",
        "cut.solidtree": b"PK\x03\x04broken",
        "empty.obj": b"",
        "noise.bin": bytes(range(256)),
        "text.solidtree": b"hello",
    }.items():
        (tmp_path / name).write_bytes(data)
        status, out, err = solidtree("info", tmp_path / name)
        assert (status, out) == (2, "") and err.startswith(f"solidtree: {tmp_path / name}: ") and err.count("\n") == 1


def test_render_shows_what_is_there(solidtree, tmp_path):
    save(tmp_path / "two.solidtree", a=box(10), b=box(4, 10, 10).at(12))
    out = tmp_path / "two.png"
    arguments = ("--size", "260x100", "--view", "top", "--parallel", "--ids")
    assert solidtree("render", tmp_path / "two.solidtree", out, *arguments) == (0, "", "")
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOImage import vtkPNGReader

    reader = vtkPNGReader()
    reader.SetFileName(str(out))
    reader.Update()
    image = reader.GetOutput()
    pixels = vtk_to_numpy(image.GetPointData().GetScalars()).reshape(
        image.GetDimensions()[1], image.GetDimensions()[0], -1
    )
    numbers = pixels[..., :3].astype(int) @ (65536, 256, 1)
    assert numbers.shape == (100, 260) and set(np.unique(numbers)) == {0, 1, 2}
    first, second = (numbers == 1).sum(), (numbers == 2).sum()
    assert first / second == pytest.approx(10 / 4, rel=0.05)


def test_render_colours_by_node(solidtree, tmp_path):
    from PySide6.QtGui import QColor, QImage

    save(tmp_path / "two.solidtree", a=box(10).coloured("red") + box(10).at(12).coloured("red"))
    hues = {}
    for colours in ("own", "nodes"):
        out = tmp_path / f"{colours}.png"
        arguments = ("--size", "220x100", "--view", "top", "--parallel", "--colours", colours)
        assert solidtree("render", tmp_path / "two.solidtree", out, *arguments) == (0, "", "")
        hues[colours] = [QImage(str(out)).pixelColor(x, 50).hue() for x in (60, 160)]
    assert hues["own"] == [0, 0]
    # The union is n1, its operands n2 and n3.
    from solidtree.model.document.distinct_colours import distinct_colour

    assert hues["nodes"] == pytest.approx([QColor(distinct_colour(i)).hue() for i in ("n2", "n3")], abs=4)


def test_render_of_nothing_is_not_in_order(solidtree, tmp_path):
    save(tmp_path / "none.solidtree", none=box(1) & box(1).at(5))
    assert solidtree("render", tmp_path / "none.solidtree", tmp_path / "none.png", "--size", "20x20")[0] == 1
    status, _, err = solidtree("render", tmp_path / "none.solidtree", tmp_path / "none.gif")
    assert status == 2 and "none.gif" in err and ".png" in err


def test_measuring_a_project_loads_neither_qt_nor_vtk_nor_trimesh(dumbbell):
    code = """
import sys
import zipfile
from solidtree.gui.command_line import main
status = main(["info", sys.argv[1]])
heavy = ("PySide6", "vtkmodules", "pyvista", "trimesh", "scipy")
print([name for name in heavy if name in sys.modules], file=sys.stderr)
sys.exit(status)
"""
    done = subprocess.run([sys.executable, "-c", code, str(dumbbell)], capture_output=True, text=True, timeout=60)
    assert done.returncode == 0 and done.stderr.strip() == "[]"


def test_a_pipe_that_closes_early_is_no_error(dumbbell):
    done = subprocess.run(f"{sys.executable} -m solidtree.gui.command_line info {dumbbell} | head -c 1",
                          shell=True, capture_output=True, text=True, timeout=60)  # fmt: skip
    assert done.stdout == "{" and done.stderr == ""


def test_parameters_reach_the_answer(solidtree, tmp_path):
    width = parameter("width", 4, minimum=1)
    save(tmp_path / "p.solidtree", block=box(width, width / 2, 3))
    assert json.loads(solidtree("info", tmp_path / "p.solidtree")[1])["total"]["volume"] == pytest.approx(24)


def test_help_at_every_level():
    for words in (("--help",), ("info", "--help"), ("render", "--help")):
        done = process(*words)
        assert done.returncode == 0 and "usage" in done.stdout and done.stderr == ""


def test_export_leaves_out_a_hidden_solid_of_the_same_name(solidtree, tmp_path):
    table = {
        "format": 1,
        "nodes": {"n1": {"kind": "Sphere", "name": "a", "visible": False}, "n2": {"kind": "Box", "name": "a"}},
        "solids": ["n1", "n2"],
    }
    with zipfile.ZipFile(tmp_path / "twins.solidtree", "w") as archive:
        archive.writestr("document.json", json.dumps(table))
    assert solidtree("export", tmp_path / "twins.solidtree", tmp_path / "out.obj")[0] == 0
    assert json.loads(solidtree("info", tmp_path / "out.obj")[1])["total"]["volume"] == pytest.approx(8000)


def test_a_parameter_that_is_missing_is_named_by_export(solidtree, tmp_path):
    table = {"format": 1, "nodes": {"n1": {"kind": "Sphere", "radius": "=w"}}, "solids": ["n1"]}
    with zipfile.ZipFile(tmp_path / "lost.solidtree", "w") as archive:
        archive.writestr("document.json", json.dumps(table))
    status, _, err = solidtree("export", tmp_path / "lost.solidtree", tmp_path / "out.obj")
    assert status == 2 and "no parameter called w" in err


def test_huge_numbers_are_told_in_one_line(solidtree, tmp_path):
    save(tmp_path / "huge.solidtree", a=sphere(1e300))
    status, out, err = solidtree("info", tmp_path / "huge.solidtree")
    assert status == 1 and err == "" and json.loads(out)["solids"][0]["volume"] is None
