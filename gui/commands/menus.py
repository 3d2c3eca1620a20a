"""The menu bar: the table of commands, and the submenus whose entries are files and docks."""

from __future__ import annotations

from importlib.resources import as_file, files
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtWidgets import QMenu

from ... import resources
from ..icons import icon
from .arrange import ARRANGE_SEPARATORS

if TYPE_CHECKING:
    from ..window import MainWindow

PROJECT = ".solidtree"


def fill_menus(window: MainWindow) -> None:
    menus = window.actions_.fill_menu_bar(window.menuBar())
    file_menu = menus["File"]
    after = window.actions_["save"]
    recent = QMenu("Open recent", file_menu)
    recent.setToolTipsVisible(True)
    recent.aboutToShow.connect(lambda: _fill_recent(window, recent))
    examples = QMenu("Examples", file_menu)
    examples.setIcon(icon("examples"))
    examples.aboutToShow.connect(lambda: _fill_examples(window, examples))
    file_menu.insertMenu(after, recent)
    file_menu.insertMenu(after, examples)
    for name in ("save", "import", "quit"):
        file_menu.insertSeparator(window.actions_[name])
    for name in ("delete", "rename", "evaluate"):
        menus["Edit"].insertSeparator(window.actions_[name])
    for name in ("view_iso", "perspective"):
        menus["View"].insertSeparator(window.actions_[name])
    menus["Combine"].insertSeparator(window.actions_["linear_array"])
    menus["Help"].insertSeparator(window.actions_["about"])
    for name in ARRANGE_SEPARATORS:
        menus["Tools/Arrange"].insertSeparator(window.actions_[name])
    panels = menus["View"].addMenu("Panels")
    panels.aboutToShow.connect(lambda: panels.addActions(window.docks_menu_entries))


def _fill_recent(window: MainWindow, menu: QMenu) -> None:
    menu.clear()
    for path in window.settings.recent:
        action = menu.addAction(Path(path).name, lambda path=path: window.files.open(path))
        action.setToolTip(path)
    if menu.isEmpty():
        menu.addAction("None yet").setEnabled(False)
        return
    menu.addSeparator()
    menu.addAction("Forget all", lambda: (window.settings.forget_recent(), window.files.path_changed.emit()))


def example_names() -> list[str]:
    folder = files(resources).joinpath("examples")
    return sorted(file.name.removesuffix(PROJECT) for file in folder.iterdir() if file.name.endswith(PROJECT))


def open_example(window: MainWindow, name: str) -> None:
    """Open an example as an unsaved document."""
    with as_file(files(resources).joinpath("examples", name + PROJECT)) as path:
        kept = Path(path)
    window.files.guard(lambda: window.files.read(kept, example=True))


def _fill_examples(window: MainWindow, menu: QMenu) -> None:
    menu.clear()
    for name in example_names():
        menu.addAction(name.replace("_", " ").capitalize(), lambda name=name: open_example(window, name))
    if menu.isEmpty():
        menu.addAction("None").setEnabled(False)
