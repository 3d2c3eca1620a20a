"""The commands of the font window. They take the FontWindow."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from ...model.document.errors import Refusal
from ...model.editing.commands import Command, done
from ...model.path.path import Kind, Node, Path
from . import glyph_edits
from .glyph_desk import Place

if TYPE_CHECKING:
    from .font_window import FontWindow

EM = 10.0
"""mm"""
Fault = Callable[["FontWindow"], str | None]
Edit = Callable[[Path, frozenset[Place]], Path]


def _chosen(fewest: int) -> Fault:
    def fault(window: FontWindow) -> str | None:
        if window.desk.drawn is None:
            return "choose a glyph first"
        if len(window.canvas.chosen) < fewest:
            return "choose a node first" if fewest == 1 else f"choose {fewest} nodes or more first"
        return None

    return fault


def _edit(label: str, edit: Edit) -> Callable[[FontWindow], None]:
    def run(window: FontWindow) -> None:
        drawn = window.desk.drawn
        if drawn is not None:
            window.desk.put(label, edit(drawn.outline, window.canvas.chosen))

    return run


def _kind(name: str, title: str, kind: Node, keys: str, tip: str) -> Command:
    return Command(f"glyph_{name}", title, "Glyph", _edit(f"Make {title.lower()}", lambda outline, chosen:
                   glyph_edits.of_kind(outline, chosen, kind)), _chosen(1), keys, f"nodes_{name}", tip)  # fmt: skip


def _segment(name: str, title: str, kind: Kind, keys: str, tip: str) -> Command:
    return Command(f"glyph_{name}", title, "Glyph", _edit(f"Make {title.lower()}", lambda outline, chosen:
                   glyph_edits.converted(outline, chosen, kind)), _chosen(2), keys, f"segments_{name}",
                   tip)  # fmt: skip


def _to_path(window: FontWindow) -> None:
    from ...model.document.outlines import Path as PathNode
    from ...model.outline.paths import fields_of

    drawn, face = window.desk.drawn, window.desk.face
    if drawn is None or face is None or not drawn.outline.contours:
        raise Refusal("this glyph is empty")
    scale = EM / face.units_per_em
    outline = drawn.outline.transformed(((scale, 0.0, 0.0), (0.0, scale, 0.0)))
    window.desk.session.do("insert", PathNode(**fields_of(outline)).named(window.desk.glyph), label="Glyph as path")


def _no_edits(window: FontWindow) -> str | None:
    return None if window.desk.edited else "no glyph of this font is edited"


GLYPH_COMMANDS: tuple[Command, ...] = (
    Command("glyph_undo", "Undo", "Glyph", lambda w: done(w.desk.session.undo()),
            lambda w: None if w.desk.session.undo_label else "there is nothing to undo", "Ctrl+Z", "undo",
            "Take back the last step of the document"),
    Command("glyph_redo", "Redo", "Glyph", lambda w: done(w.desk.session.redo()),
            lambda w: None if w.desk.session.redo_label else "there is nothing to redo", "Ctrl+Shift+Z; Ctrl+Y", "redo",
            "Do the last undone step again"),
    Command("glyph_insert", "Insert nodes", "Glyph", _edit("Insert nodes", glyph_edits.divided), _chosen(2), "Ins",
            "insert_nodes", "A node in the middle of each segment whose two nodes are chosen; the shape stays"),
    Command("glyph_delete", "Delete nodes", "Glyph", _edit("Delete nodes", glyph_edits.deleted), _chosen(1),
            "Del; Backspace", "delete_nodes", "Take the chosen nodes out, the curve staying as near as may be"),
    _kind("cusp", "Cusp", Node.CUSP, "Ctrl+Alt+1", "The handles of the chosen nodes go their own ways"),
    _kind("smooth", "Smooth", Node.SMOOTH, "Ctrl+Alt+2", "The handles of the chosen nodes lie on one line"),
    _kind("symmetric", "Symmetric", Node.SYMMETRIC, "Ctrl+Alt+3",
          "The handles of the chosen nodes lie on one line and are of one length"),
    _segment("line", "Line", Kind.LINE, "L", "Straight lines between the chosen nodes"),
    _segment("quad", "Quadratic", Kind.QUADRATIC, "Q", "Curves of one handle, as TrueType has them"),
    _segment("cubic", "Cubic", Kind.CUBIC, "U", "Curves of two handles, as PostScript fonts have them"),
    Command("glyph_reverse", "Reverse contours", "Glyph", _edit("Reverse contours", glyph_edits.turned_round),
            _chosen(0), "", "reverse_contours", "Run the contours of the chosen nodes, or all, through the other way:\n"
            "a contour inside another is a hole where it goes the other way round"),
    Command("glyph_all", "Choose all nodes", "Glyph", lambda w: w.canvas.choose_all(), _chosen(0), "",
            "select_all", "Choose all nodes of the glyph; on the canvas by Ctrl+A"),
    Command("glyph_fit", "Fit", "Glyph", lambda w: w.canvas.fit(), _chosen(0), "F", "fit", "Show the whole glyph"),
    Command("glyph_to_path", "Glyph as path", "Glyph", _to_path, _chosen(0), "", "convert_to_path",
            "Put the glyph into the document as a path of its own, of a size of 10 mm to the em"),
    Command("glyph_save_font", "Save font …", "Glyph", lambda w: w.save(),
            lambda w: None if w.desk.face is not None else "choose a font first", "Ctrl+S", "save_font",
            "Write the font with its edited glyphs as a TTF, OTF or PFB file"),
    Command("glyph_reset_all", "Reset all glyphs", "Glyph", lambda w: w.desk.reset(sorted(w.desk.edited)), _no_edits,
            "", "reset_glyphs", "Give all glyphs the shapes of the font's file again"),
)  # fmt: skip
NODE_ROWS = (
    ("glyph_cusp", "glyph_smooth", "glyph_symmetric", "", "glyph_line", "glyph_quad", "glyph_cubic"),
    ("glyph_insert", "glyph_delete", "", "glyph_reverse"),
)
TOOL_BAR = ("glyph_undo", "glyph_redo", "", "glyph_fit", "", "glyph_to_path", "glyph_save_font", "glyph_reset_all")
