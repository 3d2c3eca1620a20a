"""What a lane tells: values that are handed to its listener in the lane's own thread."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from .shown import Message, Part, Shown

if TYPE_CHECKING:
    from ..checking.document_faults import NodeFaults
    from ..drafting.page import Page
    from ..partition.tree import Tree
    from ..proximity.findings import Report
    from ..proximity.moving.playing import Played


@dataclass(frozen=True, slots=True)
class Started:
    """A worker is ready."""

    pid: int


@dataclass(frozen=True, slots=True)
class Progress:
    """How far a request is: operations done of all, and the name of the one at work."""

    request: int
    done: int
    total: int
    label: str


@dataclass(frozen=True, slots=True)
class Evaluated:
    """The answer to `Lane.evaluate`; `evaluations` counts the nodes that were not in the worker's memo."""

    request: int
    shown: Shown
    seconds: float
    evaluations: int


@dataclass(frozen=True, slots=True)
class Examined:
    """The answer to `Lane.examine`: parts by node id; nodes that no visible solid holds are left out."""

    request: int
    parts: dict[str, Part]


@dataclass(frozen=True, slots=True)
class Exported:
    """The answer to `Lane.export`; `fault` says in words why no file was written."""

    request: int
    path: str
    fault: str | None


@dataclass(frozen=True, slots=True)
class Partitioned:
    """The answer to `Lane.partition`; `fault` says in words why there is no tree."""

    request: int
    tree: Tree | None
    seconds: float
    fault: str | None = None


@dataclass(frozen=True, slots=True)
class Drawn:
    """The answer to `Lane.draw`: the page, and what there is to tell of nodes; or `fault`, why there is no page."""

    request: int
    page: Page | None
    messages: tuple[Message, ...]
    fault: str | None = None


@dataclass(frozen=True, slots=True)
class FaultsFound:
    """The answer to `Lane.find_faults`: a report for each node; or `fault`, why there are none."""

    request: int
    found: tuple[NodeFaults, ...] | None
    fault: str | None = None


@dataclass(frozen=True, slots=True)
class MotionPlayed:
    """The answer to `Lane.play`: the motion step by step; or `fault`, why there is none."""

    request: int
    played: Played | None
    fault: str | None = None


@dataclass(frozen=True, slots=True)
class PairsChecked:
    """The answer to `Lane.check_pairs`; or `fault`, why there is none."""

    request: int
    report: Report | None
    fault: str | None = None


@dataclass(frozen=True, slots=True)
class Cancelled:
    """The request was given up because the user asked for it."""

    request: int


@dataclass(frozen=True, slots=True)
class Died:
    """The worker ended by itself. The request is tried once more; `given_up` says that this was the second time."""

    request: int | None
    reason: str
    given_up: bool


LaneMessage = (
    Started
    | Progress
    | Evaluated
    | Examined
    | Exported
    | Partitioned
    | Drawn
    | FaultsFound
    | MotionPlayed
    | PairsChecked
    | Cancelled
    | Died
)
