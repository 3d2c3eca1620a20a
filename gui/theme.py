"""Light and dark: colours, palette and style sheet, following the system unless the user chose."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from importlib.resources import files
from pathlib import Path
from string import Template

from PySide6.QtCore import QObject, Qt, Signal
from PySide6.QtGui import QColor, QPalette
from PySide6.QtWidgets import QApplication

from .. import resources
from .settings import Settings


@dataclass(frozen=True, slots=True)
class Colours:
    """Colours as #rrggbb. Text on its ground has a contrast of at least 4.5 to 1 (WCAG 2.2, AA)."""

    window: str
    ground: str  # of lists and fields
    raised: str  # of buttons and cards
    text: str
    muted: str
    disabled: str
    border: str
    hover: str
    checked: str  # of a switch that is on
    accent: str
    on_accent: str
    link: str
    error: str
    error_ground: str
    warning: str


LIGHT = Colours(
    window="#f2f4f7", ground="#ffffff", raised="#fbfcfd", text="#1d242d", muted="#566170", disabled="#98a1ac",
    border="#d0d7df", hover="#e3e9f0", checked="#cfdff7", accent="#2563c4", on_accent="#ffffff", link="#1f5bb8",
    error="#b3261e", error_ground="#fdeceb", warning="#8a5a00",
)  # fmt: skip
DARK = Colours(
    window="#24282e", ground="#1b1e23", raised="#2e333b", text="#e3e7ec", muted="#a4adb8", disabled="#6b7480",
    border="#3b424c", hover="#333a44", checked="#2d4a73", accent="#2f6fca", on_accent="#ffffff", link="#7fb2f2",
    error="#ff8f86", error_ground="#3d2826", warning="#edb661",
)  # fmt: skip


_shown = LIGHT


def colours_now() -> Colours:
    """The colours that the application shows."""
    return _shown


class Theme(QObject):
    """The look of the whole application. `changed` tells `light` or `dark`."""

    changed = Signal(str)

    def __init__(self, application: QApplication, settings: Settings, parent: QObject | None = None) -> None:
        super().__init__(parent or application)
        self._application = application
        self._settings = settings
        self._name = ""
        application.setStyle("Fusion")
        application.styleHints().colorSchemeChanged.connect(self._follow)
        self._apply()

    @property
    def choice(self) -> str:
        """`system`, `light` or `dark`."""
        return self._settings.theme

    @property
    def name(self) -> str:
        """`light` or `dark`: what is shown."""
        return self._name

    @property
    def colours(self) -> Colours:
        return DARK if self._name == "dark" else LIGHT

    def choose(self, choice: str) -> None:
        self._settings.theme = choice
        self._apply()

    def _follow(self) -> None:
        if self.choice == "system":
            self._apply()

    def _apply(self) -> None:
        hints = self._application.styleHints()
        schemes = {"light": Qt.ColorScheme.Light, "dark": Qt.ColorScheme.Dark}
        wanted = schemes.get(self.choice)
        if wanted is None:
            hints.unsetColorScheme()
        elif hints.colorScheme() != wanted:
            hints.setColorScheme(wanted)
        dark = self.choice == "dark" or (self.choice == "system" and hints.colorScheme() == Qt.ColorScheme.Dark)
        name = "dark" if dark else "light"
        if name == self._name:
            return
        global _shown
        self._name = name
        _shown = self.colours
        self._application.setPalette(palette_of(self.colours))
        self._application.setStyleSheet(style_sheet(self.colours))
        self.changed.emit(name)


def palette_of(colours: Colours) -> QPalette:
    palette = QPalette()
    roles = QPalette.ColorRole
    for role, colour in (
        (roles.Window, colours.window),
        (roles.WindowText, colours.text),
        (roles.Base, colours.ground),
        (roles.AlternateBase, colours.window),
        (roles.Text, colours.text),
        (roles.PlaceholderText, colours.muted),
        (roles.Button, colours.raised),
        (roles.ButtonText, colours.text),
        (roles.BrightText, colours.error),
        (roles.ToolTipBase, colours.raised),
        (roles.ToolTipText, colours.text),
        (roles.Highlight, colours.accent),
        (roles.HighlightedText, colours.on_accent),
        (roles.Accent, colours.accent),
        (roles.Link, colours.link),
        (roles.LinkVisited, colours.link),
        (roles.Light, colours.raised),
        (roles.Midlight, colours.hover),
        (roles.Mid, colours.border),
        (roles.Dark, colours.border),
        (roles.Shadow, colours.border),
    ):
        palette.setColor(role, QColor(colour))
    for role in (roles.WindowText, roles.Text, roles.ButtonText, roles.HighlightedText):
        palette.setColor(QPalette.ColorGroup.Disabled, role, QColor(colours.disabled))
    return palette


def style_sheet(colours: Colours) -> str:
    file = files(resources).joinpath("styles", "window.qss")
    check = files(resources).joinpath("icons", "check.svg")
    return Template(file.read_text(encoding="utf-8")).substitute(asdict(colours), check=Path(str(check)).as_posix())
