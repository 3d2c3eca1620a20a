"""Buttons of the panel's bars."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QToolButton, QWidget

from ..icons import icon


def flat_button(action: QAction, parent: QWidget, text: str = "") -> QToolButton:
    """A command's button, with its picture alone or with a short text beside it."""
    button = QToolButton(parent)
    button.setProperty("flat", True)
    button.setDefaultAction(action)
    if text:
        action.setIconText(text)
        button.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextBesideIcon)
    return button


def menu_button(text: str, tip: str, parent: QWidget) -> QToolButton:
    """A button that opens a menu of what can be added."""
    button = QToolButton(parent)
    button.setProperty("flat", True)
    button.setIcon(icon("add"))
    button.setText(text)
    button.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextBesideIcon)
    button.setToolTip(tip)
    button.setPopupMode(QToolButton.ToolButtonPopupMode.InstantPopup)
    return button
