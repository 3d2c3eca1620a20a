"""DXF in: the outlines of the model space in millimetres, by ezdxf; loose ends joined, blocks put in their places."""

from __future__ import annotations

import io
import logging
import re
from math import cos, radians, sin
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from ...document.errors import Refusal
from ..parts import words_of
from .drawing_shapes import Drawing, Notes, Shape
from .dxf_chains import Joined, Piece, join
from .dxf_entities import READ, pieces_of

if TYPE_CHECKING:
    from ...path.path import Command, Floats

GAP = 0.01
"""mm; ends that are nearer to each other are joined."""
TOLERANCE = 1e-3
"""mm that the cubics of arcs may leave them."""
MOST_ENTITIES = 100_000
"""That inserted blocks may come to; a file with BOMB of them is not even walked."""
BOMB = 10 * MOST_ENTITIES
TOO_MANY = f"inserts blocks of more than {MOST_ENTITIES:,} entities in all; simplify the file"
MOST_NESTED = 50
_HEAD = 1_000_000
_FAULTS = (Exception,)
"""What ezdxf raises on damaged files is not told beforehand."""
_QUIET = {"TEXT", "MTEXT", "DIMENSION", "POINT", "ATTDEF", "ATTRIB", "LEADER", "MULTILEADER", "VIEWPORT", "SEQEND"}
_UNITS = {
    1: 25.4, 2: 304.8, 3: 1_609_344.0, 4: 1.0, 5: 10.0, 6: 1000.0, 7: 1e6, 8: 25.4e-6, 9: 0.0254, 10: 914.4,
    11: 1e-7, 12: 1e-6, 13: 1e-3, 14: 100.0, 15: 1e4, 16: 1e5, 17: 1e12, 21: 1200.0 / 3937.0 * 1000.0,
}  # fmt: skip
"""mm of a unit by $INSUNITS: inch, foot, mile, mm, cm, m, km, microinch, mil, yard, ångström ... US survey foot."""


def read_dxf(data: bytes, tolerance: float | None = TOLERANCE, gap: float = GAP) -> Drawing:
    """For each layer a shape of its closed contours, filled by the even-odd rule, and one of what stays open.

    Hatches are shapes of their own. Arcs become cubics within `tolerance` mm (None: quarter by quarter, 2.73e-4 of the
    radius); splines stay B-splines. What is not flat is seen from above. Layers that are off or frozen are left out.
    Ends nearer than `gap` mm are joined; see `dxf_chains.join`. Without a unit a unit is a millimetre. Raises Refusal.
    """
    document = _opened(data)
    reader = _Reader(document, tolerance, gap)
    with np.errstate(all="ignore"):  # what is too far is refused by its points
        reader.walk()
        return reader.drawing()


def _opened(data: bytes) -> Any:
    log = logging.getLogger("ezdxf")
    before = log.disabled
    log.disabled = True
    try:
        try:
            return _read(data)
        except _FAULTS:
            from ezdxf.recover import read

            return read(io.BytesIO(data))[0]  # repairs what it can, and drops what it cannot
    except MemoryError:
        raise
    except _FAULTS as error:
        if not re.match(rb"\s*(?:0|999)\s*\n|AutoCAD Binary DXF", data[:200]):
            raise Refusal(f"is no DXF file: it begins with {words_of(data[:40])}") from None
        why = f" ({error!s:.120})" if type(error).__module__.startswith("ezdxf") else ""
        raise Refusal(f"is a DXF file that cannot be read{why}; save it again as DXF 2010") from None
    finally:
        log.disabled = before


def _read(data: bytes) -> Any:
    """The document by ezdxf's strict reader, of a binary or a text file."""
    from ezdxf.document import Drawing as Document
    from ezdxf.filemanagement import dxf_stream_info
    from ezdxf.lldxf.tagger import binary_tags_loader

    if data.startswith(b"AutoCAD Binary DXF"):
        return Document.load(binary_tags_loader(data, errors="surrogateescape"))
    encoding = dxf_stream_info(io.StringIO(data[:_HEAD].decode("utf-8", "ignore"))).encoding
    return Document.read(io.TextIOWrapper(io.BytesIO(data), encoding=encoding, errors="surrogateescape"))


