"""The application with its window: `run` shows it at once and fills it in."""

from __future__ import annotations

import gc
import os
import sys
import traceback
from types import TracebackType

from PySide6.QtCore import Qt
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QApplication

from .icons import icon
from .settings import Settings
from .theme import Theme
from .window import MainWindow


def run(paths: list[str]) -> int:
    """Open the window, with these files, until it is closed; the result is the exit status."""
    application = make_application()
    settings = Settings()
    theme = Theme(application, settings)
    window = MainWindow(settings=settings, theme=theme)
    install_hook(window)
    window.viewport.ready.connect(spare_collections)
    window.show()
    window.start(paths)
    return application.exec()


def make_application() -> QApplication:
    """The one QApplication, made where there is none yet."""
    existing = QApplication.instance()
    if isinstance(existing, QApplication):
        return existing
    if sys.platform == "linux" and "QT_QPA_PLATFORM" not in os.environ and os.environ.get("DISPLAY"):
        os.environ["QT_QPA_PLATFORM"] = "xcb"  # VTK draws into X windows only; under Wayland XWayland gives them
    rounding = Qt.HighDpiScaleFactorRoundingPolicy.PassThrough
    QGuiApplication.setHighDpiScaleFactorRoundingPolicy(rounding)
    application = QApplication(sys.argv[:1])
    application.setOrganizationName("Solidtree")
    application.setApplicationName("solidtree")
    application.setApplicationDisplayName("Solidtree")
    application.setDesktopFileName("solidtree")
    application.setWindowIcon(icon("solidtree"))
    return application


def spare_collections() -> None:
    """Leave what the start has made out of later garbage collections: a full one took 40 ms in the middle of a drag."""
    gc.collect()
    gc.freeze()


def install_hook(window: MainWindow) -> None:
    """An error that nobody expected is told in a dialog, and the window goes on."""

    def tell(kind: type[BaseException], error: BaseException, trace: TracebackType | None) -> None:
        if issubclass(kind, KeyboardInterrupt):
            window.close()
            return
        report = "".join(traceback.format_exception(kind, error, trace))
        sys.stderr.write(report)
        from .dialogs import report_fault

        if not any(widget.objectName() == "report" for widget in QApplication.topLevelWidgets()):
            report_fault(window, report)

    sys.excepthook = tell
