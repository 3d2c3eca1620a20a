"""Operations on what surfaces look like: materials, how bitmaps lie, lights, shading."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import fields
from typing import Any

from ..document.document import Document
from ..document.errors import Refusal
from ..document.nodes import Node
from ..document.tree import change_each, unique_name, walk
from ..surface.light import Light
from ..surface.mapping import TextureMapping
from ..surface.material import PRESETS, Material

_FIELDS = {
    kind: frozenset(field.name for field in fields(kind)) - {"name"} for kind in (Material, Light, TextureMapping)
}


def add_material(document: Document, name: str | None = None, preset: str | None = None, **values: Any) -> Document:
    """Add a material with these fields (see Material), over those of a preset. None: a name is found."""
    if preset is not None and preset not in PRESETS:
        raise Refusal(f"no preset is called {preset!r:.60}; take one of {', '.join(PRESETS)}")
    if name is None:
        name = unique_name(preset or "Material", [one.name for one in document.materials])
    made = Material(_tidy(name), **_known(Material, {**PRESETS.get(preset or "", {}), **values}))
    _check_new(document.materials, made.name, "material")
    return document.with_(materials=(*document.materials, made))


def set_material(document: Document, name: str, **changes: Any) -> Document:
    """Change fields of a material."""
    return document.with_(materials=_set(document.materials, name, "material", _known(Material, changes)))


def rename_material(document: Document, name: str, new_name: str) -> Document:
    """Call a material otherwise; the nodes that it is on follow."""
    materials = _renamed(document.materials, name, new_name, "material")
    if materials is document.materials:
        return document
    return change_each(
        document.with_(materials=materials), _worn(document, name), lambda node: node.with_(material=_tidy(new_name))
    )


def delete_material(document: Document, name: str) -> Document:
    """Take a material out, and off the nodes that it is on."""
    left = tuple(one for one in document.materials if one is not _find(document.materials, name, "material"))
    return change_each(document.with_(materials=left), _worn(document, name), lambda node: node.with_(material=""))


def use_material(document: Document, ids: Sequence[str], name: str | None) -> Document:
    """Put a material on nodes by its name; None takes off what is on them."""
    if name is not None:
        _find(document.materials, name, "material")
    wanted = name or ""
    return change_each(document, ids, lambda node: node if node.material == wanted else node.with_(material=wanted))


def set_mapping(document: Document, ids: Sequence[str], projection: str | None = None, **changes: Any) -> Document:
    """Say how bitmaps lie on nodes: fields of TextureMapping, the others as they are. With none, as on what they are
    part of."""
    if projection is not None:
        changes["projection"] = projection
    values = _known(TextureMapping, changes)

    def changed(node: Node) -> Node:
        new = (node.mapping or TextureMapping()).with_(**values) if values else None
        return node if new == node.mapping else node.with_(mapping=new)

    return change_each(document, ids, changed)


def set_crease(document: Document, ids: Sequence[str], angle: float | None = None) -> Document:
    """Say at how many degrees faces of nodes have an edge between them: those that meet at less look smooth. 0: all
    flat, 180: all smooth. None: as what they are part of, or as their kind has it."""
    return change_each(document, ids, lambda node: node if node.crease == angle else node.with_(crease=angle))


def add_light(document: Document, name: str | None = None, kind: str = "directional", **values: Any) -> Document:
    """Add a light with these fields (see Light). The first one takes the place of the program's own. None: a name is
    found."""
    if name is None:
        name = unique_name(f"{str(kind).capitalize()} light", [light.name for light in document.lights])
    light = Light(_tidy(name), kind, **_known(Light, values))
    _check_new(document.lights, light.name, "light")
    return document.with_(lights=(*document.lights, light))


def set_light(document: Document, name: str, **changes: Any) -> Document:
    """Change fields of a light."""
    return document.with_(lights=_set(document.lights, name, "light", _known(Light, changes)))


def rename_light(document: Document, name: str, new_name: str) -> Document:
    """Call a light otherwise."""
    lights = _renamed(document.lights, name, new_name, "light")
    return document if lights is document.lights else document.with_(lights=lights)


def delete_light(document: Document, name: str) -> Document:
    """Take a light out."""
    return document.with_(lights=tuple(one for one in document.lights if one is not find_light(document, name)))


def set_shading(document: Document, shading: str | None) -> Document:
    """How the document's pictures are shaded: flat, gouraud, gouraud-diffuse or phong; None: as the window is set."""
    return document if document.shading == (shading or "") else document.with_(shading=shading or "")


