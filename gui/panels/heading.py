"""Headings inside a page of a panel."""

from __future__ import annotations

from PySide6.QtWidgets import QLabel, QWidget


def heading(title: str, parent: QWidget) -> QLabel:
    label = QLabel(title, parent)
    label.setProperty("heading", True)
    label.setContentsMargins(0, 8, 0, 0)
    return label
