"""What scripts ask of solids on their way: first contacts, how deep they are in each other, motions of a document."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from ..document.document import Document
from ..document.errors import Refusal
from ..document.nodes import Node
from ..document.placement import affine
from .proximity import bodies_of

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

    others = [standing] if isinstance(standing, Node) else list(standing)
    way = [affine(pose).matrix() for pose in poses]
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

    played = play(document, name, tolerance, between=between)
    for message in played.messages:
        if message.error:
            raise Refusal(f"“{message.name}”: {message.message}")
    return played.table()


__all__ = ["contacts_in_motion", "first_contact", "motion", "moved_by", "penetration"]
