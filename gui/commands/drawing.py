"""The window's command that puts the model on paper. It takes the MainWindow."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from ...model.editing.commands import Command

if TYPE_CHECKING:
    from ...model.drafting.plan import Eye
    from ..window import MainWindow


def _no_solid(window: MainWindow) -> str | None:
    return None if any(root.visible for root in window.session.document.solids) else "no solid is visible"


def present_view(window: MainWindow) -> tuple[Eye, float | None] | None:
    """The eye of the viewport, and the angle of its perspective or None; None before there is a picture."""
    from ...model.drafting.plan import Eye

    viewer = window.viewport.viewer
    if viewer is None:
        return None
    camera = viewer.camera
    width, height = viewer.size
    eye = Eye(camera.position, camera.target, camera.up, width / max(height, 1))
    return eye, None if camera.parallel else camera.view_angle


def ask_drawing(window: MainWindow) -> None:
    from ..drawing.drawing_dialog import DrawingDialog

    window.session.cancel()
    files = window.files
    folder = Path(window.settings.folder)
    DrawingDialog(
        window, window.session.document, files.name, folder, present_view(window), window.evaluation.jobs,
        files.export_drawing,
    ).open()  # fmt: skip


DRAWING_COMMANDS: tuple[Command, ...] = (
    Command("export_drawing", "Export drawing …", "File", ask_drawing, _no_solid, "Ctrl+Shift+E", "drawing",
            "Views on a page with hidden lines removed, as SVG, PDF or DXF"),
)  # fmt: skip
