"""The command line. Standard output carries only the answer; messages and progress go to standard error."""

from __future__ import annotations

import argparse
import os
import re
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, NoReturn

from ..model.document.document import Document
from ..model.document.errors import Refusal

DONE, NOT_IN_ORDER, REFUSED = 0, 1, 2
TOLERANCE = 0.05


class _Parser(argparse.ArgumentParser):
    """Says what is wrong in one line."""

    def error(self, message: str) -> NoReturn:
        print(f"{self.prog}: {message}; see {self.prog} --help", file=sys.stderr)
        raise SystemExit(REFUSED)


def main(arguments: Sequence[str] | None = None) -> int:
    """Run one command, or the window where none is named; the result is the exit status."""
    words = list(sys.argv[1:] if arguments is None else arguments)
    parser = _command_parser()
    if not words or (words[0] not in _COMMANDS and not words[0].startswith("-")):
        return _window(words)
    options = parser.parse_args(words if words[0] == "run" else _joined(words))
    return _guarded(options.run, options)


def _joined(words: Sequence[str]) -> list[str]:
    """`--eye -1,2,3` as `--eye=-1,2,3`: argparse would take the point, because of its minus, for an option."""
    joined: list[str] = []
    for word in words:
        if joined and re.fullmatch(r"--[a-z-]+", joined[-1]) and re.fullmatch(r"-[\d.][^,]*,.*", word):
            joined[-1] += f"={word}"
        else:
            joined.append(word)
    return joined


def _guarded(run: Callable[[argparse.Namespace], int], options: argparse.Namespace) -> int:
    """Run a command; whatever goes wrong becomes one line and a status."""
    about = getattr(options, "file", "") or ""
    try:
        return run(options)
    except Refusal as refusal:
        return complain(about, str(refusal))
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return DONE
    except KeyboardInterrupt:
        return complain(about, "interrupted")
    except MemoryError:
        return complain(about, "there is not enough memory for this")
    except OSError as error:
        from ..model.project.disk import reason_of

        return complain(error.filename or about, reason_of(error))


def complain(about: object, reason: str) -> int:
    """Say why nothing was done, in one line; the result is the status."""
    reason = " ".join(reason.split())
    print(f"solidtree: {about}: {reason}" if about else f"solidtree: {reason}", file=sys.stderr)
    return REFUSED


def warn(about: object, words: str) -> None:
    """Say something that does not keep the command from being done."""
    print(f"solidtree: {about}: {words}", file=sys.stderr)


def naming(file: str, act: Callable[[], object]) -> None:
    """Do something about another file than the first; what is refused names it."""
    try:
        act()
    except Refusal as refusal:
        raise SystemExit(complain(file, str(refusal))) from None


def _window(files: list[str]) -> int:
    for file in files:
        if not Path(file).is_file():
            return complain(file, "there is no such file")
    from .application import run

    return run(files)


def _command_parser() -> argparse.ArgumentParser:
    parser = _Parser(
        prog="solidtree",
        description="A modeller in which a solid is a tree. Without a command: solidtree [FILE ...] opens the window.",
    )
    parser.add_argument(
        "--version", action=_Version, nargs=0, help="the version, and which BSP builder is in use, then exit"
    )
    commands = parser.add_subparsers(metavar="COMMAND", required=True, parser_class=_Parser)
    for name, (build, run, what) in _COMMANDS.items():
        command = commands.add_parser(name, help=what, description=what)
        build(command)
        command.set_defaults(run=run)
    return parser


class _Version(argparse.Action):
    def __call__(self, parser: argparse.ArgumentParser, *_: object) -> None:
        from ..model.partition.native import describe

        print(f"solidtree {_version()} ({describe()})")
        parser.exit()


def _version() -> str:
    from importlib.metadata import PackageNotFoundError, version

    try:
        return version("solidtree")
    except PackageNotFoundError:
        return "unknown"


def positive(text: str) -> float:
    """A number above zero, for options."""
    try:
        value = float(text)
    except ValueError:
        value = 0.0
    if not 0 < value < float("inf"):
        raise argparse.ArgumentTypeError(f"{text!r} is not a number above 0")
    return value


