"""The Mesh panel in the real window."""

from solidtree.model.script import box, cylinder, document_of

pytest_plugins = ["window_driver"]
PART = box(20).named("block") - cylinder(6, 60, centred=True, segments=24).at(10, 10, 10).named("drill")


def opened(make_window, *solids):
    """The window with its panel, once the mesh is there."""
    driver = make_window(document_of(*(solids or (PART,))))
    driver.look_from("iso")
    driver.keys("Alt+W", driver.window.viewport)
    inspector = driver.window.mesh.inspector
    driver.qtbot.waitUntil(lambda: inspector.source.settled and inspector.mesh is not None, timeout=15000)
    return driver, inspector


def test_shot(make_window):
    from PySide6.QtWidgets import QApplication

    driver, inspector = opened(make_window)
    w = driver.window
    for theme in ("light", "dark"):
        w.theme.choose(theme)
        driver.click_at((20, 10, 20)) if theme == "light" else None
        w.docks["Mesh"].resize(420, 600)
        w.resizeDocks([w.docks["Mesh"]], [430], __import__("PySide6.QtCore").QtCore.Qt.Orientation.Horizontal)
        driver.qtbot.wait(400)
        QApplication.primaryScreen().grabWindow(0).save(f"/tmp/insp_{theme}.png")
    print(inspector.page.looked.text(), inspector.chosen.edge)
