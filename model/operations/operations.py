"""What can be done to a document: plain functions, document in, document out, that refuse in the user's words.

The console calls them by the same names, with the open document left out. Here stand those that dress and size a
node; structure.py, relocating.py, placing.py, arranging.py, linking.py, pasting.py, parameters.py and motions.py hold
the others; OPERATIONS is the list of all.
"""

from __future__ import annotations

from collections.abc import Callable, Container, Sequence
from typing import Any

from ..document.colours import hex_colour
from ..document.document import Document
from ..document.errors import Refusal
from ..document.nodes import Instance, field_specs
from ..document.outlines import Outlines
from ..document.tree import change, change_each, find, listed, outermost, parent
from .arranging import shift
from .checks import check_pair, set_clearance
from .curves.bending import bend_segment
from .curves.contours import (
    add_contour,
    break_path,
    close_contours,
    join_nodes,
    reverse_contours,
    set_segments,
    split_outline,
)  # fmt: skip
from .curves.control_points import delete_points, insert_point, move_points, place_points, set_weights
from .curves.conversion import convert_to_bspline, convert_to_path
from .curves.joints import harmonise_joints, match_curvature, smooth_joints
from .curves.knots import elevate_degree, insert_knot, reduce_degree, refine_knots, remove_knot, set_knot
from .curves.mending import repair_outline
from .curves.node_places import align_nodes, distribute_nodes, mirror_outline
from .curves.nodes import (
    delete_nodes,
    insert_node,
    move_handle,
    move_nodes,
    place_nodes,
    set_handle,
    set_joints,
    transform_nodes,
)  # fmt: skip
from .curves.outline_areas import combine_outlines, offset_outline, stroke_outline
from .engraving import engrave
from .fonts import carry_font, copy_font, edit_glyphs, release_font, reset_glyphs, transform_glyphs
from .linking import check_definitions, insert_document, link, unlink
from .meshes.editing import (
    collapse_mesh_edge,
    delete_mesh_faces,
    flip_mesh_edge,
    move_mesh_vertices,
    reverse_mesh_faces,
    split_mesh_edge,
    split_mesh_face,
)  # fmt: skip
from .meshes.mending import close_mesh_holes, repair_mesh
from .meshes.mesh_nodes import convert_to_mesh
from .motions import add_motion, delete_motion, rename_motion, set_in_motion, set_motion
from .outlining import make_solid, make_stencils, set_text_on_path
from .parameter_sets import apply_set, delete_set, put_sets, rename_set, save_set, set_parameters
from .parameters import declaring, delete_parameter, rename_parameter, reorder_parameter, set_parameter
from .pasting import paste
from .placing import move, place, scale, shifted_within, turn
from .relocating import copy_to, duplicate, promote, relocate, reorder, swap
from .sections import add_section, delete_section, rename_section, set_section
from .structure import change_kind, combine, delete, dissolve, insert, replace
from .surfaces import (
    add_light,
    add_material,
    delete_light,
    delete_material,
    rename_light,
    rename_material,
    set_crease,
    set_light,
    set_mapping,
    set_material,
    set_shading,
    use_material,
)


def rename(document: Document, node_id: str, name: str) -> Document:
    """Give a node a name; solids and profiles have names of their own."""
    name = " ".join(str(name).split())
    if any(root.id == node_id for root in document.standing):
        _check_name(name, {root.name for root in document.standing if root.id != node_id}, document)
    return change(document, node_id, lambda node: node if node.name == name else node.with_(name=name))


def rename_each(document: Document, ids: Sequence[str] | str, pattern: str) -> Document:
    """Give nodes names with a number each, 1 for the first; it takes the place of `#`, or stands behind the words."""
    words, wanted = " ".join(str(pattern).split()), listed(ids)
    if words and "#" not in words and len(wanted) > 1:
        words += " #"
    names = {node_id: words.replace("#", str(number)) for number, node_id in enumerate(wanted, 1)}
    taken = {root.name for root in document.standing if root.id not in names}
    for root in document.standing:
        if root.id in names:
            _check_name(names[root.id], taken, document)
            taken.add(names[root.id])
    return change_each(
        document, wanted, lambda node: node if node.name == names[node.id] else node.with_(name=names[node.id])
    )


def _check_name(name: str, taken: Container[str], document: Document) -> None:
    if not name:
        raise Refusal("a solid, or an outline that stands by itself, needs a name")
    if name in taken:
        flat = any(root.name == name for root in document.profiles)
        raise Refusal(f"there is {'an outline' if flat else 'a solid'} called “{name}” already")


