"""The window's commands on materials, textures and lights. They take the MainWindow."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ...model.document.tree import find, unique_name
from ...model.editing.commands import Command
from ..surfaces.panel import LIGHTS, MATERIALS

if TYPE_CHECKING:
    from ..window import MainWindow

MENU = "Tools/Surfaces"
TOWARDS_LIGHT = (-0.45, 0.45, 1.0)
"""Where a new light comes from, in the eye's axes: over the left shoulder."""
NEAR = 0.6  # of the model's diagonal: from its middle to a new point light
INTENSITY = 0.8  # of a new light, so that two of them do not yet dazzle


def _no_node(window: MainWindow) -> str | None:
    return None if window.session.selection else "select a node first"


def _no_solid(window: MainWindow) -> str | None:
    return None if any(root.visible for root in window.session.document.solids) else "no solid is visible"


def _not_one(window: MainWindow) -> str | None:
    return None if len(window.session.selection) == 1 else "select one node first"


def _no_material(window: MainWindow) -> str | None:
    if not window.session.document.materials:
        return "the document has no material; add one first"
    return None if window.surfaces.material else "choose a material in the Surfaces panel first"


def _not_usable(window: MainWindow) -> str | None:
    return _no_material(window) or _no_node(window)


def _bare(window: MainWindow) -> str | None:
    if not window.session.selection:
        return "select a node first"
    document = window.session.document
    worn = any(find(document, node_id).material for node_id in window.session.selection)
    return None if worn else "no selected node has a material of its own"


def _no_light(window: MainWindow) -> str | None:
    if not window.session.document.lights:
        return "the document has no lights"
    return None if window.surfaces.light else "choose a light in the Surfaces panel first"


def _lit(window: MainWindow) -> str | None:
    return "the document has lights already" if window.session.document.lights else None


def show(window: MainWindow, page: int) -> None:
    """Bring a page of the panel to the front."""
    window.docks["Surfaces"].show()
    window.docks["Surfaces"].raise_()
    window.surfaces.show_page(page)


def _switch(page: int) -> Callable[[MainWindow], None]:
    """Bring the page to the front, or the properties where it is there already."""

    def run(window: MainWindow) -> None:
        if window.surfaces.shows(page):
            window.docks["Properties"].show()
            window.docks["Properties"].raise_()
        else:
            show(window, page)

    return run


def _add(window: MainWindow) -> None:
    from ..surfaces.steps import do_steps, new_material

    name, step = new_material(window.session.document, "Material")
    do_steps(window.session, f"Add {name}", [step])
    show(window, MATERIALS)
    window.surfaces.choose_material(name)


def _from_bitmap(window: MainWindow) -> None:
    from ..surfaces.bitmap_files import ask_bitmap

    ask_bitmap(window, lambda sha, path: _add_textured(window, sha, path))


def take_as_material(window: MainWindow, path: Path) -> None:
    """Make a material of a bitmap file, called as the file is."""
    from ..surfaces.bitmap_files import take_bitmap

    take_bitmap(window, path, lambda sha, path: _add_textured(window, sha, path))


def _add_textured(window: MainWindow, sha: str, path: Path) -> None:
    from ..surfaces.steps import do_steps, new_material

    name, step = new_material(window.session.document, path.stem, texture=sha)
    do_steps(window.session, f"Add {name}", [step])
    show(window, MATERIALS)
    window.surfaces.choose_material(name)


def _duplicate(window: MainWindow) -> None:
    from ..surfaces.steps import copied, do_steps, free_name

    document = window.session.document
    material = next(one for one in document.materials if one.name == window.surfaces.material)
    name = free_name(document, material.name)
    do_steps(window.session, f"Duplicate {material.name}", [copied(material, name)])
    show(window, MATERIALS)
    window.surfaces.choose_material(name)


def _delete(window: MainWindow) -> None:
    name = window.surfaces.material
    window.session.do("delete_material", name, label=f"Delete {name}")


def _use(window: MainWindow) -> None:
    name = window.surfaces.material
    window.session.do("use_material", list(window.session.selection), name, label=f"Put {name} on")


def _take_off(window: MainWindow) -> None:
    window.session.do("use_material", list(window.session.selection), None, label="Take material off")


def _checker(window: MainWindow) -> None:
    from ..surfaces.steps import put_checker

    put_checker(window.session, list(window.session.selection))


def _placement(window: MainWindow) -> None:
    if not window.mapping_tool.active:
        for tool in (
            window.measure,
            window.sight,
            window.place_on_face,
            window.draw,
            window.face_plane,
            window.engrave,
        ):
            tool.end()
    window.mapping_tool.switch()


def _own_lights(window: MainWindow) -> None:
    from ..surfaces.steps import do_steps, program_lights

    do_steps(window.session, "Make lights of the document", program_lights())
    show(window, LIGHTS)


def _delete_light(window: MainWindow) -> None:
    name = window.surfaces.light
    window.session.do("delete_light", name, label=f"Delete {name}")


def _add_light(kind: str) -> Callable[[MainWindow], None]:
    """Over the left shoulder of the eye; the first light brings an ambient one along, or shades would be black."""

    def run(window: MainWindow) -> None:
        from ..surfaces.steps import Step, do_steps

        lights = window.session.document.lights
        steps: list[Step] = []
        if not lights and kind != "ambient":
            steps.append(("add_light", ("Ambient", "ambient"), {}))
        name = unique_name(kind.capitalize(), [light.name for light in lights])
        shine = {} if kind == "ambient" else {"intensity": INTENSITY, **_placed(window, kind)}
        steps.append(("add_light", (name, kind), shine))
        do_steps(window.session, f"Add {name}", steps)
        show(window, LIGHTS)
        window.surfaces.choose_light(name)

    return run


