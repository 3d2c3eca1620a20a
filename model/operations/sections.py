"""Operations on the planes that open the picture."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from ..document.document import Document, Section
from ..document.errors import Refusal
from ..document.tree import unique_name

MOST_ACTIVE = 6
"""Planes that a picture can be cut by at once, as graphics cards allow."""


def add_section(
    document: Document,
    name: str | None = None,
    point: Sequence[float] = (0.0, 0.0, 0.0),
    normal: Sequence[float] = (0.0, 0.0, -1.0),
    active: bool = True,
) -> Document:
    """Open the picture by a plane: what lies on the side of `normal` (of `point`, mm) stays. None: a name is found."""
    taken = [section.name for section in document.sections]
    if name is None:
        name = unique_name("Section", taken)
    new = Section(_plain(name), point, normal, active)  # type: ignore[arg-type]
    if new.name in taken:
        raise Refusal(f"there is a section called “{new.name}” already")
    return _checked(document.with_(sections=(*document.sections, new)))


def set_section(document: Document, name: str, **changes: Any) -> Document:
    """Change `point`, `normal` or `active` of a section."""
    unknown = sorted(changes.keys() - {"point", "normal", "active"})
    if unknown:
        raise Refusal(f"a section has no {unknown[0]}")
    old = find_section(document, name)
    new = old.with_(**changes)
    return document if new == old else _checked(_swapped(document, old, new))


def rename_section(document: Document, name: str, new_name: str) -> Document:
    """Call a section otherwise."""
    old = find_section(document, name)
    new = old.with_(name=_plain(new_name))
    if new.name == old.name:
        return document
    if any(section.name == new.name for section in document.sections):
        raise Refusal(f"there is a section called “{new.name}” already")
    return _swapped(document, old, new)


def delete_section(document: Document, name: str) -> Document:
    """Take a section out."""
    old = find_section(document, name)
    return document.with_(sections=tuple(section for section in document.sections if section is not old))


def find_section(document: Document, name: str) -> Section:
    """The section of this name. Raises Refusal."""
    for section in document.sections:
        if section.name == name:
            return section
    raise Refusal(f"there is no section called “{name}”")


def position(section: Section) -> float:
    """Millimetres of the plane along its axis: along the normal, but for -x, -y and -z along x, y and z."""
    return _sign(section) * math.fsum(p * n for p, n in zip(section.point, section.normal, strict=True)) + 0.0


def moved_to(section: Section, place: float) -> tuple[float, ...]:
    """The section's point when its plane is shifted along its normal to this `position`."""
    by = _sign(section) * (place - position(section))
    return tuple(round(p + by * n, 9) + 0.0 for p, n in zip(section.point, section.normal, strict=True))


def _sign(section: Section) -> float:
    return -1.0 if -1.0 in section.normal else 1.0


def _swapped(document: Document, old: Section, new: Section) -> Document:
    return document.with_(sections=tuple(new if section is old else section for section in document.sections))


def _checked(document: Document) -> Document:
    if sum(section.active for section in document.sections) > MOST_ACTIVE:
        raise Refusal(f"at most {MOST_ACTIVE} sections can be open at once: switch one off first")
    return document


def _plain(name: object) -> str:
    return " ".join(name.split()) if isinstance(name, str) else name  # type: ignore[return-value]  # Section refuses it