def set_field(document: Document, node_id: str, field: str, value: Any) -> Document:
    """Change one geometric field of a node; text is read as a number or an expression."""
    return _with_fields(document, node_id, {field: value})


def set_fields(document: Document, node_id: str, shift: Sequence[float] | None = None, **values: Any) -> Document:
    """Change several geometric fields of a node at once; `shift` moves it along its own axes, by their millimetres, so
    that the far side of what grows can stay where it is."""
    return _with_fields(document, node_id, values, shift)


def _with_fields(
    document: Document, node_id: str, values: dict[str, Any], shift: Sequence[float] | None = None
) -> Document:
    node = find(document, node_id)
    specs = {spec.name: spec for spec in field_specs(type(node))}
    for field in values:
        if field not in specs:
            raise Refusal(f"{node.title} has no field {field!r:.60}")
    checked = {field: specs[field].checked(value, node.title) for field, value in values.items()}
    changed = {field: value for field, value in checked.items() if value != getattr(node, field)}
    if shift is not None:
        placement = shifted_within(document, node.placement, shift)
        if placement != node.placement:
            changed["placement"] = placement
    if not changed:
        return document
    new = node.with_(**changed)
    if isinstance(node, Instance):
        check_definitions(document, [new], node_id)
        flat = Outlines(document.definitions)
        if (node in flat) != (new in flat):
            raise Refusal(f"“{node.label}” is {'an outline' if node in flat else 'a solid'}, and what it should be an "
                          "instance of is not")  # fmt: skip
    return change(declaring(document, list(checked.values())), node_id, lambda node: new)


def displace_each(document: Document, ids: Sequence[str], asset: str, **values: Any) -> Document:
    """Raise the faces of each of these solids by a bitmap, the SHA-256 of an asset; further fields as of Displace."""
    for node_id in outermost(document, ids):
        document = combine(document, "displace", [node_id])
        above = parent(document, node_id)
        assert above is not None
        document = _with_fields(document, above.id, {"asset": asset, **values})
    return document


def set_colour(document: Document, ids: Sequence[str], colour: str | None) -> Document:
    """Colour nodes; None takes the colour away."""
    plain = None if colour is None else hex_colour(colour)
    return change_each(document, ids, lambda node: node if node.colour == plain else node.with_(colour=plain))


def set_visible(document: Document, ids: Sequence[str], visible: bool) -> Document:
    """Show or hide nodes."""
    shown = bool(visible)
    return change_each(document, ids, lambda node: node if node.visible is shown else node.with_(visible=shown))


def set_note(document: Document, node_id: str, note: str) -> Document:
    """Attach a note to a node."""
    text = str(note)
    return change(document, node_id, lambda node: node if node.note == text else node.with_(note=text))


OPERATIONS: dict[str, Callable[..., Document]] = {
    function.__name__: function
    for function in (
        insert, insert_document, paste, replace, delete, combine, displace_each, make_solid, make_stencils,
        set_text_on_path,
        dissolve, change_kind, relocate, copy_to, duplicate, reorder, promote, swap, link, unlink, rename, rename_each,
        set_field, set_fields, place, move, turn,
        scale, shift, set_colour, set_visible, set_note,
        set_parameter, rename_parameter, delete_parameter, reorder_parameter, set_parameters,
        save_set, put_sets, apply_set, rename_set, delete_set,
        add_section, set_section, rename_section, delete_section,
        add_motion, set_motion, rename_motion, delete_motion, set_in_motion,
        add_material, set_material, rename_material, delete_material, use_material, set_mapping,
        set_crease, add_light, set_light, rename_light, delete_light, set_shading,
        set_clearance, check_pair,
        engrave, carry_font, release_font, copy_font, edit_glyphs, transform_glyphs, reset_glyphs,
        convert_to_mesh, repair_mesh, close_mesh_holes, split_mesh_edge, flip_mesh_edge, collapse_mesh_edge,
        split_mesh_face, delete_mesh_faces, reverse_mesh_faces, move_mesh_vertices,
        bend_segment, repair_outline,
        combine_outlines, offset_outline, stroke_outline,
        convert_to_path, convert_to_bspline, move_nodes, place_nodes, move_handle, set_handle, set_joints, insert_node,
        delete_nodes, transform_nodes, align_nodes, distribute_nodes, mirror_outline, smooth_joints, harmonise_joints,
        match_curvature, break_path, join_nodes, close_contours, reverse_contours, set_segments, split_outline,
        add_contour, move_points, place_points, insert_point, delete_points, set_weights, set_knot, insert_knot,
        remove_knot, refine_knots, elevate_degree, reduce_degree,
    )
}  # fmt: skip
