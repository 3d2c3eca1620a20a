"""The layers, the list of packages, the wheel's content and what an import may load."""

import ast
import shutil
import subprocess
import sys
import tomllib
import zipfile
from itertools import chain
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
LAYERS = ("gui", "model", "render", "resources")
QT = {"PySide6", "shiboken6", "qtpy", "PyQt6", "qtconsole", "pytestqt"}
VTK = {"vtk", "vtkmodules", "pyvista", "pyvistaqt"}
FOREIGN = {"gui": set(), "model": QT | VTK, "render": QT, "resources": QT | VTK}
BELOW = {
    "gui": {"gui", "render", "model", "resources"},
    "render": {"render", "model", "resources"},
    "model": {"model", "resources"},
    "resources": {"resources"},
}
EMPTY_NAMES = {"utils", "util", "helpers", "helper", "common", "base", "manager", "core", "misc"}

# What bsp.cpp becomes where there is a compiler.
BINARIES = (".so", ".pyd")

# Scripts for people: shipped as data, written like tests.
SCRIPTS = ROOT / "resources" / "examples"


def sources() -> list[Path]:
    files = chain.from_iterable((ROOT / layer).rglob("*.py") for layer in LAYERS)
    return sorted(path for path in files if SCRIPTS not in path.parents)


def settings() -> dict:
    return tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["tool"]["setuptools"]


def imports(text: str, package: tuple[str, ...]) -> list[tuple[int, int, str]]:
    """Every import as (line, level, dotted name), relative ones resolved from `package`, as `("model", "mesh")`."""
    found: list[tuple[int, int, str]] = []
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Import):
            found += [(node.lineno, 0, alias.name) for alias in node.names]
        elif isinstance(node, ast.ImportFrom) and node.level == 0:
            found.append((node.lineno, 0, node.module or ""))
        elif isinstance(node, ast.ImportFrom):
            above = package[: len(package) + 1 - node.level]
            names = [node.module] if node.module else [alias.name for alias in node.names]
            found += [(node.lineno, node.level, ".".join((*above, name))) for name in names]
    return found


def breaches(text: str, package: tuple[str, ...]) -> list[str]:
    layer = package[0]
    wrong = []
    for line, level, name in imports(text, package):
        top = name.split(".")[0]
        if (level and top not in BELOW[layer]) or (not level and top in FOREIGN[layer]):
            wrong.append(f"{line}: {layer} imports {name}")
        elif not level and top == "solidtree":
            wrong.append(f"{line}: imports inside the packages are relative, not {name}")
        elif not level and top in (*LAYERS, "tests"):
            wrong.append(f"{line}: there is no top-level package {top}")
    return wrong


def test_each_layer_imports_only_what_stands_below_it():
    wrong = []
    for path in sources():
        place = path.relative_to(ROOT)
        wrong += [f"{place}:{breach}" for breach in breaches(path.read_text(encoding="utf-8"), place.parent.parts)]
    assert not wrong, "\n".join(wrong)


@pytest.mark.parametrize(
    ("text", "package"),
    [
        ("from PySide6.QtCore import Qt", ("model",)),
        ("def show():\n    import pyvista", ("model", "document")),
        ("from vtkmodules.vtkCommonCore import vtkPoints", ("model",)),
        ("from ..render import scene", ("model",)),
        ("from ...gui.window import Window", ("model", "mesh")),
        ("from .. import gui", ("render",)),
        ("import shiboken6", ("render",)),
        ("from solidtree.model.script import box", ("gui",)),
        ("import model.script", ("gui",)),
    ],
)
def test_a_planted_breach_is_seen(text, package):
    assert len(breaches(text, package)) == 1


@pytest.mark.parametrize(
    ("text", "package"),
    [
        ("from PySide6.QtCore import Qt", ("gui",)),
        ("from vtkmodules.vtkCommonCore import vtkPoints", ("render",)),
        ("from ..model.document import nodes", ("render",)),
        ("from ..document.nodes import Box\nfrom . import tree", ("model", "solid")),
        ("from ...model.document import nodes", ("gui", "inspectors")),
    ],
)
def test_a_permitted_import_passes(text, package):
    assert breaches(text, package) == []