def find_material(document: Document, name: str) -> Material:
    """The material of this name. Raises Refusal."""
    return _find(document.materials, name, "material")


def find_light(document: Document, name: str) -> Light:
    """The light of this name. Raises Refusal."""
    return _find(document.lights, name, "light")


def with_materials_of(document: Document, nodes: Iterable[Node]) -> tuple[Document, list[Node]]:
    """Nodes that wear materials themselves, as scripts make them, with their names instead, and the document with those
    materials. Raises Refusal where a name stands for two."""
    coming: dict[str, Material] = {}
    roots = list(nodes)
    for node in walk(*roots):
        if isinstance(node.material, Material):
            _agree(coming, node.material)
    if not coming:
        return document, roots
    carrier = change_each(
        Document(definitions=tuple(roots)),
        [node.id for node in walk(*roots) if isinstance(node.material, Material)],
        lambda node: node.with_(material=node.material.name if isinstance(node.material, Material) else ""),
    )
    return with_materials(document, coming.values()), list(carrier.definitions)


def with_materials(document: Document, materials: Iterable[Material]) -> Document:
    """The document with these materials too. Raises Refusal where a name stands for another one already."""
    known = {material.name: material for material in document.materials}
    count = len(known)
    for material in materials:
        _agree(known, material)
    return document if len(known) == count else document.with_(materials=tuple(known.values()))


def with_like_materials(document: Document, other: Document) -> tuple[Document, Document]:
    """The document with the materials of another one too, and that one's nodes with their names here: what is the same
    is shared, and what has a name that stands for another one here is called otherwise."""
    known = {material.name: material for material in document.materials}
    for material in other.materials:
        if known.get(material.name, material) != material:
            name = unique_name(material.name, [*known, *(one.name for one in other.materials)])
            other = rename_material(other, material.name, name)
            material = material.with_(name=name)
        known[material.name] = material
    return document.with_(materials=tuple(known.values())), other


def joined_lights(lights: tuple[Light, ...], others: tuple[Light, ...]) -> list[Light]:
    """Lights and those of another document; where there are any, the others come switched off, under free names."""
    joined = list(lights)
    for light in others:
        name = unique_name(light.name, [one.name for one in joined])
        joined.append(light.with_(name=name, active=light.active and not lights))
    return joined


def _agree(known: dict[str, Material], material: Material) -> None:
    if known.setdefault(material.name, material) != material:
        raise Refusal(f"there are two different materials called “{material.name}”; call one otherwise")


def _worn(document: Document, name: str) -> list[str]:
    return [node.id for node in walk(*document.roots) if node.material == name]


def _known(kind: type[Material | Light | TextureMapping], values: dict[str, Any]) -> dict[str, Any]:
    extra = sorted(values.keys() - _FIELDS[kind])
    if extra:
        what = {Material: "a material", Light: "a light", TextureMapping: "a texture's mapping"}[kind]
        raise Refusal(f"{what} has no {extra[0]!r:.60}; it has {', '.join(sorted(_FIELDS[kind]))}")
    return values


def _find(members: tuple[Any, ...], name: str, what: str) -> Any:
    for one in members:
        if one.name == name:
            return one
    raise Refusal(f"there is no {what} called {name!r:.60}")


def _set(members: tuple[Any, ...], name: str, what: str, changes: dict[str, Any]) -> tuple[Any, ...]:
    old = _find(members, name, what)
    new = old.with_(**changes)
    return members if new == old else tuple(new if one is old else one for one in members)


def _renamed(members: tuple[Any, ...], name: str, new_name: str, what: str) -> tuple[Any, ...]:
    new = _tidy(new_name)
    if new == name:
        return members
    _find(members, name, what)
    _check_new(members, new, what)
    return _set(members, name, what, {"name": new})


def _check_new(members: tuple[Any, ...], name: str, what: str) -> None:
    if any(one.name == name for one in members):
        raise Refusal(f"there is a {what} called “{name}” already")


def _tidy(name: object) -> Any:
    return " ".join(name.split()) if isinstance(name, str) else name