def _placed(window: MainWindow, kind: str) -> dict[str, Any]:
    """Direction or position of a new light, by how the model is looked at."""
    import numpy as np

    from ...render.camera import frame

    viewer = window.viewport.viewer
    if viewer is None:
        return {}
    towards = np.array(TOWARDS_LIGHT) @ frame(viewer.camera)
    towards /= np.linalg.norm(towards)
    if kind == "directional":
        return {"direction": tuple(round(float(part), 4) + 0.0 for part in -towards)}
    bounds = viewer.scene.visible_bounds()
    bounds = np.array(((-20.0,) * 3, (20.0,) * 3)) if bounds is None else bounds
    place = bounds.mean(axis=0) + max(NEAR * float(np.linalg.norm(np.ptp(bounds, axis=0))), 1.0) * towards
    return {"position": tuple(round(float(part), 1) + 0.0 for part in place)}


def _compare(window: MainWindow) -> None:
    from ..comparison.comparison_window import open_comparison

    open_comparison(window)


def _inspect(window: MainWindow) -> None:
    from ..bitmap.bitmap_window import open_inspector

    open_inspector(window)


def _probe(window: MainWindow) -> None:
    from ..shading.light_window import switch_probe

    switch_probe(window)


def _unwrapped(window: MainWindow) -> None:
    from ..shading.uv_window import open_uv_window

    open_uv_window(window)


SURFACE_SEPARATORS = ("use_material", "lights_panel")
"""Before these a line is drawn in the menu."""
SURFACE_COMMANDS: tuple[Command, ...] = (
    Command("surfaces_panel", "Surfaces panel", "View", _switch(MATERIALS), shortcut="Alt+M", icon="surfaces",
            tip="Materials, textures, and the lights of the document"),
    Command("compare_shadings", "Compare shadings …", "View/Shading", _compare, shortcut="Alt+Shift+S",
            icon="compare_shadings", tip="A sphere or the selected solid in flat, Gouraud and Phong, side by side"),
    Command("bitmap_inspector", "Bitmap inspector \u2026", "Tools", _inspect, shortcut="Alt+I", icon="bitmap_inspector",
            tip="The pixels of a bitmap one by one: header, bytes, palette, memory, depth, compression, tiles"),
    Command("add_material", "Add material", MENU, _add, icon="surfaces",
            tip="A material that takes light as the program's own; change it in the Surfaces panel"),
    Command("material_from_bitmap", "Material from a bitmap …", MENU, _from_bitmap, icon="texture",
            tip="A material with a bitmap on it: BMP, PNG, JPEG, TIFF or WebP"),
    Command("duplicate_material", "Duplicate material", MENU, _duplicate, _no_material, icon="duplicate",
            tip="Another material as the chosen one"),
    Command("delete_material", "Delete material", MENU, _delete, _no_material, icon="delete",
            tip="Take the chosen material out, and off the nodes that it is on"),
    Command("use_material", "Use material on selection", MENU, _use, _not_usable, "Alt+Shift+M", "use_material",
            "Put the chosen material on the selected nodes"),
    Command("take_off_material", "Take material off", MENU, _take_off, _bare, icon="take_off_material",
            tip="The selected nodes look as what they stand in again"),
    Command("checker_board", "Checker board on selection", MENU, _checker, _no_node, icon="checker_board",
            tip="A test bitmap of squares A1 to H8, which shows how bitmaps lie on the selected nodes"),
    Command("texture_placement", "Edit texture placement", MENU, _placement, _not_one,
            icon="texture_placement", tip="Handles in the picture that shift and turn the bitmap on the selected node",
            checked=lambda w: w.mapping_tool.active),
    Command("texture_coordinates", "Texture coordinates \u2026", MENU, _unwrapped, shortcut="Alt+Shift+U",
            icon="texture_coordinates", tip="The triangles of the selected node as they lie on its bitmap"),
    Command("lights_panel", "Lights panel", MENU, _switch(LIGHTS), shortcut="Alt+Shift+L", icon="add_ambient_light",
            tip="The lights of the document, and its shading"),
    Command("add_ambient_light", "Add ambient light", MENU, _add_light("ambient"), icon="add_ambient_light",
            tip="Light from everywhere"),
    Command("add_directional_light", "Add directional light", MENU, _add_light("directional"),
            icon="add_directional_light", tip="Light from far away, at first from over your left shoulder"),
    Command("add_point_light", "Add point light", MENU, _add_light("point"), icon="add_point_light",
            tip="Light from a place, at first over your left shoulder"),
    Command("own_lights", "Make the lights the document's", MENU, _own_lights, _lit, icon="own_lights",
            tip="The lights that the program has by itself, as lights of the document that can be changed"),
    Command("light_probe", "Light of a point", MENU, _probe, _no_solid, "Alt+Shift+P", "probe",
            "Click a face: the equation of its light with the numbers put in, beside the picture's pixel"),
    Command("delete_light", "Delete light", MENU, _delete_light, _no_light, icon="delete",
            tip="Take the chosen light out; without lights those of the program shine"),
)  # fmt: skip
