"""The words of axes and features, "wght=700" and "kern=0 smcp", with one of their settings changed."""

from __future__ import annotations

from ....model.document.errors import Refusal
from ....model.lettering.lettering import settings_of

FEATURES = {
    "afrc": "Stacked fractions", "c2pc": "Petite capitals from capitals", "c2sc": "Small capitals from capitals",
    "calt": "Contextual alternates", "case": "Case-sensitive forms", "clig": "Contextual ligatures",
    "cpsp": "Capital spacing", "cswh": "Contextual swash", "dlig": "Discretionary ligatures", "dnom": "Denominators",
    "frac": "Fractions", "hist": "Historical forms", "hlig": "Historical ligatures", "kern": "Kerning",
    "liga": "Ligatures", "lnum": "Lining figures", "nalt": "Annotation forms", "numr": "Numerators",
    "onum": "Old-style figures", "ordn": "Ordinals", "ornm": "Ornaments", "pcap": "Petite capitals",
    "pnum": "Proportional figures", "salt": "Stylistic alternates", "sinf": "Scientific inferiors",
    "smcp": "Small capitals", "subs": "Subscript", "sups": "Superscript", "swsh": "Swash", "titl": "Titling",
    "tnum": "Tabular figures", "unic": "Unicase", "zero": "Slashed zero",
}  # fmt: skip
"""Registered names of OpenType features that are a writer's choice."""
ON = ("calt", "clig", "kern", "liga")
"""Those of them that are on where nothing is said."""
NEEDED = frozenset(
    [
        "aalt",
        "abvf",
        "abvm",
        "abvs",
        "akhn",
        "blwf",
        "blwm",
        "blws",
        "ccmp",
        "cfar",
        "cjct",
        "curs",
        "dist",
        "dtls",
        "fin2",
        "fin3",
        "fina",
        "flac",
        "half",
        "haln",
        "init",
        "isol",
        "ljmo",
        "locl",
        "ltra",
        "ltrm",
        "mark",
        "med2",
        "medi",
        "mkmk",
        "mset",
        "nukt",
        "pref",
        "pres",
        "pstf",
        "psts",
        "rclig",
        "rkrf",
        "rlig",
        "rphf",
        "rtla",
        "rtlm",
        "rvrn",
        "size",
        "ssty",
        "stch",
        "tjmo",
        "vatu",
        "vert",
        "vjmo",
        "vkrn",
        "vrt2",
        "vrtr",
    ]
)
"""Features that the shaping of scripts decides on, which nobody chooses."""


def feature_name(tag: str) -> str:
    """A feature in words, its tag where it has no registered name."""
    for begin, words in (("ss", "Stylistic set"), ("cv", "Character variant")):
        if tag.startswith(begin) and tag[2:].isdigit():
            return f"{words} {int(tag[2:])}"
    return FEATURES.get(tag, tag)


def settings_in(text: str, what: str) -> dict[str, float | None]:
    """The settings that a text has, None for one without a value; none of a text that is no settings."""
    try:
        return dict(settings_of(text, what))
    except Refusal:
        return {}


def with_axis(text: str, tag: str, value: float, default: float) -> str:
    """The text with another value of an axis, which is not named at its default."""
    settings = settings_in(text, "axes")
    if value == default:
        settings.pop(tag, None)
    else:
        settings[tag] = value
    return _written(settings)


def feature_on(text: str, tag: str) -> bool:
    settings = settings_in(text, "features")
    return settings[tag] != 0 if tag in settings else tag in ON


def with_feature(text: str, tag: str, on: bool) -> str:
    """The text with a feature on or off, which is not named where it is so anyway."""
    settings = settings_in(text, "features")
    if on == (tag in ON):
        settings.pop(tag, None)
    else:
        settings[tag] = None if on else 0.0
    return _written(settings)


def _written(settings: dict[str, float | None]) -> str:
    return " ".join(tag if value is None else f"{tag}={value:.10g}" for tag, value in settings.items())
