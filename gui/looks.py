"""How the picture is looked at: style, projection, grid, ghosts, colours. Kept in the settings, never undone."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .window import MainWindow

TRANSLUCENT = 0.5  # opacity of all faces


class Looks:
    """The switches of one window's picture, and their state."""

    def __init__(self, window: MainWindow) -> None:
        self._window = window
        flag = window.settings.flag
        self.parallel, self.grid = flag("parallel", False), flag("grid", True)
        self.ghosts, self.colour_by_node = flag("ghosts", True), flag("colour_by_node", False)
        self.style = "edges"
        self.translucent = False
        self.culling = False
        self.clipping: tuple[float, float] | None = None

    def apply(self) -> None:
        """Bring the picture to this state, when its parts are there."""
        self.set_parallel(self.parallel)
        self.set_grid(self.grid)
        self.set_colour_by_node(self.colour_by_node)
        self.set_style(self.style)

    def set_style(self, name: str) -> None:
        self.style = name
        self._window.viewport.change(lambda viewer: viewer.set_style(name))
        self._window.actions_.refresh()

    def set_translucent(self, translucent: bool) -> None:
        self.translucent = translucent
        self._window.viewport.change(lambda viewer: viewer.set_opacity(TRANSLUCENT if translucent else 1.0))
        self._window.actions_.refresh()

    def set_culling(self, culling: bool) -> None:
        """Leave out faces that are turned away from the eye."""
        self.culling = culling
        self._window.viewport.change(lambda viewer: viewer.set_culling(culling))
        self._window.actions_.refresh()

    def set_clipping(self, clipping: tuple[float, float] | None) -> None:
        """Show only what lies between two distances before the eye, in mm; None for all that is there."""
        self.clipping = clipping
        self._window.viewport.change(lambda viewer: viewer.set_clipping(clipping))
        self._window.actions_.refresh()

    def set_parallel(self, parallel: bool) -> None:
        if parallel != self.parallel:
            self.set_clipping(None)  # distances may be negative in a parallel projection alone
        self.parallel = parallel
        self._window.viewport.change(lambda viewer: viewer.set_projection(parallel))
        self._keep("parallel", parallel)

    def set_grid(self, visible: bool) -> None:
        self.grid = visible
        self._window.viewport.change(lambda viewer: viewer.set_ground(visible))
        self._keep("grid", visible)

    def set_ghosts(self, visible: bool) -> None:
        self.ghosts = visible
        self._window.operand_ghosts.set_visible(visible)
        self._window.handles.refresh()
        self._keep("ghosts", visible)

    def set_colour_by_node(self, by_node: bool) -> None:
        self.colour_by_node = by_node
        self._window.viewport.set_colour_by_node(by_node)
        self._window.tree.nodes.set_colour_by_node(by_node)
        self._keep("colour_by_node", by_node)

    def _keep(self, name: str, value: bool) -> None:
        self._window.settings.set_flag(name, value)
        self._window.actions_.refresh()
