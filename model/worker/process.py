"""A worker's process as the lane sees it. Nothing is imported here, so that the window may name it at no cost."""

from __future__ import annotations

import contextlib
import threading
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from multiprocessing.connection import Connection


def serve(connection: Connection, store_folder: str) -> None:
    """Answer requests until the other side is gone."""
    from .worker import work

    work(connection, store_folder)


class WorkerProcess:
    """One process at a time, and the pipe to it. All but `kill` and `pid` belong to the lane's thread."""

    def __init__(self, context: Any, store_folder: str) -> None:
        self._context = context
        self._store_folder = store_folder
        self._process: Any = None
        self._lock = threading.Lock()
        self.connection: Connection | None = None

    @property
    def pid(self) -> int | None:
        process = self._process
        return None if process is None else process.pid

    def start(self) -> None:
        ours, theirs = self._context.Pipe()
        process = self._context.Process(
            target=serve, args=(theirs, self._store_folder), name="solidtree worker", daemon=True
        )
        process.start()
        theirs.close()
        with self._lock:
            self._process, self.connection = process, ours

    def kill(self) -> None:
        """End it from any thread; whoever reads from it or writes to it then finds the pipe closed."""
        with self._lock:
            if self._process is not None:
                self._process.kill()

    def exit_code(self) -> int | None:
        """Wait for a process that has ended."""
        self._process.join()
        return self._process.exitcode

    def end(self) -> None:
        with self._lock:
            process, self._process = self._process, None
            connection, self.connection = self.connection, None
        if connection is not None:
            connection.close()
        if process is not None:
            process.kill()
            process.join()
            with contextlib.suppress(ValueError):  # somebody else waited for it first
                process.close()

    def restart(self) -> None:
        self.end()
        self.start()


def reason_of(code: int | None) -> str:
    """Why a process ended, in words."""
    if code == -9:
        return "the worker was ended from outside, or ran out of memory"
    return f"the worker ended unexpectedly (status {code})"
