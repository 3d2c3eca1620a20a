"""What scripts call the kinds of nodes."""

from __future__ import annotations

from .nodes import Node

# Where the name is not simply the kind in lower case.
FUNCTION_NAMES = {
    "LinearArray": "linear_array",
    "PolarArray": "polar_array",
    "ImportedMesh": "imported_mesh",
    "TextOnPath": "text_on_path",
}


def function_name(kind: type[Node]) -> str:
    """The function of the script API that makes nodes of this kind."""
    return FUNCTION_NAMES.get(kind.__name__, kind.__name__.lower())
