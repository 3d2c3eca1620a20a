"""The command line. Standard output carries only the answer; messages and progress go to standard error."""

from __future__ import annotations

import argparse
import json
import os
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
    options = parser.parse_args(words)
    return _guarded(options.run, options)


def _guarded(run: Callable[[argparse.Namespace], int], options: argparse.Namespace) -> int:
    """Run a command; whatever goes wrong becomes one line and a status."""
    about = getattr(options, "file", "") or ""
    try:
        return run(options)
    except Refusal as refusal:
        return _complain(about, str(refusal))
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return DONE
    except KeyboardInterrupt:
        return _complain(about, "interrupted")
    except MemoryError:
        return _complain(about, "there is not enough memory for this")
    except OSError as error:
        from ..model.project.disk import reason_of

        return _complain(error.filename or about, reason_of(error))


def _complain(about: object, reason: str) -> int:
    reason = " ".join(reason.split())
    print(f"solidtree: {about}: {reason}" if about else f"solidtree: {reason}", file=sys.stderr)
    return REFUSED


def _window(files: list[str]) -> int:
    for file in files:
        if not Path(file).is_file():
            return _complain(file, "there is no such file")
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

    return read_any(Path(file))


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


def _info_options(command: argparse.ArgumentParser) -> None:
    command.add_argument("file", metavar="FILE", help="a project or anything that can be imported")
    command.add_argument("--tolerance", type=positive, default=TOLERANCE, metavar="MM", help="default 0.05")
    command.add_argument("--nodes", action="store_true", help="measure every node of the trees by itself, too")
    command.add_argument("--walls", action="store_true", help="estimate the least wall of each solid by 2,000 rays")
    _parameter_options(command)


def _info(options: argparse.Namespace) -> int:
    from ..model.solid.information import information
    from .shell.parameters import read_with_values

    document = read_with_values(options)
    bar = Bar(document)
    try:
        answer, in_order = information(document, options.tolerance, bar, options.nodes, options.walls)
    finally:
        bar.end()
    print(json.dumps(answer, indent=2, ensure_ascii=False, allow_nan=False))
    return DONE if in_order else NOT_IN_ORDER


def _export_options(command: argparse.ArgumentParser) -> None:
    command.add_argument("file", metavar="FILE", help="a project or anything that can be imported")
    command.add_argument("out", metavar="OUT", help="the file to write; its ending tells the format")
    command.add_argument("--solid", metavar="NAME", help="this solid alone; default: all that are visible")
    command.add_argument("--tolerance", type=positive, default=TOLERANCE, metavar="MM", help="default 0.05")
    _parameter_options(command)


def _parameter_options(command: argparse.ArgumentParser) -> None:
    from .shell.parameters import add_options

    add_options(command)


def _convert_options(command: argparse.ArgumentParser) -> None:
    command.add_argument("file", metavar="IN")
    command.add_argument("out", metavar="OUT")
    command.set_defaults(solid=None, tolerance=TOLERANCE, set=None, sets=None, parameter=[])


def _export(options: argparse.Namespace) -> int:
    from ..model.exchange.export import solids_to_write
    from ..model.exchange.meshes_out import check_ending, write_meshes
    from .shell.parameters import read_with_values

    out = Path(options.out)
    project = out.suffix.lower() == ".solidtree"
    if not project:
        _about(options.out, lambda: check_ending(out))
    document = read_with_values(options)
    if project:
        from ..model.project.project_file import save_project

        _about(options.out, lambda: save_project(document, out))
        return DONE
    bar = Bar(document)
    try:
        results, solids = solids_to_write(document, options.tolerance, options.solid, bar)
    finally:
        bar.end()
    _about(options.out, lambda: write_meshes(out, solids))
    for message in (message for result in results for message in result.messages):
        print(f"solidtree: {options.file}: “{message.name}”: {message.message}", file=sys.stderr)
    empty = [result for result in results if result.solid is None or result.solid.is_empty()]
    return NOT_IN_ORDER if empty else DONE


def _about(file: str, act: Callable[[], Any]) -> None:
    """Do something about another file than the first; what is refused names it."""
    try:
        act()
    except Refusal as refusal:
        raise SystemExit(_complain(file, str(refusal))) from None


def _diagram_options(command: argparse.ArgumentParser) -> None:
    command.add_argument("file", metavar="FILE", help="a project or anything that can be imported")
    command.add_argument("out", metavar="OUT.svg")
    command.add_argument("--solid", metavar="NAME", help="this solid alone; default: all")