def test_the_package_list_names_every_folder_with_python_files():
    folders = {"solidtree." + ".".join(path.parent.relative_to(ROOT).parts) for path in sources()}
    assert set(settings()["packages"]) == folders
    assert settings()["package-dir"] == {f"solidtree.{layer}": layer for layer in LAYERS}


def test_every_package_says_what_it_is_and_every_layer_is_typed():
    for folder in sorted({path.parent for path in sources()}):
        text = (folder / "__init__.py").read_text(encoding="utf-8")
        assert ast.get_docstring(ast.parse(text)), folder
    for layer in LAYERS:
        assert (ROOT / layer / "py.typed").is_file()


def test_no_file_has_a_name_that_says_nothing():
    named = [*sources(), *(ROOT / "tests").rglob("*.py"), *(ROOT / "bench").rglob("*.py")]
    words = {path: {path.stem, path.parent.name} for path in named}
    assert not [str(path.relative_to(ROOT)) for path, names in words.items() if names & EMPTY_NAMES]


def test_the_wheel_holds_every_file_of_the_packages_and_nothing_else(tmp_path):
    copy = tmp_path / "source"
    copy.mkdir()
    for name in ("pyproject.toml", "README.md", "LICENSE"):
        shutil.copy(ROOT / name, copy)
    for layer in LAYERS:
        shutil.copytree(
            ROOT / layer,
            copy / layer,
            ignore=shutil.ignore_patterns("__pycache__", *(f"*{suffix}" for suffix in BINARIES)),
        )
    (copy / "stray.py").touch()
    (copy / "bench").mkdir()
    (copy / "bench" / "stray.py").touch()

    pip = [sys.executable, "-m", "pip", "--disable-pip-version-check", "wheel", "--quiet", "--no-index", "--no-deps"]
    built = subprocess.run(
        [*pip, "--no-build-isolation", "-w", tmp_path, copy], capture_output=True, text=True, check=False
    )
    assert built.returncode == 0, built.stderr

    (wheel,) = tmp_path.glob("*.whl")
    with zipfile.ZipFile(wheel) as archive:
        names = {name for name in archive.namelist() if ".dist-info/" not in name}
    files = chain.from_iterable((ROOT / layer).rglob("*") for layer in LAYERS)
    expected = {
        "solidtree/" + path.relative_to(ROOT).as_posix()
        for path in files
        if path.is_file() and "__pycache__" not in path.parts and path.suffix not in (".cpp", ".h", *BINARIES)
    }
    compiled = {name for name in names if Path(name).suffix in BINARIES}
    assert names - compiled == expected
    # Built here by the same compiler, or by none.
    there = [path.name for path in (ROOT / "model" / "partition").glob("bsp.*") if path.suffix in BINARIES]
    assert compiled == {f"solidtree/model/partition/{name}" for name in there}


def loaded_by(statement: str, suspects: set[str]) -> set[str]:
    """Which of the suspects a fresh process has loaded after the statement."""
    code = f"{statement}\nimport sys\nprint(*(set({sorted(suspects)}) & sys.modules.keys()))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return set(done.stdout.split())


def test_the_script_api_loads_no_heavy_library():
    suspects = {"PySide6", "vtkmodules", "pyvista", "trimesh", "scipy", "matplotlib", "PIL", "networkx", "lxml"}
    assert loaded_by("import solidtree.model.script", suspects) == set()


@pytest.mark.parametrize("module", ["solidtree.gui", "solidtree.gui.command_line"])
def test_the_command_line_loads_neither_qt_nor_vtk(module):
    assert loaded_by(f"import {module}", {"PySide6", "shiboken6", "vtkmodules", "pyvista", "trimesh"}) == set()
