"""What the palette can find: commands, nodes, parameters, recent files and examples."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtGui import QIcon, QKeySequence

from ...model.document.nodes import Node
from ...model.document.tree import walk
from ..commands.menus import example_names, open_example
from ..commands.parameters import show_parameter
from ..icons import icon, kind_icon
from ..panels.number_field import text_of
from .fuzzy import match

if TYPE_CHECKING:
    from ..window import MainWindow

MOST = 40  # nodes shown at a time
RECENT = 6
WHOLE, BEGINNING = 80.0, 120.0  # what a word scores at least that stands in a text, or begins a word; see fuzzy.py
FEW = 2000  # nodes among which single letters are looked for


@dataclass(frozen=True, slots=True)
class Entry:
    """One row. `places` are the letters of the title that were found; `fault` tells why it cannot be run now."""

    title: str
    detail: str = ""
    keys: str = ""
    fault: str = ""
    picture: QIcon | None = None
    tip: str = ""
    places: tuple[int, ...] = ()
    run: Callable[[], None] | None = None
    command: str = ""


def heading(title: str) -> Entry:
    """A row that cannot be chosen."""
    return Entry(title)


def entries(window: MainWindow, text: str) -> list[Entry]:
    """What the letters in the palette's field find, best first; `@` asks for nodes alone."""
    if text.startswith("@"):
        return _under("Nodes", _nodes(window, text[1:].strip()))
    text = text.strip()
    if not text:
        return _all_commands(window)
    named, described, scattered = _commands(window, text)
    others = _under("Parameters", _parameters(window, text))
    others += _under("Nodes", _nodes(window, text)) if len(text) > 1 else []
    others += _under("Files", _files(window, text))
    found = [*named, *others]
    found += _under("By menu and description", described) if found else described
    return found + (_under("By single letters", scattered) if found else scattered)


def _under(title: str, found: list[Entry]) -> list[Entry]:
    return [heading(title), *found] if found else []


def _command(window: MainWindow, name: str, menu: str, tip: str, places: tuple[int, ...] = ()) -> Entry:
    action = window.actions_[name]
    keys = action.shortcut().toString(QKeySequence.SequenceFormat.NativeText)
    fault = window.actions_.fault(name) or ""
    return Entry(action.text(), menu, keys, fault, action.icon(), tip, places, lambda: window.actions_.run(name), name)


def _all_commands(window: MainWindow) -> list[Entry]:
    """Those run last from here, then all that can be used now, then the others."""
    commands = {c.name: c for c in window.actions_.commands() if c.name != "palette"}
    recent = [name for name in window.settings.recent_commands if name in commands][:RECENT]
    made = {name: _command(window, name, _menu(c.menu), c.tip) for name, c in commands.items()}
    rest = [entry for name, entry in made.items() if name not in recent]
    usable, greyed = ([e for e in rest if bool(e.fault) is wanted] for wanted in (False, True))
    if not recent:
        return [*usable, *greyed]
    return [heading("Recently used"), *(made[name] for name in recent), heading("All commands"), *usable, *greyed]


def _commands(window: MainWindow, text: str) -> tuple[list[Entry], list[Entry], list[Entry]]:
    """Those whose title holds the words, those whose menu or description does, and those with the letters alone."""
    found: tuple[list[tuple[float, Entry]], ...] = ([], [], [])
    words = len(text.split())
    for command in window.actions_.commands():
        if command.name == "palette":
            continue
        title, menu = window.actions_[command.name].text(), _menu(command.menu)
        by_title = match(text, title)
        one = by_title
        if by_title is None or by_title.score <= WHOLE * words:
            by_tip = match(text, f"{title} {menu} {command.tip}")
            one = by_tip if by_tip is not None and by_tip.score > BEGINNING * words else by_title
        if one is None:
            continue
        kind = 1 if one is not by_title else 0 if one.score > WHOLE * words else 2
        places = tuple(at for at in one.places if at < len(title))
        entry = _command(window, command.name, menu, command.tip, places)
        found[kind].append((-one.score + (30.0 if entry.fault else 0.0), entry))
    named, described, scattered = ([e for _, e in sorted(kind, key=lambda one: one[0])] for kind in found)
    return named, described, scattered


def _menu(place: str) -> str:
    return place.replace("/", " › ")  # noqa: RUF001


def _nodes(window: MainWindow, text: str) -> list[Entry]:
    """Labels that hold the words whole; the slower search for single letters only where these are few."""
    session = window.session
    nodes = list(walk(*session.document.roots))
    words = text.lower().split()
    labels = [node.label.lower() for node in nodes]
    held = [place for place, label in enumerate(labels) if all(word in label for word in words)]
    if len(held) > MOST:  # those that begin with it, and short ones, are the likelier ones
        held = sorted(held, key=lambda at: (not labels[at].startswith(tuple(words[:1])), len(labels[at])))[: 4 * MOST]
    elif not held and len(nodes) <= FEW:
        held = list(range(len(nodes)))
    matches = ((match(text, nodes[place].label), place) for place in held)
    best = sorted((-one.score, place, one.places) for one, place in matches if one is not None)[:MOST]

    def entry(node: Node, places: tuple[int, ...]) -> Entry:
        detail = node.title if node.label != node.title else ""
        return Entry(node.label, detail, node.id, "", kind_icon(type(node)), "Select this node", places,
                     lambda: session.select([node.id]))  # fmt: skip

    return [entry(nodes[place], places) for _, place, places in best]


def _parameters(window: MainWindow, text: str) -> list[Entry]:
    found: list[tuple[float, Entry]] = []
    for p in window.session.document.parameters:
        by_name = match(text, p.name)
        by_note = None if by_name else match(text, f"{p.name} {p.note}")
        if by_name is None and (by_note is None or by_note.score < 80.0):
            continue
        one = Entry(p.name, p.note, text_of(p.value), "", icon("parameter"), "Turn this parameter",
                    by_name.places if by_name else (), lambda name=p.name: show_parameter(window, name))  # fmt: skip
        found.append((-(by_name or by_note).score, one))  # type: ignore[union-attr]
    return [entry for _, entry in sorted(found, key=lambda one: one[0])]


def _files(window: MainWindow, text: str) -> list[Entry]:
    found: list[tuple[float, Entry]] = []
    for path in window.settings.recent:
        one = match(text, Path(path).name)
        if one is not None and one.score > 90.0:
            found.append((-one.score, Entry(Path(path).name, str(Path(path).parent), "", "", icon("open"), path,
                                            one.places, lambda path=path: window.files.open(path))))  # fmt: skip
    for name in example_names():
        title = name.replace("_", " ").capitalize()
        one = match(text, f"{title} example")
        if one is not None and one.score > 90.0:
            places = tuple(at for at in one.places if at < len(title))
            found.append((-one.score, Entry(title, "Example", "", "", icon("examples"), "Open this example", places,
                                            lambda name=name: open_example(window, name))))  # fmt: skip
    return [entry for _, entry in sorted(found, key=lambda one: one[0])]
