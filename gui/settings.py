"""What the window remembers between two runs: layout, theme, shortcuts, recent files and commands, the last folder."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path

from PySide6.QtCore import QByteArray, QSettings

RECENT = 10
LAYOUT_VERSION = 6
TOLERANCE = 0.05  # mm, where the user has chosen no other


class Settings:
    """A typed face of QSettings. Nothing here is part of a document."""

    def __init__(self, store: QSettings | None = None) -> None:
        if store is None:
            store = QSettings(QSettings.Format.IniFormat, QSettings.Scope.UserScope, "Solidtree", "Solidtree")
        self._store = store

    @property
    def theme(self) -> str:
        """`system`, `light` or `dark`."""
        value = self._store.value("theme", "system")
        return value if value in ("light", "dark") else "system"

    @theme.setter
    def theme(self, value: str) -> None:
        self._store.setValue("theme", value)

    @property
    def recent(self) -> list[str]:
        """Paths of the files opened last, newest first."""
        value = self._store.value("recent", [])
        paths = [value] if isinstance(value, str) else list(value or [])  # type: ignore[call-overload]
        return [str(path) for path in paths][:RECENT]

    def add_recent(self, path: str | Path) -> None:
        new = str(Path(path).absolute())
        self._store.setValue("recent", [new, *(old for old in self.recent if old != new)][:RECENT])

    def forget_recent(self, path: str | Path | None = None) -> None:
        """Take one path out of the list, or all."""
        self._store.setValue("recent", [] if path is None else [old for old in self.recent if old != str(path)])

    @property
    def recent_commands(self) -> list[str]:
        """Names of the commands run from the palette last, newest first."""
        value = self._store.value("commands", [])
        names = [value] if isinstance(value, str) else list(value or [])  # type: ignore[call-overload]
        return [str(name) for name in names][:RECENT]

    def add_recent_command(self, name: str) -> None:
        self._store.setValue("commands", [name, *(old for old in self.recent_commands if old != name)][:RECENT])

    @property
    def shortcuts(self) -> dict[str, str]:
        """The user's own shortcuts by the command's name, where they are not the defaults; "" for none."""
        try:
            table = json.loads(str(self._store.value("shortcuts", "{}")))
        except ValueError:
            return {}
        return {str(name): str(keys) for name, keys in table.items()} if isinstance(table, dict) else {}

    @shortcuts.setter
    def shortcuts(self, value: dict[str, str]) -> None:
        self._store.setValue("shortcuts", json.dumps(value))

    @property
    def folder(self) -> str:
        """Where the last file was opened or saved, as long as it exists."""
        value = str(self._store.value("folder", ""))
        return value if value and Path(value).is_dir() else str(Path.home())

    @folder.setter
    def folder(self, value: str | Path) -> None:
        self._store.setValue("folder", str(value))

    def layout(self) -> tuple[QByteArray, QByteArray]:
        """The window's geometry and the state of its docks; empty where there are none yet."""
        geometry, state = (self._store.value(f"window/{name}") for name in ("geometry", "state"))
        return (
            geometry if isinstance(geometry, QByteArray) else QByteArray(),
            state if isinstance(state, QByteArray) else QByteArray(),
        )

    def keep_layout(self, geometry: QByteArray, state: QByteArray) -> None:
        self._store.setValue("window/geometry", geometry)
        self._store.setValue("window/state", state)

    def tolerance(self, purpose: str, default: float = TOLERANCE) -> float:
        """Millimetres between curved things and their facets; `purpose` is "display" or "export". Of "faults" those
        within which things should be joined."""
        value = self._store.value(f"tolerance/{purpose}", default)
        try:
            found = float(value)  # type: ignore[arg-type]
        except (TypeError, ValueError):
            return default
        return found if 0.0 < found < float("inf") else default

    def set_tolerance(self, purpose: str, value: float) -> None:
        self._store.setValue(f"tolerance/{purpose}", value)

    def choice(self, name: str, of: Sequence[str]) -> str:
        """One of several ways, the first where none has been chosen."""
        value = self._store.value(f"view/{name}", of[0])
        return value if value in of else of[0]

    def set_choice(self, name: str, value: str) -> None:
        self._store.setValue(f"view/{name}", value)

    def flag(self, name: str, default: bool) -> bool:
        """A switch of the view that outlives the window, such as the grid."""
        return bool(self._store.value(f"view/{name}", default, type=bool))

    def set_flag(self, name: str, value: bool) -> None:
        self._store.setValue(f"view/{name}", value)
