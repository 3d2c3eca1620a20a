"""The editor of one material: colour, shares of light, shading, bitmaps."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtWidgets import QWidget

from ...model.document.errors import Refusal
from ...model.surface.material import BUMPS, WRAPS
from ..panels.number_field import Steps
from ..panels.property_edit import sentence
from .bitmap_row import BitmapRow
from .rows import MemberForm

if TYPE_CHECKING:
    from ..window import MainWindow

SHARE = Steps(0.05, 0.01, 0.1, 0.0, maximum=1.0)
SHININESS = Steps(1.0, 0.1, 10.0, 0.0, maximum=1000.0)
HEIGHT = Steps(0.1, 0.01, 1.0)
SHADING_WORDS = (
    ("", "as the document"),
    ("flat", "flat"),
    ("gouraud", "Gouraud"),
    ("gouraud-diffuse", "Gouraud without highlights"),
    ("phong", "Phong"),
)
WRAP_WORDS = {"repeat": "repeated", "mirror": "repeated, mirrored", "clamp": "once, its border goes on"}
BUMP_WORDS = {"heights": "heights, white is high", "normals": "normals of a normal map"}
BITMAP_TIPS = {
    "texture": "The bitmap on the faces; with a colour the two are multiplied",
    "bump": "A bitmap that bends the light as if the face had heights",
    "reflection": "A panorama, 360 by 180 degrees, that the face mirrors",
    "light_map": "A bitmap that scales the light that arrives; white is all of it",
}


class MaterialForm(MemberForm):
    """Rows for the bitmaps' settings are there when the bitmap is."""

    def __init__(self, window: MainWindow, parent: QWidget | None = None) -> None:
        super().__init__(window.session, "set_material", parent)
        self._window = window
        self.bitmaps: dict[str, BitmapRow] = {}
        self.colour("colour", "Colour", "empty: that of the node, or white under a texture", "as the node")
        self.slider("ambient", "Ambient", (0.0, 0.22, 1.0), "The share of ambient light that it gives back", SHARE)
        self.slider("diffuse", "Diffuse", (0.0, 0.9, 1.0), "The share of light that it gives back all around", SHARE)
        self.slider("specular", "Specular", (0.0, 0.16, 1.0), "The share of light that makes the highlight", SHARE)
        self.slider("shininess", "Shininess", (1.0, 24.0, 200.0),
                    "The exponent of the highlight: the more, the smaller it is", SHININESS)  # fmt: skip
        self.slider("opacity", "Opacity", (0.0, 1.0, 1.0), "1 hides what is behind, 0 is not seen at all", SHARE)
        self.choice("shading", "Shading", SHADING_WORDS, "One intensity a face, at the vertices, or at every pixel")
        self.heading("Texture")
        self._bitmap("texture", "Bitmap")
        wraps = tuple((wrap, WRAP_WORDS[wrap]) for wrap in WRAPS)
        kinds = tuple((kind, BUMP_WORDS[kind]) for kind in BUMPS)
        with self.where(lambda material: bool(material.texture)):
            self.colour("key", "Colour key", "texels of this colour are transparent; empty: none", "none")
            self.choice("wrap", "Beyond it", wraps, "What lies beside one copy")
        self.heading("Bump map")
        self._bitmap("bump", "Bitmap")
        with self.where(lambda material: bool(material.bump)):
            self.choice("bump_kind", "Holds", kinds, "What the bitmap tells")
            self.slider("bump_height", "Height", (-5.0, 1.0, 5.0),
                        "Millimetres from black to white; of a normal map a factor", HEIGHT)  # fmt: skip
        self.heading("Mirror and light map")
        self._bitmap("reflection", "Panorama")
        with self.where(lambda material: bool(material.reflection)):
            self.slider("reflectivity", "Share", (0.0, 0.3, 1.0), "How much of the panorama is mirrored", SHARE)
        self._bitmap("light_map", "Light map")

    def _bitmap(self, field: str, label: str) -> None:
        row = BitmapRow(self._window, field, BITMAP_TIPS[field], self)
        row.setObjectName(field)
        row.chosen.connect(lambda name, sha: self._set_bitmap(name, field, label, sha))
        self.bitmaps[field] = row
        self.shows.append(row.show_material)
        self.line(label, row, BITMAP_TIPS[field])

    def _set_bitmap(self, name: str, field: str, label: str, sha: str) -> None:
        word = label.lower() if label != "Bitmap" else field
        try:
            self.session.do("set_material", name, label=f"{'Change' if sha else 'Take off'} {word}", **{field: sha})
        except Refusal as refusal:
            self.refused.emit(sentence(refusal))
