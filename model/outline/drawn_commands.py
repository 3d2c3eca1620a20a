"""Paths as scripts write them: commands, or the text of an SVG path."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

from ..document.errors import Refusal

LETTERS = {"move": ("M", 1), "line": ("L", 1), "quad": ("Q", 2), "cubic": ("C", 3)}


def fields_of_commands(drawn: str | Iterable[Sequence[Any]]) -> dict[str, Any]:
    """`points` and `segments` of a Path node: from commands ("move", p), ("line", p), ("quad", c, p),
    ("cubic", c1, c2, p) and ("close",), whose numbers may be expressions, or from the text of an SVG path.

    Raises Refusal with the number of the command at fault.
    """
    if isinstance(drawn, str):
        from ..exchange.drawings.svg_path import path_commands

        drawn = path_commands(drawn)
    letters: list[str] = []
    points: list[tuple[Any, ...]] = []
    start: tuple[Any, ...] | None = None
    for number, command in enumerate(drawn):
        name, *given = command if not isinstance(command, str) and len(command) else (command,)
        name = str(name)
        if name == "close":
            if start is None or letters[-1] == "M":
                raise Refusal(f"command {number} of the path, “close”, has nothing to close")
            if points[-1] == start and letters[-1] != "L" and letters[-1].isupper():
                letters[-1] = letters[-1].lower()
                points.pop()
            elif points[-1] == start and letters[-1] == "L" and letters[-2] != "M":
                letters[-1] = "l"
                points.pop()
            else:
                letters.append("l")
            continue
        if name not in LETTERS:
            raise Refusal(
                f"command {number} of the path is “{name!s:.40}”; there are move, line, quad, cubic and close"
            )
        letter, count = LETTERS[name]
        if len(given) != count:
            raise Refusal(f"command {number} of the path, “{name}”, needs {count} point{'s' * (count > 1)}")
        if letter == "M":
            start = tuple(given[0])
        elif start is None:
            raise Refusal(f"command {number} of the path, “{name}”, has no point to begin at: put a “move” before it")
        elif letters[-1].islower():
            letters.append("M")
            points.append(start)
        letters.append(letter)
        points += [tuple(point) for point in given]
    return {"points": tuple(points), "segments": "".join(letters)}
