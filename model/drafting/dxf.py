"""Pages as DXF (AutoCAD 2010) by ezdxf: the model at its true size in millimetres, and frame and text enlarged with it.

Each node has a layer for its visible edges, and where there are some one for the hidden ones and one for its faces, so
that weight, line type and visibility are the layer's.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, TextIO

from ..document.colours import rgb
from ..exchange.outline_dxf import layer_name
from ..project.disk import one_line
from .page import HIDDEN, Fill, Floats, Group, Page, Pen, Strokes, Text, walk
from .title import AXES

if TYPE_CHECKING:
    from ezdxf.document import Drawing
    from ezdxf.layouts.layout import Modelspace

    from ..solid.provenance import Path

DASHES = {"DASHED": HIDDEN.dash, "CHAIN": AXES.dash}
"""Line types; what has other dashes has one of them at its own size."""
ACROSS = 128
"""The flag of a polyline whose dashes go on across its corners (LWPOLYLINE, group 70)."""
PARTS = {"edges": "", "hidden edges": " hidden", "faces": " faces"}
"""What is put after a node's name, by the role of its group."""


def write_dxf(stream: TextIO, page: Page) -> None:
    """Write the page; its lower left corner is the origin."""
    with _without_time():
        _write(stream, page)


def _write(stream: TextIO, page: Page) -> None:
    from ezdxf.enums import InsertUnits
    from ezdxf.filemanagement import new

    drawing = new("R2010", units=InsertUnits.Millimeters)
    drawing.header["$MEASUREMENT"] = 1
    drawing.header["$LWDISPLAY"] = 1
    drawing.styles.get("Standard").dxf.font = "arial.ttf"
    writer = _Writer(drawing, 1.0 / page.scale)
    for group in walk(page.groups):
        if group.items:
            writer.write(group)
    width, height = page.width / page.scale, page.height / page.scale
    drawing.modelspace().reset_limits((0.0, 0.0), (width, height))
    drawing.set_modelspace_vport(height * 1.02, (width / 2.0, height / 2.0))
    drawing.write(stream)


@contextmanager
def _without_time() -> Iterator[None]:
    """The same bytes every time: ezdxf leaves time and random numbers out where this option says so."""
    from ezdxf import options  # pyright: ignore[reportPrivateImportUsage]

    before = options.write_fixed_meta_data_for_testing
    options.write_fixed_meta_data_for_testing = True
    try:
        yield
    finally:
        options.write_fixed_meta_data_for_testing = before


class _Writer:
    def __init__(self, drawing: Drawing, size: float) -> None:
        self._drawing, self._size = drawing, size
        self._space: Modelspace = drawing.modelspace()
        self._layers: dict[tuple[str, Path, str], str] = {}
        self._taken = {"0", "DEFPOINTS"}  # layers' names are compared without regard to case

    def write(self, group: Group) -> None:
        layer = self._layer(group)
        for item in group.items:
            if isinstance(item, Text):
                self._text(item, layer)
            elif isinstance(item, Fill):
                self._fill(item, layer)
            else:
                for line in item.lines:
                    self._line(line, item.pen, layer)

    def _layer(self, group: Group) -> str:
        """The layer of a group; the groups of one node in several views share it."""
        key = (group.name, group.path, group.role)
        if key not in self._layers:
            name = layer_name(group.name.replace(" / ", " - ") + PARTS.get(group.role, ""), self._taken)
            self._taken.add(name.upper())
            self._layers[key] = name
            layer = self._drawing.layers.add(name)
            strokes = next((item for item in group.items if isinstance(item, Strokes)), None)
            if strokes is not None:
                layer.dxf.lineweight = _hundredths(strokes.pen)
                layer.dxf.linetype = self._line_type(strokes.pen)
        return self._layers[key]

    def _line_type(self, pen: Pen) -> str:
        if not pen.dash:
            return "Continuous"
        name = _type_of(pen)
        if name not in self._drawing.linetypes:
            lengths = [length * self._size * (-1.0 if i % 2 else 1.0) for i, length in enumerate(DASHES[name])]
            self._drawing.linetypes.add(name, [sum(map(abs, lengths)), *lengths], description=name.capitalize())
        return name

    def _line(self, line: Floats, pen: Pen, layer: str) -> None:
        own = self._drawing.layers.get(layer).dxf
        attributes: dict[str, object] = {"layer": layer}
        if own.lineweight != _hundredths(pen):
            attributes["lineweight"] = _hundredths(pen)
        if own.linetype != self._line_type(pen):
            attributes["linetype"] = self._line_type(pen)
        if pen.dash and (size := round(pen.dash[0] / DASHES[_type_of(pen)][0], 4)) != 1.0:
            attributes["ltscale"] = size
        points = (line * self._size).tolist()
        if len(points) == 2:
            self._space.add_line(*points, dxfattribs=attributes)
            return
        closed = len(points) > 3 and points[0] == points[-1]
        if pen.dash:
            attributes["flags"] = ACROSS
        self._space.add_lwpolyline(points[:-1] if closed else points, close=closed, dxfattribs=attributes)

    def _fill(self, item: Fill, layer: str) -> None:
        hatch = self._space.add_hatch(dxfattribs={"layer": layer, "hatch_style": 0})  # nested: even-odd
        hatch.rgb = rgb(item.colour)
        for contour in item.contours:
            hatch.paths.add_polyline_path((contour * self._size).tolist(), is_closed=True)

    def _text(self, item: Text, layer: str) -> None:
        from ezdxf.enums import TextEntityAlignment

        aligned = {"start": "LEFT", "middle": "CENTER", "end": "RIGHT"}[item.anchor]
        text = self._space.add_text(
            _plain(item.words), height=item.height * self._size, rotation=item.angle, dxfattribs={"layer": layer}
        )
        place = (item.at[0] * self._size, item.at[1] * self._size)
        text.set_placement(place, align=TextEntityAlignment[aligned])


def _type_of(pen: Pen) -> str:
    """The line type by the number of its dashes and gaps."""
    return next(name for name, dash in DASHES.items() if len(dash) == len(pen.dash))


def _hundredths(pen: Pen) -> int:
    """A weight in hundredths of a millimetre, as DXF counts it; all of ours are among those that it has."""
    return round(pen.weight * 100.0)


def _plain(words: str) -> str:
    """The words without the marks that TEXT takes for commands."""
    return one_line(words).replace("^", "^ ").replace("%%", "%%%%%%")
