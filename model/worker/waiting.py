"""The requests that a lane has yet to hand to its worker, and which of them comes next."""

from __future__ import annotations

from .job import Job

ORDER = ("evaluate", "draw", "partition", "pairs", "faults", "play", "examine", "prepare")
"""Of those that wait, the first of these words is done next."""

URGENT = ("evaluate", "partition", "draw", "faults", "pairs", "play")
"""Words of requests whose answers somebody waits for."""


class Waiting:
    """At most one request of each word, the newest, and all exports. For whoever holds the lane's lock."""

    def __init__(self) -> None:
        self._exports: list[Job] = []
        self._newest: dict[str, Job] = {}
        self._unwanted: dict[str, int] = {}  # by word: requests up to this number are no longer wanted

    def put(self, job: Job) -> None:
        """Let a request wait, instead of an older one of its word; what writes a file waits with all others."""
        if job.path or job.word == "export":
            self._exports.append(job)
        else:
            self._newest[job.word] = job

    def put_back(self, job: Job) -> None:
        """Let a request wait again, unless a newer one of its word does."""
        self._newest.setdefault(job.word, job)

    def next(self) -> Job | None:
        """Take out the request that is to be done next."""
        if "evaluate" not in self._newest and self._exports:
            return self._exports.pop(0)
        word = next((word for word in ORDER if word in self._newest), "")
        return self._newest.pop(word, None)

    def clear(self) -> None:
        self._exports.clear()
        self._newest.clear()

    def stop(self, word: str, number: int) -> None:
        """Requests of this word up to this number are not wanted any more."""
        self._unwanted[word] = number
        self._newest.pop(word, None)

    def supersedes(self, job: Job) -> bool:
        """Whether something newer takes the place of what is at work."""
        if job.word == "partition":
            return "partition" in self._newest
        if job.word in ("draw", "faults", "pairs", "play"):
            return not job.path and (job.word in self._newest or job.number <= self._unwanted.get(job.word, 0))
        newer = self._newest.get("evaluate")
        return newer is not None and job.word != "export" and (newer.supersedes or job.supersedes)

    @property
    def urgent(self) -> bool:
        """Whether somebody waits for an answer, and not just for what is got ready or looked at beside."""
        return bool(self._exports) or any(word in self._newest for word in URGENT)
