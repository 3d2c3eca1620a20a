"""What is tried out in the Pipeline panel: matrices other than the picture's, and planes that do not clip."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from types import MappingProxyType

import numpy as np
from numpy.typing import ArrayLike
from PySide6.QtCore import QObject, Signal

from ...model.pipeline.clipping import NAMES as PLANE_NAMES
from ...model.pipeline.clipping import PLANES
from ...model.pipeline.matrices import NAMES, Lens, Matrices, checked, lens_of
from ...model.pipeline.stages import Floats


class Trial(QObject):
    """Of the four matrices those that are not the picture's, and which of the six planes clip. `changed` tells that
    they are others."""

    changed = Signal()

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._matrices: dict[str, Floats] = {}
        self._planes = np.ones(len(PLANES), bool)

    @property
    def matrices(self) -> Mapping[str, Floats]:
        """By name, those that are changed here."""
        return MappingProxyType(self._matrices)

    @property
    def planes(self) -> Floats:
        """(p, 4) those that clip."""
        return PLANES[self._planes]

    @property
    def active(self) -> bool:
        """Whether anything is changed here."""
        return bool(self._matrices) or not self._planes.all()

    def clips(self, plane: str) -> bool:
        return bool(self._planes[PLANE_NAMES.index(plane)])

    @property
    def words(self) -> str:
        """What is changed here, "" for nothing."""
        parts = [name for name in NAMES if name in self._matrices]
        off = [f"{name} plane off" for name in PLANE_NAMES if not self.clips(name)]
        return ", ".join([*parts, *off])

    def of(self, live: Matrices) -> Matrices:
        """The matrices of the picture, with those that are changed here."""
        return replace(live, **self._matrices)

    def set_matrix(self, name: str, matrix: ArrayLike) -> None:
        """Try another matrix. Raises Refusal for one that cannot be."""
        self._matrices[name] = checked(matrix, name)
        self.changed.emit()

    def set_lens(self, live: Matrices, angle: float | None = None, **changes: float) -> None:
        """Try another angle in degrees, near or far plane; the other numbers are those tried now. Raises Refusal."""
        lens: Lens = lens_of(self.of(live).projection)
        if angle is not None:
            changes["angle"] = angle
        self.set_matrix("projection", replace(lens, **changes).matrix())

    def set_clips(self, plane: str, clips: bool) -> None:
        """Whether a plane cuts off what lies beyond it."""
        self._planes[PLANE_NAMES.index(plane)] = clips
        self.changed.emit()

    def reset(self, name: str = "") -> None:
        """One matrix as the picture has it again, or all of them and the planes."""
        if name:
            self._matrices.pop(name, None)
        else:
            self._matrices.clear()
            self._planes[:] = True
        self.changed.emit()
