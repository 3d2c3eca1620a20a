"""What scripts ask of solids on their way: first contacts, how deep they are in each other, motions of a document."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from ..document.document import Document
from ..document.errors import Refusal
from ..document.nodes import Node
from ..document.placement import affine
from .joining import solids_of
from .proximity import bodies_of, check_document_given, check_tolerance

if TYPE_CHECKING:
    from ..proximity.moving.sweeping import Contact
    from ..proximity.penetration import Penetration


def first_contact(
    moving: Node,
    standing: Node | Iterable[Node],
    poses: Iterable[Any],
    times: Iterable[float] | None = None,
    tolerance: float = 0.05,
) -> Contact | None:
    """When a solid on its way first meets one of the others, None: never. It goes through `poses`, matrices of 3 or 4
    rows of 4 numbers that turn and move it, at `times` (0, 1, 2 and so on), from each to the next by a screw.

    >>> ball = sphere(1)
    >>> round(first_contact(ball, box(2).at(9, -1, -1), [moved_by(), moved_by(20)]).time, 3)
    0.4
    """
    from ..proximity.moving.sweeping import first_contact as contact_of

    others = solids_of([standing])
    if isinstance(poses, str) or not isinstance(poses, Iterable):
        raise Refusal(f"the poses of a way are a list of matrices, not {poses!r:.60}")
    way = [affine(pose).matrix() for pose in poses]
    if times is not None and (isinstance(times, str) or not isinstance(times, Iterable)):
        raise Refusal(f"the times of a way are a list of numbers, not {times!r:.60}")
    bodies = bodies_of(moving, *others, tolerance=tolerance)
    return contact_of(bodies[0], bodies[1:], way, range(len(way)) if times is None else list(times))


def moved_by(x: float = 0, y: float = 0, z: float = 0) -> Any:
    """(3, 4) the pose of a solid that is moved by millimetres."""
    from ..document.placement import moved

    return moved(x, y, z).matrix()


def penetration(one: Node, other: Node, tolerance: float = 0.05) -> Penetration | None:
    """The shortest move found that takes the first solid out of the second: `depth` in mm, `direction` and `exact`,
    which it is for convex solids; None where they share nothing.

    >>> penetration(box(10), box(10).at(8, 1)).depth
    2.0
    """
    from ..proximity.penetration import penetration as penetration_of

    first, second = bodies_of(one, other, tolerance=tolerance)
    return penetration_of(first, second)


def motion(
    document: Document,
    name: str,
    parameter: str = "t",
    start: float = 0,
    end: float = 1,
    seconds: float = 4,
    steps: int = 50,
) -> Document:
    """The document with a motion, in which a parameter goes from `start` to `end`; one of that name is replaced."""
    from ..operations.motions import add_motion, set_motion

    check_document_given(document)
    values = {"start": start, "end": end, "seconds": seconds, "steps": steps}
    if any(one.name == name for one in document.motions):
        return set_motion(document, name, parameter=parameter, **values)
    return add_motion(document, name, parameter, **values)


def contacts_in_motion(
    document: Document, name: str | None = None, between: bool = False, tolerance: float = 0.05
) -> dict[str, Any]:
    """What `solidtree motion --contacts` tells of a motion, the only one or that of this name: contacts step by step,
    and the first one. With `between` nothing is jumped over from step to step. Raises Refusal where a solid failed.

    >>> t = parameter("t", 0)
    >>> scene = motion(document_of(box(10).at(t * 30).named("arm"), box(10).at(25).named("base")), "push")
    >>> round(contacts_in_motion(scene)["first"]["time"], 3)
    2.0
    """
    from ..proximity.moving.playing import play

    check_document_given(document)
    check_tolerance(tolerance)
    played = play(document, name, tolerance, between=between)
    for message in played.messages:
        if message.error:
            raise Refusal(f"“{message.name}”: {message.message}")
    return played.table()


__all__ = ["contacts_in_motion", "first_contact", "motion", "moved_by", "penetration"]