def read(file: str) -> Document:
    """The document in a file of any kind that can be read. Raises Refusal."""
    from ..model.exchange.meshes_in import read_any

    document = read_any(Path(file))
    if Path(file).suffix.lower() != ".solidtree":
        for note in document.notes.splitlines():
            warn(file, note)
    return document


class Bar:
    """Progress on a terminal, nothing elsewhere."""

    def __init__(self, document: Document) -> None:
        from ..model.document.tree import walk

        self._shown = sys.stderr.isatty()
        self._total = sum(1 for _ in walk(*document.roots)) if self._shown else 0
        self._done = 0

    def __call__(self, label: str) -> None:
        self._done += 1
        self.show(label, min(self._done / max(self._total, 1), 1.0))

    def show(self, label: str, share: float) -> None:
        """Which share is done, 0 to 1, and of what."""
        if self._shown:
            print(f"\r[{'#' * int(30 * share):30}] {label[:40]:40}", end="", file=sys.stderr, flush=True)

    def end(self) -> None:
        if self._shown:
            print("\r" + " " * 76 + "\r", end="", file=sys.stderr, flush=True)


def _in_shell(module: str, name: str) -> Callable[[Any], Any]:
    """A function of a module in shell/, which is imported when it is called."""

    def call(argument: Any) -> Any:
        from importlib import import_module

        return getattr(import_module(f"{__package__}.shell.{module}"), name)(argument)

    return call


_COMMANDS: dict[str, tuple[Callable[[argparse.ArgumentParser], None], Callable[[argparse.Namespace], int], str]] = {
    name: (_in_shell(module, options), _in_shell(module, run), what)
    for name, module, options, run, what in (
        ("info", "info", "add_options", "info", "measurements as one JSON object on standard output"),
        ("export", "export", "add_options", "export",
         "write a mesh file (stl, 3mf, obj, ply, off, glb) or outlines (svg, dxf), by OUT's ending"),
        ("convert", "export", "add_convert_options", "export", "turn one file into another format"),
        ("render", "render", "add_options", "render", "a picture as PNG"),
        ("draw", "draw", "add_options", "draw", "a drawing with hidden faces and lines removed, as SVG, PDF or DXF"),
        ("sets", "parameters", "add_sets_options", "sets",
         "the saved sets of parameter values, as JSON of OpenSCAD's customizer, or as CSV"),
        ("check", "check", "add_options", "check",
         "solids that overlap or come nearer to each other than a clearance, as JSON"),
        ("motion", "motion", "add_options", "motion",
         "a timed motion: the first contact, and with --contacts those of each step, as JSON"),
        ("ray", "ray", "add_options", "ray", "the first face on a ray, or whether two points see each other, as JSON"),
        ("sight", "sight", "add_options", "sight",
         "whether two points see each other, or how much of a part or a face is seen from a point, as JSON"),
        ("section", "section", "add_options", "section",
         "the outlines in which a plane cuts the solids, as SVG or DXF"),
        ("faults", "faults", "add_options", "faults",
         "what is wrong with meshes, solids and outlines, as JSON; --repair writes them mended"),
        ("bsp", "bsp", "add_options", "bsp", "the BSP tree that hidden surfaces are sorted by: its figures as JSON"),
        ("pipeline", "pipeline", "add_options", "pipeline",
         "a point on its way to its pixel: matrices, stages, and counts of polygons and pixels, as JSON"),
        ("mesh", "mesh", "add_options", "mesh",
         "vertices, normals, faces and winged edges of the solids: their figures as JSON, or a table as CSV"),
        ("diagram", "diagram", "add_options", "diagram", "the CSG diagram of the tree as SVG"),
        ("font", "font", "add_options", "font", "a font's facts, a glyph, or a text as outlines, as JSON"),
        ("bitmap", "bitmap", "add_options", "bitmap", "a bitmap's header as JSON, its pixels as PNG"),
        ("run", "run", "add_options", "run", "run a script with the names of solidtree.model.script at hand"),
    )
}  # fmt: skip

if __name__ == "__main__":
    sys.exit(main())
