"""Pages as PDF by reportlab: paths and real text, the same bytes every time."""

from __future__ import annotations

from importlib.resources import files
from importlib.util import find_spec
from typing import TYPE_CHECKING, Any, BinaryIO

from ..project.disk import one_line
from .page import EM, Fill, Page, Strokes, Text, walk
from .svg import SEAM

if TYPE_CHECKING:
    from reportlab.pdfgen.canvas import Canvas

POINTS = 72.0 / 25.4  # a mm
LATIN, OTHER = "Helvetica", "DejaVuSans"
FLATNESS = 4  # decimals of a point


def write_pdf(stream: BinaryIO, page: Page) -> None:
    """Write the page; words that Helvetica lacks are set in DejaVu Sans, which goes into the file."""
    from reportlab.pdfgen.canvas import Canvas

    size = (page.width * POINTS, page.height * POINTS)
    canvas = Canvas(stream, pagesize=size, pageCompression=1, invariant=1)
    canvas.setTitle(one_line(page.title) or "Drawing")
    canvas.setAuthor("")
    canvas.setSubject("")
    canvas.setCreator("Solidtree")
    canvas.scale(POINTS, POINTS)
    canvas.setLineCap(1)
    canvas.setLineJoin(1)
    for group in walk(page.groups):
        for item in group.items:
            if isinstance(item, Text):
                _text(canvas, item)
            elif isinstance(item, Fill):
                _fill(canvas, item)
            else:
                _strokes(canvas, item)
    canvas.showPage()
    canvas.save()


def _strokes(canvas: Canvas, item: Strokes) -> None:
    canvas.setStrokeColor(_colour(item.pen.colour))
    canvas.setLineWidth(item.pen.weight)
    canvas.setLineCap(0 if item.pen.dash else 1)
    canvas.setDash(list(item.pen.dash))
    path: Any = canvas.beginPath()
    for line in item.lines:
        points = line.tolist()
        closed = len(points) > 3 and points[0] == points[-1]
        path.moveTo(*points[0])
        for point in points[1 : -1 if closed else None]:
            path.lineTo(*point)
        if closed:
            path.close()
    canvas.drawPath(path, stroke=1, fill=0)


def _fill(canvas: Canvas, item: Fill) -> None:
    face = item.role == "face"
    canvas.setFillColor(_colour(item.colour))
    canvas.setStrokeColor(_colour(item.colour))
    canvas.setLineWidth(SEAM)
    canvas.setDash([])
    path: Any = canvas.beginPath()
    for contour in item.contours:
        points = contour.tolist()
        path.moveTo(*points[0])
        for point in points[1:]:
            path.lineTo(*point)
        path.close()
    canvas.drawPath(path, stroke=int(face), fill=1, fillMode=0)  # even-odd


def _text(canvas: Canvas, item: Text) -> None:
    words = one_line(item.words)
    canvas.saveState()
    canvas.setFillColor(_colour(item.colour))
    canvas.setFont(_font_for(words), item.height * EM)
    canvas.translate(*item.at)
    canvas.rotate(item.angle)
    {"start": canvas.drawString, "middle": canvas.drawCentredString, "end": canvas.drawRightString}[item.anchor](
        0, 0, words
    )
    canvas.restoreState()


def _font_for(words: str) -> str:
    """The font that has the letters of these words, as far as one is there."""
    try:
        words.encode("cp1252")
    except UnicodeEncodeError:
        return _registered()
    return LATIN


def _registered() -> str:
    from reportlab.pdfbase import pdfmetrics
    from reportlab.pdfbase.ttfonts import TTFont

    if OTHER in pdfmetrics.getRegisteredFontNames():
        return OTHER
    if find_spec("matplotlib") is None:  # it comes with VTK
        return LATIN
    pdfmetrics.registerFont(TTFont(OTHER, str(files("matplotlib").joinpath(f"mpl-data/fonts/ttf/{OTHER}.ttf"))))
    return OTHER


def _colour(colour: str) -> Any:
    from reportlab.lib.colors import HexColor

    return HexColor(colour)
