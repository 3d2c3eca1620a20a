"""`solidtree font`: a font's facts, a glyph's outline, a text as it shapes it, or a changed font saved."""

from __future__ import annotations

import argparse
import json

from ..command_line import DONE, NOT_IN_ORDER, positive, warn


def add_options(command: argparse.ArgumentParser) -> None:
    """The options of `font`."""
    command.add_argument("file", metavar="FILE", help="a TrueType, OpenType, WOFF or Type 1 font")
    shown = command.add_mutually_exclusive_group()
    shown.add_argument("--text", metavar="S", help="the outlines of a text, shaped; lines end with a line break")
    shown.add_argument("--glyph", metavar="NAME", help="the outline of one glyph, by its name or its character")
    shown.add_argument("--save", metavar="OUT", help="write it as .ttf, .otf or .pfb; see --slant and --weight")
    command.add_argument("--family", metavar="NAME", help="of the font that is saved; default: one its licence allows")
    command.add_argument(
        "--characters", default="", metavar="S", help="with --save: which lean and grow, as α-ω; default all"
    )
    command.add_argument("--weight", type=float, default=0.0, metavar="UNITS", help="with --save: grow the outlines")
    command.add_argument("--face", type=int, default=0, metavar="N", help="of a collection, from 0; default 0")
    command.add_argument("--size", type=positive, metavar="MM", help="of the em: lengths in mm, not font units")
    command.add_argument(
        "--feature", action="append", default=[], metavar="TAG=VALUE", help="an OpenType feature, as kern=0"
    )
    command.add_argument(
        "--axis", action="append", default=[], metavar="TAG=VALUE", help="of a variable font, as wght=700"
    )
    command.add_argument("--slant", type=float, default=0.0, metavar="DEGREES", help="lean to the right")
    command.add_argument("--direction", choices=("auto", "ltr", "rtl"), default="auto", help="of the lines")
    command.add_argument("--language", default="", metavar="TAG", help="as tr or sr")


def font(options: argparse.Namespace) -> int:
    """Tell; the status is 1 where the font has no glyph for a character."""
    from ...model.lettering.fonts.opening import face_count, font_bytes, open_face
    from ...model.lettering.layout import Style
    from ...model.lettering.lettering import features_of, location_of
    from ...model.lettering.report import facts_of, glyph_of, text_of

    data = font_bytes(options.file)
    if options.save is not None:
        return _save(options, data)
    face = open_face(data, options.face)
    location, features = location_of(" ".join(options.axis)), features_of(" ".join(options.feature))
    style = Style(
        size=options.size or face.units_per_em,
        slant=options.slant,
        direction=options.direction,
        language=options.language,
        features=features,
    )
    if options.text is not None:
        answer = text_of(face, options.text, style, location)
    elif options.glyph is not None:
        answer = glyph_of(face, options.glyph, style, location)
    else:
        print(json.dumps(facts_of(face, face_count(data)), indent=2, ensure_ascii=False, allow_nan=False))
        return DONE
    print(json.dumps(answer, ensure_ascii=False, allow_nan=False))
    if answer["missing"]:
        warn(options.file, f"it has no glyph for {', '.join(f'U+{code:04X}' for code in answer['missing'])}")
    return NOT_IN_ORDER if answer["missing"] else DONE


def _save(options: argparse.Namespace, data: bytes) -> int:
    from ...model.lettering.fonts.changing import write_changed_font

    remarks = write_changed_font(
        data,
        options.face,
        options.save,
        options.family,
        characters=options.characters,
        slant=options.slant,
        weight=options.weight,
    )
    for remark in remarks:
        warn(options.save, remark)
    return DONE
