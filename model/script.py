"""What scripts, the console and the examples write: `box(10) - cylinder(3)`.

Everything is a value: a call returns a new one. Lengths are millimetres and angles degrees; any number may be an
expression, as text or made from `parameter`. The methods of a solid place and dress it, in call order, about the
world's origin: `at`, `turned`, `scaled`, `mirrored`, `transformed`, `named`, `coloured`, `dressed`, `noted`, `hidden`.
The nodes of an open document are placed by `move`, `turn` and `scale`, operations that the window's script log
shows.
"""

from __future__ import annotations

from .document.document import Document
from .document.errors import Refusal
from .scripting import (
    documents,
    faults,
    fonts,
    hidden_surfaces,
    joining,
    letters,
    motions,
    pipelines,
    proximity,
    shapes,
    sight,
    structures,
    surfaces,
)
from .scripting import outlines as flat
from .scripting.documents import *  # noqa: F403
from .scripting.faults import *  # noqa: F403
from .scripting.fonts import *  # noqa: F403
from .scripting.hidden_surfaces import *  # noqa: F403
from .scripting.joining import *  # noqa: F403
from .scripting.letters import *  # noqa: F403
from .scripting.motions import *  # noqa: F403
from .scripting.outlines import *  # noqa: F403
from .scripting.pipelines import *  # noqa: F403
from .scripting.proximity import *  # noqa: F403
from .scripting.shapes import *  # noqa: F403
from .scripting.sight import *  # noqa: F403
from .scripting.structures import *  # noqa: F403
from .scripting.surfaces import *  # noqa: F403

__all__ = ["Document", "Refusal"]
__all__ += shapes.__all__
__all__ += flat.__all__
__all__ += letters.__all__
__all__ += joining.__all__
__all__ += documents.__all__
__all__ += fonts.__all__
__all__ += hidden_surfaces.__all__
__all__ += sight.__all__
__all__ += surfaces.__all__
__all__ += faults.__all__
__all__ += motions.__all__
__all__ += pipelines.__all__
__all__ += proximity.__all__
__all__ += structures.__all__
