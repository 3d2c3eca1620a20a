"""What a changed font may be called: licences reserve names, and no two fonts should share one."""

from __future__ import annotations

import re
from typing import Any

from ...document.errors import Refusal
from ..fonts.opening import open_face
from ..fonts.sfnt_face import SfntFace
from ..fonts.type1_face import Type1Face

LONGEST = 63
"""Characters of a family name."""
RENAMED = (1, 3, 4, 6, 16, 18, 20, 21, 25)
"""Records of the name table that hold the family's name in one way or another."""
LEGAL = (0, 7, 13)
"""Records that tell reserved names: copyright, trademark, licence."""
_MARKS = "\"'\u2018\u2019\u201c\u201d\u00ab\u00bb"
_QUOTED = re.compile(f"[{_MARKS}]([^{_MARKS}\n]{{2,60}})[{_MARKS}]")
_RESERVED = (
    re.compile(r"reserved\s+font\s+names?:?\s*([^\n]*)", re.IGNORECASE),
    re.compile(r"not\s+containing\s+(?:either\s+)?the\s+words?\s+([^;]*?(?:\"[^\"]*\"[^;]*?)+)[.;]", re.IGNORECASE),
)
_NAMED_BEFORE = re.compile(f"[{_MARKS}]([^{_MARKS}\n]{{2,60}})[{_MARKS}] is a reserved font name", re.IGNORECASE)
_PLAIN = re.compile(r"[^.,;:()\n]{2,60}")


def reserved_names(data: bytes, number: int = 0) -> tuple[str, ...]:
    """The names that a font's licence forbids to changed versions of it. Raises Refusal for what is no font.

    From "with Reserved Font Name ..." (SIL Open Font License 1.1) and "names not containing ... the words ..."
    (Bitstream Vera, Arev), as fonts' own records quote them.
    """
    found: dict[str, None] = {}
    for text in _legal_texts(data, number):
        plain = " ".join(text.split())
        for match in _NAMED_BEFORE.finditer(plain):
            found[match[1].strip()] = None
        for pattern in _RESERVED:
            for match in pattern.finditer(plain):
                quoted = _QUOTED.findall(match[1][:200])
                if quoted:
                    found |= dict.fromkeys(name.strip() for name in quoted)
                elif pattern is _RESERVED[0] and not _is_sentence(match[1]):
                    rest = _PLAIN.match(match[1])
                    if rest:
                        found[rest[0].strip()] = None
    return tuple(found)


def _is_sentence(rest: str) -> bool:
    """Whether the words after "Reserved Font Name" go on talking of it, as the licence's own text does."""
    begin = rest.lstrip(" \"'")[:12].casefold()
    return not rest.strip() or begin.startswith(("refers", "for ", "(s)", "unless", "is ", "may ", ". ", ".", "s)"))


def _legal_texts(data: bytes, number: int) -> list[str]:
    face = open_face(data, number)
    if isinstance(face, SfntFace):
        return face.legal
    return [face.notice] if isinstance(face, Type1Face) else []


def proposed_family(data: bytes, number: int = 0) -> str:
    """A family name that a changed version may have, from the font's own."""
    family = open_face(data, number).family
    reserved = [name.casefold() for name in reserved_names(data, number)]
    left = family
    for name in reserved:
        left = re.sub(re.escape(name), " ", left, flags=re.IGNORECASE)
    left = " ".join(left.split())
    proposed = f"{left} Edited"[:LONGEST] if left else "Edited Letters"
    return proposed if not _fault(proposed, family, reserved) else "Edited Letters"


def check_family(data: bytes, number: int, family: str) -> str:
    """The name without needless spaces. Raises Refusal for one that a changed version of the font may not have."""
    plain = " ".join(str(family).split())
    fault = _fault(plain, open_face(data, number).family, reserved_names(data, number))
    if fault:
        raise Refusal(fault)
    return plain


def _fault(family: str, own: str, reserved: Any) -> str:
    if not family or len(family) > LONGEST:
        return f"the new family needs a name of 1 to {LONGEST} characters"
    if not family.isprintable() or not postscript_name(family, ""):
        return f"“{family}” has nothing that a font's name can hold: take Latin letters and digits, others beside them"
    folded = family.casefold()
    if folded == own.casefold():
        return f"a changed font needs another name than “{own}”"
    for name in reserved:
        if name.casefold() in folded:
            return f"the font's licence reserves the name “{name}”: a changed font must be called without it"
    return ""


def postscript_name(family: str, style: str) -> str:
    """As "GreekEdited-Bold": ASCII without the characters that have a meaning in PostScript, 63 at most."""
    words = [re.sub(r"[^\x21-\x7e]|[\[\](){}<>/%]", "", part) for part in (family, style)]
    return "-".join(word for word in words if word)[:LONGEST]


def full_name(family: str, style: str) -> str:
    from ..fonts.face import name_of

    return name_of(family, style)


def rename(font: Any, family: str, style: str) -> None:
    """Call an open font (a TTFont) otherwise in all its records; copyright and licence stay."""
    table = font["name"]
    name, full = postscript_name(family, style), full_name(family, style)
    texts = {1: family, 3: f"{name}:{_version(table)}", 4: full, 6: name, 16: family, 18: full, 20: name, 21: family,
             25: name}  # fmt: skip
    basic = style.casefold() in ("", "regular", "italic", "bold", "bold italic", "book", "roman", "normal")
    if not basic:
        texts[1] = full
    kept = []
    for record in table.names:
        if record.nameID in RENAMED:
            if record.platformID == 1 and not texts[record.nameID].isascii():
                continue
            record.string = texts[record.nameID]
        kept.append(record)
    table.names = kept
    for name_id in (1, 2, 3, 4, 6):
        if table.getDebugName(name_id) is None:
            table.setName(texts.get(name_id, style or "Regular"), name_id, 3, 1, 0x409)


def _version(table: Any) -> str:
    return (table.getDebugName(5) or "Version 1.000").split(";")[0]
