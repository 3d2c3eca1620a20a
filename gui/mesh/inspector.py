"""The Mesh panel at work: the mesh of a solid, what is chosen of it, tables and picture that follow each other."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from PySide6.QtCore import QObject

from ...model.document.errors import Refusal
from ...model.mesh.selecting import converted, flags
from ...model.mesh.tables import Tables
from ..view.occurrences import maker_of
from .choices import ALL, CHOICES, CHOSEN, KIND_OF, TABLE_OF, Asked, Limits, listed
from .chosen import Chosen
from .editing import MeshEditing
from .element_picture import ElementPicture
from .element_tool import ElementTool
from .page import MeshPage
from .source import MeshSource
from .table_page import TablePage
from .words import count_words, element_words, euler_words

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ...model.editing.session import State
    from ...model.mesh.inspected import InspectedMesh
    from ...model.mesh.selecting import Kind
    from ..window import MainWindow
    from .panel import MeshPanel

NEAR = 0.08
"""Of the mesh's size: the least that is looked at when an element is zoomed to."""
NOTHING = "Click a row, or an element in the picture."


class MeshInspector(QObject):
    """Works while it is active, and leaves the picture as it was when it no longer is."""

    def __init__(self, window: MainWindow, panel: MeshPanel) -> None:
        super().__init__(panel)
        self._window, self._viewport, self._panel = window, window.viewport, panel
        self.chosen = Chosen(self)
        self.source = MeshSource(window, self)
        self.tool = ElementTool(window.viewport, self.source, self.chosen, self)
        window.viewport.add_tool(self.tool)
        self.picture = ElementPicture(window.viewport, self.chosen)
        self.editing = MeshEditing(window, self.chosen)
        self.limits = Limits()
        self.first = 0
        self.tables: Tables | None = None
        self._active = False
        self._wanted = True
        """Whether clicks in the picture choose elements while the panel is in front."""
        self._own_rows: TablePage | None = None
        self.page = page = MeshPage(window.actions_, panel)
        self.source.changed.connect(self._follow_source)
        self.source.outdated.connect(self.picture.clear)
        self.chosen.changed.connect(self._follow_chosen)
        page.solid_chosen.connect(self.source.choose)
        page.polygons_chosen.connect(self.source.set_polygons)
        page.first_chosen.connect(self._set_first)
        page.pages.currentChanged.connect(self._follow_page)
        page.costs.again.clicked.connect(lambda: page.costs.measure(window.files.background, self.mesh, again=True))
        for name, table in page.tables.items():
            table.filtered.connect(lambda table=table: self._filter(table))
            table.asked_for.connect(lambda number, table=table: self.go_to(table.name, number - self.first))
            table.view.chosen.connect(lambda picked, current, name=name: self._rows_chosen(name, picked, current))
            table.view.looked_for.connect(lambda element, name=name: self.look_at(KIND_OF[name], element))
            table.view.copy_asked.connect(self.copy)
        self.tool.hovered.connect(self.picture.hover)
        self.tool.picked.connect(lambda: self.show_table(TABLE_OF[self.chosen.kind]))
        self.tool.solid_asked.connect(self.source.choose)
        self._viewport.view_changed.connect(self._follow_sections)
        window.theme.changed.connect(self._retint)
        page.pages.setCurrentIndex([*page.tables].index("edges"))

    @property
    def mesh(self) -> InspectedMesh | None:
        return self.chosen.mesh

    @property
    def picking(self) -> bool:
        return self.tool.active

    def set_active(self, active: bool) -> None:
        if active == self._active:
            return
        self._active = active
        self.source.set_active(active)
        if active:
            self._follow_source()
            if self._wanted:
                self.tool.start()
                self._viewport.setFocus()
        else:
            wanted = self.tool.active
            self.tool.end()
            self._wanted = wanted
            self.picture.clear()
        self._window.actions_.refresh()

    def set_mode(self, mode: str) -> None:
        """Choose such elements by clicks; the mode that is on already is switched off."""
        if self.tool.active and self.tool.mode == mode:
            self.tool.end()
        else:
            self.tool.start(mode)  # type: ignore[arg-type]
            self._wanted = True
        self._window.actions_.refresh()

    def session_changed(self, before: State, after: State) -> None:
        if before.selection != after.selection:
            self.source.follow_selection()
            for table in self.page.tables.values():
                if table.chosen_filter.name == "of_nodes":
                    self._list(table)

    # The mesh.

    def _follow_source(self) -> None:
        source, page = self.source, self.page
        mesh = source.mesh if self._active else None
        page.say(source.words, source.solids, source.solid)
        if mesh is None:
            self.tables = None
            self.chosen.set_mesh(None)
            for table in page.tables.values():
                table.view.show_table(None)
            return
        fresh = mesh is not self.chosen.mesh
        if fresh or (self.tables is not None and tuple(self.tables.labels) != source.labels):
            self.tables = Tables(mesh, source.labels)
            page.counts.setText(count_words(mesh))
            page.euler.setText(euler_words(mesh))
            for table in page.tables.values():
                table.view.show_table(None)
            if fresh:
                self.chosen.set_mesh(mesh)
        self._follow_page()
        if not fresh:  # what is drawn may have been taken away meanwhile
            self.picture.show(self.first)

    def _follow_page(self) -> None:
        """Fill the table that is open, where it is not; measure where the costs are."""
        table = self.page.table()
        if self.tables is None:
            return
        if table is None:
            self.page.costs.measure(self._window.files.background, self.mesh)
        elif table.view.elements.table is None:
            self._list(table)
        self._mark_rows()

    def _asked(self) -> Asked | None:
        mesh = self.mesh
        nodes = self._window.session.selection
        return None if mesh is None else Asked(mesh, self.chosen, self.limits, tuple(nodes))

    def _filter(self, page: TablePage) -> None:
        self.limits = Limits(**{name: field.value() for name, field in page.limits.items()})
        for other in self.page.tables.values():
            for name in page.limits:
                other.set_limit(name, getattr(self.limits, name))
        self._list(page)

    def _list(self, page: TablePage) -> None:
        """Show the rows of a table that its filter picks out."""
        asked = self._asked()
        if asked is None or self.tables is None:
            return
        members = listed(asked, page.name, page.chosen_filter.name)
        wanted = None if members is None else np.flatnonzero(members)
        view = page.view
        table = view.elements.table
        if table is None:
            view.show_table(self.tables.of(page.name), wanted)
            table = view.elements.table
        else:
            view.elements.pick_out(wanted)
        assert table is not None
        page.say(len(view.elements.listed), table.count)

    def _set_first(self, first: int) -> None:
        self.first = first
        for table in self.page.tables.values():
            table.view.elements.set_first(first)
        self._follow_chosen()

    # What is chosen.

    def choose(self, name: str) -> None:
        """One of CHOICES. Raises Refusal."""
        asked = self._asked()
        if asked is None:
            raise Refusal("there is no mesh to choose from")
        page = self.page.table()
        if not self.chosen.count and page is not None:  # all of what is looked at, or none of it
            kind = KIND_OF[page.name]
            self.chosen.set(kind, flags(self.chosen.size(kind), ()))
        kind, members = CHOICES[name](asked)
        self.chosen.set(kind, members.copy())
        self.show_table(TABLE_OF[kind])
        count = self.chosen.count
        self._window.status.say("" if count else "There is no such element in this mesh")

    def go_to(self, table: str, number: int) -> None:
        """Choose a row by its number."""
        view = self.page.tables[table].view
        count = 0 if view.elements.table is None else view.elements.table.count
        if not 0 <= number < count:
            last = f"{self.first} to {count - 1 + self.first:,}" if count else "none"
            self._window.status.say(f"There is no such row: the numbers are {last}")
            return
        if view.elements.rows_of(np.array([number]))[0] < 0:
            self.page.tables[table].set_filter(ALL)
        self._choose_rows(table, np.array([number]), number)

    def _rows_chosen(self, table: str, rows: NDArray[np.int64], current: int) -> None:
        self._own_rows = self.page.tables[table]
        self._choose_rows(table, rows, current)
        self._own_rows = None

    def _choose_rows(self, table: str, rows: NDArray[np.int64], current: int) -> None:
        mesh = self.mesh
        if mesh is not None and table == "normals":
            self.chosen.set("face", np.isin(mesh.lists.face_normal, rows))
        elif mesh is not None:
            kind = KIND_OF[table]
            self.chosen.set(kind, flags(self.chosen.size(kind), rows), current)

    def _follow_chosen(self) -> None:
        self.picture.show(self.first)
        self._tell()
        for table in self.page.tables.values():
            if table is not self._own_rows and table.chosen_filter.name == CHOSEN:
                self._list(table)
        self._mark_rows()
        self._window.actions_.refresh()

    def _mark_rows(self) -> None:
        table = self.page.table()
        if table is None or table is self._own_rows or table.view.elements.table is None:
            return
        mine = KIND_OF[table.name] == self.chosen.kind and table.name != "normals"
        table.view.mark(self.chosen.numbers if mine else np.zeros(0, np.int64), self.chosen.current if mine else -1)

    def show_table(self, name: str) -> None:
        """Bring a table to the front."""
        self.page.pages.setCurrentWidget(self.page.tables[name])

    def _tell(self) -> None:
        chosen, mesh = self.chosen, self.mesh
        words = NOTHING
        if mesh is not None and chosen.current >= 0:
            words = element_words(mesh, self.source.labels, chosen.kind, chosen.current, self.first)
        if chosen.count > 1:
            named = TABLE_OF[chosen.kind]
            words = f"<b>{chosen.count:,}</b> {named} chosen. " + ("" if chosen.current < 0 else words)
        self.page.looked.setText(words)

    @property
    def maker(self) -> str:
        """The id of the node that made the face that is looked at; "" for none."""
        mesh, chosen = self.mesh, self.chosen
        if mesh is None or chosen.kind != "face" or chosen.current < 0:
            return ""
        maker = int(mesh.maker[chosen.current])
        return maker_of(mesh.owners[maker]) if maker >= 0 else ""

    def look_at(self, kind: Kind, element: int) -> None:
        """Turn no camera, but bring it near to one element."""
        from ...render.camera import fit

        mesh, viewer = self.mesh, self._viewport.viewer
        if mesh is None or viewer is None:
            return
        points = mesh.lists.vertices
        size = float(np.linalg.norm(np.ptp(points, axis=0)))
        members = flags(self.chosen.size(kind), (element,))
        mine = points[converted(mesh.winged, members, kind, "vertex")]
        half = max(float(np.ptp(mine, axis=0).max(initial=0.0)), NEAR * size) / 2
        middle = (mine.min(axis=0) + mine.max(axis=0)) / 2
        bounds = np.array([middle - half, middle + half])
        self._viewport.move_to(fit(viewer.camera, bounds, viewer.size[0] / viewer.size[1], 1.3))

    # The picture.

    def _follow_sections(self) -> None:
        if self._active:
            self.picture.follow_sections()

    def _retint(self) -> None:
        if self._active:
            self.picture.show(self.first)
            self.page.costs.retint()

    # Out of the window.

    def copy(self) -> None:
        """Put the chosen rows of the open table into the clipboard, or all that are listed."""
        from .tables_out import copy_rows

        page = self.page.table()
        if page is not None:
            copy_rows(self._window, page, self._rows_out(page), self.first)

    def save(self) -> None:
        """Ask for a file, and write what is listed in the open table."""
        from .tables_out import ask_csv

        page = self.page.table()
        if page is not None:
            ask_csv(self._window, page, self.first, self.source.solids.get(self.source.solid, "mesh"))

    def _rows_out(self, page: TablePage) -> NDArray[np.int64]:
        listed_, mine = page.view.elements.listed, KIND_OF[page.name] == self.chosen.kind
        if page.name == "normals" or not mine or not self.chosen.count:
            return listed_
        picked = listed_[self.chosen.members[listed_]]
        return picked if len(picked) else listed_