_Visit: TypeAlias = "tuple[Any, Floats, str, tuple[str, ...]]"
"""An entity, its matrix, the layer of the INSERT that shows it, and the blocks it lies in."""


class _Reader:
    def __init__(self, document: Any, tolerance: float | None, gap: float) -> None:
        self.document, self.tolerance, self.gap = document, tolerance, gap
        self.notes = Notes()
        self.loose: dict[str, list[Piece]] = {}
        self.hatches: list[tuple[str, list[Piece]]] = []
        unit = int(document.header.get("$INSUNITS", 0))
        self.unit = _UNITS.get(unit, 1.0)
        if unit not in _UNITS:
            self.notes.add("the file names no unit that is known; its numbers are taken for millimetres")
        self._hidden: dict[str, bool] = {}
        self._frames: dict[Any, tuple[list[Any], list[Floats]]] = {}
        """Of each INSERT the block's entities and the matrices of its copies: a block may be shown many times."""

    def walk(self) -> None:
        """Gathers the pieces of every entity, those in blocks where they are inserted."""
        if self._shown() > BOMB:
            raise Refusal(TOO_MANY)
        world = np.diag((self.unit, self.unit, self.unit, 1.0))
        stack: list[_Visit] = [(entity, world, "", ()) for entity in reversed(list(self.document.modelspace()))]
        inserted = 0
        while stack:
            entity, matrix, outer, blocks = stack.pop()
            layer = entity.dxf.get("layer", "0")
            layer = layer.encode("utf-8", "replace").decode()
            # What lies on layer 0 of a block is on the layer of its INSERT.
            layer = outer if layer == "0" and outer else layer
            kind = entity.dxftype()
            if entity.dxf.get("invisible", 0) or self._is_hidden(layer):
                self.notes.add("hidden entities (layers that are off or frozen) are left out")
            elif kind == "INSERT":
                inner = self._inserted(entity, matrix, layer, blocks)
                inserted += len(inner)
                if inserted > MOST_ENTITIES:
                    raise Refusal(TOO_MANY)
                stack += inner
            elif kind in READ:
                self._take(entity, matrix, layer)
            elif kind not in _QUIET:
                self.notes.add(f"{kind:.40} is left out: it is no outline")

    def _shown(self) -> float:
        """How many entities the blocks insert in all, hidden ones counted, too; blocks within themselves are not."""
        inner: dict[str, list[str]] = {}
        shown: dict[str, float] = {}
        waiting = [("", False)]  # the name of a block, "" for the model space, and whether what it inserts is counted
        while waiting:
            name, ready = waiting.pop()
            if ready:
                sizes = (len(self.document.blocks.get(block)) + shown.get(block, 0.0) for block in inner[name])
                shown[name] = float(sum(sizes))
            elif name not in inner:
                entities = self.document.blocks.get(name) if name else self.document.modelspace()
                named = (entity.dxf.get("name", "") for entity in entities if entity.dxftype() == "INSERT")
                inner[name] = [block for block in named if block and block in self.document.blocks]
                waiting += [(name, True), *((block, False) for block in inner[name])]
        return shown[""]

    def _is_hidden(self, layer: str) -> bool:
        if layer not in self._hidden:
            table = self.document.layers
            entry = table.get(layer) if table.has_entry(layer) else None
            self._hidden[layer] = entry is not None and bool(entry.is_off() or entry.is_frozen())
        return self._hidden[layer]

    def _take(self, entity: Any, matrix: Floats, layer: str) -> None:
        kind = entity.dxftype()
        try:
            pieces = pieces_of(entity, matrix, self.tolerance)
        except Refusal as refusal:
            self.notes.add(f"{kind} #{entity.dxf.get('handle', '?')} on layer “{layer:.40}” is left out: it {refusal}")
            return
        except (ValueError, LookupError, TypeError, AttributeError, ArithmeticError):
            self.notes.add(f"{kind} #{entity.dxf.get('handle', '?')} on layer “{layer:.40}” is damaged and left out")
            return
        if kind == "HATCH":
            self.hatches.append((layer, pieces))
        else:
            self.loose.setdefault(layer, []).extend(pieces)

    def _inserted(self, insert: Any, matrix: Floats, layer: str, blocks: tuple[str, ...]) -> list[_Visit]:
        name = insert.dxf.get("name", "")
        block = insert.block()
        if block is None:
            self.notes.add(f"the block “{name:.40}” is inserted, but is not in the file")
            return []
        if name in blocks:
            self.notes.add(f"the block “{name:.40}” would hold itself; it is left out there")
            return []
        if len(blocks) >= MOST_NESTED:
            raise Refusal(f"inserts blocks within blocks more than {MOST_NESTED} deep")
        if insert not in self._frames:
            self._frames[insert] = self._copies(insert, name, list(block))
        entities, frames = self._frames[insert]
        path = (*blocks, name)
        return [(entity, moved, layer, path) for frame in frames for moved in (frame @ matrix,) for entity in entities]

    def _copies(self, insert: Any, name: str, entities: list[Any]) -> tuple[list[Any], list[Floats]]:
        """The entities of a block, the last one first, and the matrices (4, 4) of its copies."""
        columns, rows = (max(int(insert.dxf.get(f"{what}_count", 1)), 1) for what in ("column", "row"))
        if columns * rows * max(len(entities), 1) > MOST_ENTITIES:
            raise Refusal(f"inserts the block “{name:.40}” {columns * rows:,} times; more than is read")
        place = np.array(list(insert.matrix44()), float).reshape(4, 4)
        angle = radians(insert.dxf.get("rotation", 0.0))
        ocs = insert.ocs()
        # The steps of the array turn with the INSERT, but are not scaled.
        steps = [(cos(angle), sin(angle), 0.0), (-sin(angle), cos(angle), 0.0)]
        across, along = (np.array(tuple(ocs.to_wcs(step))) for step in steps)
        across, along = across * insert.dxf.get("column_spacing", 0.0), along * insert.dxf.get("row_spacing", 0.0)
        cells = {tuple(column * across + row * along) for row in range(rows) for column in range(columns)}
        frames = []
        for offset in sorted(cells):
            moved = place.copy()
            moved[3, :3] += offset
            frames.append(moved)
        return entities[::-1], frames

    def drawing(self) -> Drawing:
        shapes = []
        for layer, pieces in self.hatches:
            joined = join(pieces, self.gap)
            if joined.open:
                self.notes.add(f"a hatch on layer “{layer:.40}” has a boundary that does not close")
            if joined.closed:
                shapes.append(self._shape(layer, joined.closed, True))
        for layer, pieces in self.loose.items():
            joined = join(pieces, self.gap)
            self._note(layer, joined)
            shapes += [
                self._shape(layer, group, filled)
                for group, filled in ((joined.closed, True), (joined.open, False))
                if group
            ]
        return Drawing(tuple(shapes), self.notes.lines())

    def _note(self, layer: str, joined: Joined) -> None:
        if joined.doubled:
            self.notes.add(f"layer “{layer:.40}”: {joined.doubled:,} lines that lie on others are left out")
        if joined.open:
            x, y = joined.open[0].start
            what = (
                f"{joined.dividing:,} of them lead across closed ones"
                if joined.dividing
                else f"the first at ({x:.6g}, {y:.6g})"
            )
            self.notes.add(f"layer “{layer:.40}”: {len(joined.open):,} outlines do not close, {what}")

    def _shape(self, layer: str, pieces: list[Piece], filled: bool) -> Shape:
        contours = []
        for piece in pieces:
            contour: list[Command] = [("move", piece.start), *piece.commands]
            if piece.closed:
                # The line that leads back is the closing itself.
                if contour[-1][0] == "line" and len(contour) > 2 and (contour[-1][1] == piece.start).all():
                    contour.pop()
                contour.append(("close",))
            contours.append(tuple(contour))
        return Shape(tuple(contours), "evenodd", filled, not filled, 0.0, layer[:200], self._colour(layer))

    def _colour(self, layer: str) -> str | None:
        from ezdxf.colors import aci2rgb

        table = self.document.layers
        if not table.has_entry(layer):
            return None
        entry = table.get(layer)
        if entry.rgb is not None:
            return "#{:02x}{:02x}{:02x}".format(*entry.rgb)
        number = abs(int(entry.dxf.get("color", 7)))
        # 7 is black on white and white on black: no colour of its own.
        return "#{:02x}{:02x}{:02x}".format(*aci2rgb(number)) if 0 < number < 256 and number != 7 else None
