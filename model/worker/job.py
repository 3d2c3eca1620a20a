"""What a lane is asked to do, and how the worker is told."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from ..document.document import Document, Section
from ..document.table import to_table


@dataclass(slots=True)
class Job:
    """One request: `word` names the worker's method; the other fields are those that it takes."""

    number: int
    word: str
    document: Document
    tolerance: float
    path: str = ""
    solid: str | None = None
    tries: int = 0
    tolerances: tuple[float, ...] = ()
    ids: tuple[str, ...] = ()
    section: Section | None = None
    supersedes: bool = True


def request_of(job: Job, pictures: set[bytes], surfaces: set[bytes]) -> tuple[Any, ...]:
    """The message to the worker; `pictures` and `surfaces` are keys of what it need not send again. Raises Refusal."""
    table = to_table(job.document)
    if job.word == "evaluate":
        return "evaluate", job.number, table, job.tolerance, pictures
    if job.word == "examine":
        return "examine", job.number, table, job.tolerance, job.ids, surfaces
    if job.word == "prepare":
        return "prepare", job.number, table, job.tolerances, job.solid
    return "export", job.number, table, job.path, job.tolerance, job.solid, job.section
