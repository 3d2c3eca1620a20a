"""All tables of commands that the window has, in the order in which menus list them."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ...model.editing.commands import DOCUMENT_COMMANDS
from ...model.editing.tree_commands import TREE_COMMANDS
from ..tree.edit_commands import EDIT_COMMANDS
from .arrange import ARRANGE_COMMANDS
from .clearance import CLEARANCE_COMMANDS
from .curves import CURVE_COMMANDS
from .draw_tools import DRAW_COMMANDS
from .drawing import DRAWING_COMMANDS
from .engraving import ENGRAVING_COMMANDS
from .faults import FAULT_COMMANDS
from .fonts import FONT_COMMANDS
from .handles import HANDLE_COMMANDS
from .hidden_surfaces import HIDDEN_SURFACE_COMMANDS
from .measure import MEASURE_COMMANDS
from .mesh import MESH_COMMANDS
from .motion import MOTION_COMMANDS
from .nodes import NODE_COMMANDS
from .normals import NORMAL_COMMANDS
from .parameters import PARAMETER_COMMANDS
from .partition import PARTITION_COMMANDS
from .pipeline import PIPELINE_COMMANDS
from .relief import RELIEF_COMMANDS
from .sections import SECTION_COMMANDS
from .sight import SIGHT_COMMANDS
from .surfaces import SURFACE_COMMANDS
from .views import FILE_COMMANDS, VIEW_COMMANDS

if TYPE_CHECKING:
    from ..window import MainWindow
    from .actions import Actions


def add_commands(actions: Actions, window: MainWindow) -> None:
    """Make the actions of a window. Commands on documents take its session, all others the window."""
    for table, context in (
        (FILE_COMMANDS, window),
        (DRAWING_COMMANDS, window),
        (PARAMETER_COMMANDS, window),
        (DOCUMENT_COMMANDS, window.session),
        (TREE_COMMANDS, window.session),
        (RELIEF_COMMANDS, window),
        (CURVE_COMMANDS, window),
        (NODE_COMMANDS, window),
        (FONT_COMMANDS, window),
        (ENGRAVING_COMMANDS, window),
        (EDIT_COMMANDS, window),
        (VIEW_COMMANDS, window),
        (HIDDEN_SURFACE_COMMANDS, window),
        (PARTITION_COMMANDS, window),
        (PIPELINE_COMMANDS, window),
        (SECTION_COMMANDS, window),
        (HANDLE_COMMANDS, window),
        (MEASURE_COMMANDS, window),
        (SIGHT_COMMANDS, window),
        (FAULT_COMMANDS, window),
        (MOTION_COMMANDS, window),
        (CLEARANCE_COMMANDS, window),
        (DRAW_COMMANDS, window),
        (ARRANGE_COMMANDS, window),
        (SURFACE_COMMANDS, window),
        (MESH_COMMANDS, window),
        (NORMAL_COMMANDS, window),
    ):
        actions.add(table, context)
