"""A guard against one fault of PySide6 6.12.0 under Python 3.10 and 3.11."""

from __future__ import annotations

import ctypes
import sys

import PySide6

PLENTY = 1 << 40


def keep_constants_alive() -> None:
    """Make None, True, False and NotImplemented immortal, as they are from Python 3.12 on.

    PySide6 6.12.0 takes that for granted: each of its functions without a result gives a reference to None away that it
    does not own, and some twenty thousand of those end an older Python ("deallocating None").
    """
    if sys.version_info >= (3, 12) or PySide6.__version_info__[:2] < (6, 12):
        return
    for constant in (None, True, False, NotImplemented):
        count = ctypes.c_ssize_t.from_address(id(constant))
        if count.value < PLENTY:
            count.value += PLENTY
