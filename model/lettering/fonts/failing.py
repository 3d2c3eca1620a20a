"""What a damaged font raises, as one refusal in words."""

from __future__ import annotations

import logging
from collections.abc import Iterator
from contextlib import contextmanager

from ...document.errors import Refusal

SHOWN = 120
logging.getLogger("fontTools").setLevel(logging.CRITICAL)  # its remarks on damaged tables, a line for each entry


@contextmanager
def failing(what: str) -> Iterator[None]:
    """The libraries raise nearly every kind of exception for bytes that are not a font: all are a Refusal here."""
    try:
        yield
    except Refusal:
        raise
    except RecursionError:
        raise Refusal(f"{what}: its parts use each other in a circle") from None
    except MemoryError:
        raise Refusal(f"{what}: it asks for more memory than there is") from None
    except Exception as error:
        reason = " ".join(str(error).split())[:SHOWN] or type(error).__name__
        raise Refusal(f"{what}: it is damaged ({reason})") from None
