"""What all tests share: the corpus, a home of their own, and the check that nothing is left behind."""

import gc
import os
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import hypothesis
import pytest

# The same examples every time: what fails here fails everywhere.
hypothesis.settings.register_profile("fixed", derandomize=True)
hypothesis.settings.load_profile("fixed")

# Before anything asks for a user folder: settings, recent files and caches of the tests stay out of the real ones.
_home = tempfile.TemporaryDirectory(prefix="solidtree-tests-", ignore_cleanup_errors=True)
for _name in ("CONFIG", "DATA", "STATE", "CACHE"):
    os.environ[f"XDG_{_name}_HOME"] = str(Path(_home.name, _name.lower()))
os.environ.setdefault("XDG_RUNTIME_DIR", _home.name)


@pytest.fixture(scope="session")
def corpus() -> Path:
    """The folder of third-party files: $SOLIDTREE_CORPUS, else ../shared/corpus beside the repository."""
    root = Path(__file__).parent.parent
    folder = Path(os.environ.get("SOLIDTREE_CORPUS") or root.parent / "shared" / "corpus")
    if not folder.is_dir():
        pytest.skip(f"no corpus at {folder}; SOLIDTREE_CORPUS names its place")
    return folder


@pytest.fixture
def solidtree(capsys: pytest.CaptureFixture[str]) -> Callable[..., tuple[int, str, str]]:
    """Run a command of the command line in this process: (status, standard output, standard error)."""
    from solidtree.gui.command_line import main

    def run(*words: object) -> tuple[int, str, str]:
        try:
            status = main([str(word) for word in words])
        except SystemExit as stop:
            status = stop.code
        out, err = capsys.readouterr()
        return status, out, err

    return run


@pytest.fixture(autouse=True)
def nothing_left_behind() -> Iterator[None]:
    """Fails a test that leaves a window or a running process of its own.

    Set up before the other fixtures of a test, so it looks after they have cleaned up. What wider fixtures own was
    there before and does not count.
    """
    widgets, processes = top_level_widgets(), child_processes()
    yield
    if any(widget not in widgets for widget in top_level_widgets()):
        gc.collect()  # closed, and held by a cycle of references alone
    left = [widget for widget in top_level_widgets() if widget not in widgets]
    names = [f"{type(widget).__name__} {widget.objectName() or widget.windowTitle()!r}" for widget in left]
    for widget in left:
        widget.deleteLater()
    deadline = time.monotonic() + 3
    while (running := child_processes().items() - processes.items()) and time.monotonic() < deadline:
        time.sleep(0.02)
    assert not names, f"windows left behind: {', '.join(names)}"
    assert not running, f"processes left behind: {dict(running)}"


def top_level_widgets() -> list:
    """Parentless widgets, once those that asked to be deleted are gone; empty where no application runs."""
    widgets = sys.modules.get("PySide6.QtWidgets")
    if widgets is None or (application := widgets.QApplication.instance()) is None:
        return []
    core = sys.modules["PySide6.QtCore"]
    application.sendPostedEvents(None, core.QEvent.Type.DeferredDelete.value)
    return [
        widget
        for widget in widgets.QApplication.topLevelWidgets()
        if widget.parent() is None and widget.metaObject().className() != "QTipLabel"
    ]


def child_processes() -> dict[int, str]:
    """Command lines of the running children by process id, on Linux; multiprocessing's own tracker left aside."""
    found = {}
    for listing in Path("/proc/self/task").glob("*/children"):
        try:
            numbers = listing.read_text().split()
        except OSError:  # the thread has just ended
            continue
        for number in numbers:
            try:
                state = Path("/proc", number, "stat").read_text().rpartition(")")[2].split()[0]
                command = Path("/proc", number, "cmdline").read_text().replace("\0", " ").strip()
            except OSError:
                continue
            if state != "Z" and "multiprocessing.resource_tracker" not in command:
                found[int(number)] = command
    return found
