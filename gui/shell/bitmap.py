"""`solidtree bitmap`: a bitmap's header as JSON, its pixels as PNG or at another depth."""

from __future__ import annotations

import argparse
import json

from ..command_line import DONE


def add_options(command: argparse.ArgumentParser) -> None:
    """The options of `bitmap`."""
    command.add_argument("file", metavar="FILE", help="a BMP, PNG, JPEG, TIFF or WebP file")
    command.add_argument("out", metavar="OUT.png", nargs="?", help="where its pixels go, as 8-bit RGBA")
    command.add_argument("--key", metavar="R,G,B", type=_colour, help="the colour that shows nothing")
    command.add_argument("--depth", type=int, choices=(1, 2, 4, 8, 16, 24, 32), help="bits a pixel, before it is told")
    command.add_argument(
        "--dither", choices=("none", "floyd-steinberg", "bayer"), default="none", help="with --depth; default none"
    )


def bitmap(options: argparse.Namespace) -> int:
    """Tell, and write what is asked for."""
    from dataclasses import replace
    from pathlib import Path

    from ...model.document.errors import Refusal
    from ...model.image.depth import with_depth
    from ...model.image.pictures import encoded, read_bitmap
    from ...model.image.report import header_facts

    found = read_bitmap(options.file)
    if options.key is not None:
        found = replace(found, colour_key=options.key)
    if options.depth is not None:
        found = with_depth(found, options.depth, options.dither)
    if options.out is not None:
        try:
            Path(options.out).write_bytes(encoded(found.to_rgba(), "PNG"))
        except OSError as error:
            raise Refusal(f"{options.out} cannot be written: {error.strerror or error}") from None
    print(json.dumps(header_facts(found, Path(options.file).stat().st_size), allow_nan=False))
    return DONE


def _colour(words: str) -> tuple[int, int, int]:
    parts = words.split(",")
    if len(parts) != 3 or not all(part.strip().isdigit() and int(part) < 256 for part in parts):
        raise argparse.ArgumentTypeError("a colour is three numbers from 0 to 255, as 255,0,255")
    red, green, blue = map(int, parts)
    return red, green, blue
