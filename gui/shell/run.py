"""`solidtree run`: a script with the names of solidtree.model.script at hand."""

from __future__ import annotations

import argparse
import builtins
import sys
import traceback
from pathlib import Path

from ...model.document.errors import Refusal
from ..command_line import DONE, complain


def add_options(command: argparse.ArgumentParser) -> None:
    """The options of `run`."""
    command.add_argument("file", metavar="SCRIPT.py")
    command.add_argument("arguments", metavar="ARG", nargs=argparse.REMAINDER, help="handed to the script in sys.argv")


def run(options: argparse.Namespace) -> int:
    """A script with the names of solidtree.model.script at hand."""
    from ...model import script
    from ...render.drawing.csg_diagram import diagram

    path = Path(options.file)
    try:
        code = compile(path.read_bytes(), str(path), "exec")
    except SyntaxError as error:
        return complain(f"{path}:{error.lineno}", error.msg)
    except ValueError as error:
        return complain(path, str(error))
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
        return complain(where, what)
    return DONE
