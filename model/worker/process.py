"""The entry point of a worker's process. It imports nothing, so that the window may name it at no cost."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from multiprocessing.connection import Connection


def serve(connection: Connection, store_folder: str) -> None:
    """Answer requests until the other side is gone."""
    from .worker import work

    work(connection, store_folder)
