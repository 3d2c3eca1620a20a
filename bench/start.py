"""How soon the program is there: imports and the window, against the bare libraries in the same run."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).parent.parent

# The last thing that each window does: once it was painted and nothing waits any more, the process ends.
ENDING = """
import os
from PySide6.QtCore import QEvent, QObject, QTimer
class End(QObject):
    def eventFilter(self, widget, event):
        if event.type() == QEvent.Type.Paint:
            QTimer.singleShot(0, lambda: QTimer.singleShot(0, lambda: os._exit(0)))
        return False
end = End()
"""
BARE = (
    ENDING
    + """
import sys
from PySide6.QtWidgets import QApplication, QMainWindow
import vtkmodules.vtkInteractionStyle, vtkmodules.vtkRenderingOpenGL2
from vtkmodules.qt.QVTKRenderWindowInteractor import QVTKRenderWindowInteractor
from vtkmodules.vtkRenderingCore import vtkRenderer
application = QApplication(sys.argv)
window = QMainWindow()
window.resize(1280, 820)
widget = QVTKRenderWindowInteractor(window)
window.setCentralWidget(widget)
widget.GetRenderWindow().AddRenderer(vtkRenderer())
widget.installEventFilter(end)
window.show()
widget.Initialize()
application.exec()
"""
)
OURS = (
    ENDING
    + """
from solidtree.gui import application as a
from solidtree.gui.settings import Settings
from solidtree.gui.theme import Theme
from solidtree.gui.window import MainWindow
application = a.make_application()
settings = Settings()
window = MainWindow(settings=settings, theme=Theme(application, settings))
a.install_hook(window)
window.viewport.installEventFilter(end)
window.show()
window.start([])
application.exec()
"""
)


def took(code: str, environment: dict[str, str]) -> float:
    start = time.perf_counter()
    done = subprocess.run([sys.executable, "-c", code], env=environment, capture_output=True, text=True, timeout=120)
    if done.returncode:
        sys.exit(done.stderr)
    return time.perf_counter() - start


def compare(title: str, ours: str, bare: str, rounds: int, environment: dict[str, str]) -> None:
    """The least of several turns each, taken alternately; the first turn warms the file cache."""
    turns = [(took(ours, environment), took(bare, environment)) for _ in range(rounds + 1)][1:]
    mine, other = min(turn[0] for turn in turns), min(turn[1] for turn in turns)
    print(f"{title:44} {1e3 * mine:8.0f} ms {1e3 * other:8.0f} ms  {mine / other:5.2f}")


def main() -> None:
    home = tempfile.TemporaryDirectory(prefix="solidtree-bench-")
    environment = {**os.environ, "XDG_CONFIG_HOME": home.name}
    # The libraries come compiled; ours is so from the second turn on.
    environment.pop("PYTHONDONTWRITEBYTECODE", None)
    print(f"{'':44} {'ours':>8}    {'bare':>8}     ratio")
    compare(
        "import solidtree.model.script", "import solidtree.model.script", "import numpy, manifold3d", 9, environment
    )
    if os.environ.get("DISPLAY"):
        compare("process start to usable window", OURS, BARE, 7, environment)
    else:
        print("the window needs a display: xvfb-run python bench/start.py")


if __name__ == "__main__":
    main()