def _diagram(options: argparse.Namespace) -> int:
    from ..render.drawing.csg_diagram import diagram

    out = Path(options.out)
    if out.suffix.lower() != ".svg":
        return _complain(out, "a diagram is written as SVG; let the name end in .svg")
    diagram(read(options.file), out, options.solid)
    return DONE


def _run_options(command: argparse.ArgumentParser) -> None:
    command.add_argument("file", metavar="SCRIPT.py")
    command.add_argument("arguments", metavar="ARG", nargs=argparse.REMAINDER, help="handed to the script in sys.argv")


def _run(options: argparse.Namespace) -> int:
    """A script with the names of solidtree.model.script at hand."""
    import builtins
    import traceback

    from ..model import script
    from ..render.drawing.csg_diagram import diagram

    path = Path(options.file)
    try:
        code = compile(path.read_bytes(), str(path), "exec")
    except SyntaxError as error:
        return _complain(f"{path}:{error.lineno}", error.msg)
    except ValueError as error:
        return _complain(path, str(error))
    sys.argv = [options.file, *options.arguments]
    sys.path.insert(0, str(path.parent.resolve()))
    names = {name: getattr(script, name) for name in script.__all__} | {"diagram": diagram}
    try:
        exec(code, {**names, "__name__": "__main__", "__file__": str(path), "__builtins__": builtins})
    except Exception as error:
        # The script's own line, not ours: where it went wrong and what Python or the model says of it.
        frames = [frame for frame in traceback.extract_tb(error.__traceback__) if frame.filename == str(path)]
        where = f"{path}:{frames[-1].lineno}" if frames else str(path)
        what = str(error) if isinstance(error, Refusal) else f"{type(error).__name__}: {error}"
        return _complain(where, what)
    return DONE


def _sets_options(command: argparse.ArgumentParser) -> None:
    from .shell.parameters import add_sets_options

    add_sets_options(command)


def _sets(options: argparse.Namespace) -> int:
    from .shell.parameters import sets

    return sets(options)


def _render_options(command: argparse.ArgumentParser) -> None:
    from .shell.render import add_options

    add_options(command)


def _render(options: argparse.Namespace) -> int:
    from .shell.render import render

    return render(options)


def _ray_options(command: argparse.ArgumentParser) -> None:
    from .shell.ray import add_options

    add_options(command)


def _ray(options: argparse.Namespace) -> int:
    from .shell.ray import ray

    return ray(options)


def _section_options(command: argparse.ArgumentParser) -> None:
    from .shell.section import add_options

    add_options(command)


def _section(options: argparse.Namespace) -> int:
    from .shell.section import section

    return section(options)


def _draw_options(command: argparse.ArgumentParser) -> None:
    from .shell.draw import add_options

    add_options(command)


def _draw(options: argparse.Namespace) -> int:
    from .shell.draw import draw

    return draw(options)


def _bsp_options(command: argparse.ArgumentParser) -> None:
    from .shell.bsp import add_options

    add_options(command)


def _bsp(options: argparse.Namespace) -> int:
    from .shell.bsp import bsp

    return bsp(options)


_COMMANDS: dict[str, tuple[Callable[[argparse.ArgumentParser], None], Callable[[argparse.Namespace], int], str]] = {
    "info": (_info_options, _info, "measurements as one JSON object on standard output"),
    "export": (_export_options, _export, "write a mesh file: stl, 3mf, obj, ply, off or glb by OUT's ending"),
    "convert": (_convert_options, _export, "turn one file into another format"),
    "render": (_render_options, _render, "a picture as PNG"),
    "draw": (_draw_options, _draw, "a drawing with hidden faces and lines removed, as SVG, PDF or DXF"),
    "sets": (_sets_options, _sets, "the saved sets of parameter values, as JSON of OpenSCAD's customizer, or as CSV"),
    "ray": (_ray_options, _ray, "the first face on a ray, or whether two points see each other, as JSON"),
    "section": (_section_options, _section, "the outlines in which a plane cuts the solids, as SVG or DXF"),
    "bsp": (_bsp_options, _bsp, "the BSP tree that hidden surfaces are sorted by: its figures as JSON"),
    "diagram": (_diagram_options, _diagram, "the CSG diagram of the tree as SVG"),
    "run": (_run_options, _run, "run a script with the names of solidtree.model.script at hand"),
}

if __name__ == "__main__":
    sys.exit(main())
