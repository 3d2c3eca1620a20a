"""The nodes of a CSG tree: frozen values with a digest. Two nodes are equal when they are the same solid.

Equality and hash are the digest's, and the digest leaves out id, name, colour, material, visibility and note; so a
rename never re-cuts, equal parts share one mesh, and **change is detected with `is`, never with `==`**.
"""

from __future__ import annotations

import dataclasses
import secrets
from array import array
from collections.abc import Mapping
from dataclasses import dataclass
from hashlib import blake2b
from typing import Any, ClassVar, Self

from ..surface.mapping import TextureMapping
from ..surface.material import Material
from . import fields
from .colours import hex_colour
from .errors import Refusal
from .expression import Expression, Number, expressions_in, resolved, symbolic
from .fields import FieldSpec
from .placement import Placement, Reflect, Step, affine, moved, scaled, turned

KINDS: dict[str, type[Node]] = {}
_ALPHABET = "abcdefghijkmnpqrstuvwxyz23456789"
_set = object.__setattr__


def fresh_id() -> str:
    """A new node id: ten letters and digits (50 bits), the first a letter."""
    bits = secrets.randbits(50)
    return "n" + "".join(_ALPHABET[(bits >> shift) & 31] for shift in range(0, 50, 5))


@dataclass(frozen=True, slots=True, eq=False, repr=False, kw_only=True)
class Node:
    """What every node has. Sub-classes add their geometric fields, each made by a function of fields.py."""

    id: str = dataclasses.field(default_factory=fresh_id)
    name: str = ""
    colour: str | None = None
    visible: bool = True
    note: str = ""
    material: str | Material = ""
    """The name of a material of the document, or in scripts the material itself; "": that of what it is part of."""
    mapping: TextureMapping | None = None
    """How bitmaps lie on its faces; None: as on what it is part of."""
    crease: float | None = None
    """Degrees, 0 to 180: facets of a leaf that meet at less look smooth, at more they have an edge between them. None:
    as what it is part of, and where that says nothing as its kind has it."""
    placement: Placement = Placement()
    children: tuple[Node, ...] = ()
    digest: bytes = dataclasses.field(init=False)
    """Of kind, geometric fields, placement and children."""
    shape_digest: bytes = dataclasses.field(init=False)
    """The same without the node's own placement."""
    symbolic: bool = dataclasses.field(init=False)
    """Whether an expression stands in it or below, or a node that refers to other parts of the document."""
    creases: bytes = dataclasses.field(init=False)
    """Of the crease angles in it and below, b"" where there are none: what a picture depends on beside the digest."""

    kind: ClassVar[str] = "Node"
    title: ClassVar[str] = "Node"
    """What users call the kind."""
    operands: ClassVar[tuple[int, int | None]] = (0, 0)
    """How few and how many children the kind takes; None: any number."""
    refers: ClassVar[bool] = False
    """Whether what it is hangs on other parts of the document: a definition, the project's fonts."""
    SPECS: ClassVar[tuple[FieldSpec, ...]] = ()

    def __init_subclass__(cls, **more: Any) -> None:
        super(Node, cls).__init_subclass__(**more)
        cls.kind = cls.__name__
        KINDS[cls.__name__] = cls

    def __post_init__(self) -> None:
        if not isinstance(self.placement, Placement):
            raise Refusal(f"{self.title}: a placement is needed, not {self.placement!r:.60}")
        if not (isinstance(self.id, str) and isinstance(self.name, str) and isinstance(self.note, str)):
            raise Refusal(f"{self.title}: id, name and note must be text")
        if not isinstance(self.visible, bool):
            raise Refusal(f"{self.title}: visible must be true or false, not {self.visible!r:.60}")
        if self.colour is not None:
            _set(self, "colour", hex_colour(self.colour))
        if not isinstance(self.material, str | Material):
            raise Refusal(f"{self.title}: a material or the name of one is needed, not {self.material!r:.60}")
        if self.mapping is not None and not isinstance(self.mapping, TextureMapping):
            raise Refusal(f"{self.title}: a texture's mapping is needed, not {self.mapping!r:.60}")
        if self.crease is not None:
            _set(self, "crease", _crease_angle(self.crease, self.title))
        children = self.children
        if type(children) is not tuple:
            try:
                children = tuple(children)
            except TypeError:
                raise Refusal(f"{self.title} takes solids, not {children!r:.60}") from None
            _set(self, "children", children)
        fewest, most = self.operands
        if len(children) < fewest or (most is not None and len(children) > most):
            wanted = f"{fewest}" if fewest == most else f"at least {fewest}"
            raise Refusal(f"{self.title} takes {wanted} operand{'' if fewest == 1 else 's'}, not {len(children)}")
        values: list[Any] = []
        packed: list[array[float]] = []
        for spec in field_specs(type(self)):
            value = spec.checked(getattr(self, spec.name), self.title)
            _set(self, spec.name, value)
            plain = fields.plain_coordinates(value) if spec.type == "points" else None
            if plain is not None:  # many thousands at times: hashed as they are, instead of written out
                packed.append(array("d", plain))
                value = (len(value), len(plain))
            values.append(value)
        state = blake2b(repr((self.kind, values)).encode(), digest_size=16)
        for numbers in packed:
            state.update(numbers)
        depends = symbolic(tuple(values)) or self.refers
        creased = self.crease is not None
        for child in children:
            if not isinstance(child, Node):
                raise Refusal(f"{self.title} takes solids, not {child!r:.60}")
            state.update(child.digest)
            depends = depends or child.symbolic
            creased = creased or bool(child.creases)
        shape = state.digest()
        _set(self, "shape_digest", shape)
        if self.placement.steps:
            state.update(repr(self.placement.key()).encode())
            shape = state.digest()
            depends = depends or self.placement.symbolic()
        _set(self, "digest", shape)
        _set(self, "symbolic", depends)
        below = (self.crease, *(child.creases for child in children)) if creased else ()
        _set(self, "creases", blake2b(repr(below).encode(), digest_size=16).digest() if creased else b"")

    def __eq__(self, other: object) -> bool:
        return self.digest == other.digest if isinstance(other, Node) else NotImplemented

    def __hash__(self) -> int:
        return hash(self.digest)

    def __repr__(self) -> str:
        name = f" “{self.name}”" if self.name else ""
        below = f", {len(self.children)} operands" if self.children else ""
        return f"<{self.kind}{name} {self.id}{below}>"

    def __reduce__(self) -> Any:
        raise TypeError("nodes travel as a table (document/table.py), not as pickles")

    def with_(self, **changes: Any) -> Self:
        """A copy with some fields replaced; the id stays."""
        return dataclasses.replace(self, **changes)

    def values(self) -> dict[str, Any]:
        """The geometric fields by name."""
        return {spec.name: getattr(self, spec.name) for spec in field_specs(type(self))}

    def expressions(self) -> list[Expression]:
        """The expressions in its own fields and its placement."""
        if not self.symbolic:
            return []
        return list(expressions_in([*self.values().values(), *(step.numbers for step in self.placement.steps)]))

    @property
    def label(self) -> str:
        """The name, or the kind where there is none."""
        return self.name or self.title

    # Operators and placement, as scripts write them.

    def __add__(self, other: Node) -> Union:
        return (
            Union(children=(*_flat(self, Union), *_flat(other, Union))) if isinstance(other, Node) else NotImplemented
        )

    def __sub__(self, other: Node) -> Difference:
        return Difference(children=(*_flat(self, Difference), other)) if isinstance(other, Node) else NotImplemented

    def __and__(self, other: Node) -> Intersection:
        if not isinstance(other, Node):
            return NotImplemented
        return Intersection(children=(*_flat(self, Intersection), *_flat(other, Intersection)))

    def at(self, x: Number | str = 0, y: Number | str = 0, z: Number | str = 0) -> Self:
        """Moved by x, y, z millimetres."""
        return self._placed(moved(x, y, z))

    def turned(self, x: Number | str = 0, y: Number | str = 0, z: Number | str = 0) -> Self:
        """Turned about the world's axes through the origin: x degrees about x, then y about y, then z about z."""
        return self._placed(turned(x, y, z))

    def scaled(self, x: Number | str = 1, y: Number | str | None = None, z: Number | str | None = None) -> Self:
        """Scaled about the origin by a factor, or by one for each axis."""
        return self._placed(scaled(x, y, z))

    def mirrored(self, normal: tuple[Number, ...] = (1, 0, 0)) -> Self:
        """Reflected in the plane through the origin with this normal."""
        return self._placed(Reflect(normal))

    def transformed(self, matrix: Any) -> Self:
        """Mapped by a (3, 4) or (4, 4) affine matrix."""
        return self._placed(affine(matrix))

    def placed(self, *steps: Step) -> Self:
        """With these placement steps instead of its own."""
        return self.with_(placement=Placement(steps))

    def named(self, name: str) -> Self:
        """With this name in the tree."""
        return self.with_(name=name)

    def coloured(self, colour: str) -> Self:
        """With this colour, `#rrggbb` or a CSS colour's name; it stays on the faces of every result."""
        return self.with_(colour=colour)

    def dressed(self, *dress: Material | TextureMapping | str | tuple[Material, TextureMapping]) -> Self:
        """With a material (or the name of one), with a texture's mapping, or with both."""
        changes: dict[str, Any] = {}
        for one in dress:
            for part in one if isinstance(one, tuple) else (one,):
                changes["mapping" if isinstance(part, TextureMapping) else "material"] = part
        return self.with_(**changes)

    def creased(self, angle: float) -> Self:
        """With faces that look smooth where they meet at less than `angle` degrees: 0 all flat, 180 all smooth."""
        return self.with_(crease=angle)

    def noted(self, note: str) -> Self:
        """With a note to the reader."""
        return self.with_(note=note)

    def hidden(self) -> Self:
        """Not shown, though still part of what it stands in."""
        return self.with_(visible=False)

    def _placed(self, step: Step) -> Self:
        placement = self.placement.then(step)
        return self if placement is self.placement else self.with_(placement=placement)


def _crease_angle(value: Any, title: str) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float) or not 0.0 <= value <= 180.0:
        raise Refusal(f"{title}: a crease angle is a plain number of degrees from 0 to 180, not {value!r:.60}")
    return float(value)


_SPECS: dict[type[Node], tuple[FieldSpec, ...]] = {}


def field_specs(kind: type[Node]) -> tuple[FieldSpec, ...]:
    """The geometric fields of a kind, in the order of its form."""
    if kind not in _SPECS:
        _SPECS[kind] = tuple(
            dataclasses.replace(field.metadata["spec"], name=field.name)
            for field in dataclasses.fields(kind)
            if "spec" in field.metadata
        )
    return _SPECS[kind]


def _flat(node: Node, kind: type[Node]) -> tuple[Node, ...]:
    """The operands of a plain operation of this kind, so that a + b + c is one union of three."""
    plain = type(node) is kind and not (
        node.name
        or node.note
        or node.colour
        or node.material
        or node.mapping
        or node.placement.steps
        or node.crease is not None
    )
    return node.children if plain and node.visible else (node,)


@dataclass(frozen=True, slots=True, eq=False, repr=False, kw_only=True)
class Union(Node):
    """All that lies in any operand."""

    title: ClassVar[str] = "Union"
    operands: ClassVar[tuple[int, int | None]] = (0, None)


@dataclass(frozen=True, slots=True, eq=False, repr=False, kw_only=True)
class Difference(Node):
    """The first operand less all others."""

    title: ClassVar[str] = "Difference"
    operands: ClassVar[tuple[int, int | None]] = (0, None)


@dataclass(frozen=True, slots=True, eq=False, repr=False, kw_only=True)
class Intersection(Node):
    """What lies in every operand."""

    title: ClassVar[str] = "Intersection"
    operands: ClassVar[tuple[int, int | None]] = (0, None)


@dataclass(frozen=True, slots=True, eq=False, repr=False, kw_only=True)
class Hull(Node):
    """The smallest convex solid around the operands."""

    title: ClassVar[str] = "Hull"
    operands: ClassVar[tuple[int, int | None]] = (0, None)


@dataclass(frozen=True, slots=True, eq=False, repr=False, kw_only=True)
class Minkowski(Node):
    """The first operand swept by each of the others in turn (Minkowski sum)."""

    title: ClassVar[str] = "Minkowski sum"
    operands: ClassVar[tuple[int, int | None]] = (0, None)


@dataclass(frozen=True, slots=True, eq=False, repr=False, kw_only=True)
class Displace(Node):
    """The operand with its faces raised along their normals by the lightness of a bitmap that the document carries.

    The bitmap lies on it as a texture of this projection, about the origin of the operand's surroundings, again and
    again, `copy_width` by `copy_height` mm each.
    """

    title: ClassVar[str] = "Displace"
    operands: ClassVar[tuple[int, int | None]] = (1, 1)
    asset: str = fields.text("", "Asset", "SHA-256 of the bitmap")
    height: Number = fields.length(1.0, "Height", "From black to white; below 0 the faces sink in")
    projection: str = fields.choice("Projection", ("box", "planar", "cylindrical", "spherical"))
    copy_width: Number = fields.size(20.0, "Copy width", "Of one copy of the bitmap; around an axis it goes once")
    copy_height: Number = fields.size(20.0, "Copy height", "Of one copy of the bitmap")
    edge: Number = fields.size(0.5, "Edge", "Longest edge of the triangles that are moved")


SURFACES = (Hull, Minkowski, Displace)
"""Operations whose result has a surface of its own, not that of its operands."""


@dataclass(frozen=True, slots=True, eq=False, repr=False, kw_only=True)
class LinearArray(Node):
    """Copies of the operand, each one step further."""

    title: ClassVar[str] = "Linear array"
    operands: ClassVar[tuple[int, int | None]] = (1, 1)
    count: Number = fields.count(3, "Copies")
    step: tuple[Number, ...] = fields.position((20.0, 0.0, 0.0), "Step", "From each copy to the next")


@dataclass(frozen=True, slots=True, eq=False, repr=False, kw_only=True)
class PolarArray(Node):
    """Copies of the operand turned about an axis; a full turn spreads them evenly."""

    title: ClassVar[str] = "Polar array"
    operands: ClassVar[tuple[int, int | None]] = (1, 1)
    count: Number = fields.count(6, "Copies")
    angle: Number = fields.angle(360.0, "Angle", "From the first copy to the last, or a full turn")
    axis: tuple[Number, ...] = fields.direction((0.0, 0.0, 1.0), "Axis")
    point: tuple[Number, ...] = fields.position((0.0, 0.0, 0.0), "Centre", "A point on the axis")


@dataclass(frozen=True, slots=True, eq=False, repr=False, kw_only=True)
class Mirror(Node):
    """The operand and its mirror image, or the image alone."""

    title: ClassVar[str] = "Mirror"
    operands: ClassVar[tuple[int, int | None]] = (1, 1)
    normal: tuple[Number, ...] = fields.direction((1.0, 0.0, 0.0), "Normal", "Of the mirror's plane")
    point: tuple[Number, ...] = fields.position((0.0, 0.0, 0.0), "Point", "On the mirror's plane")
    keep: bool = fields.flag(True, "Keep original")


@dataclass(frozen=True, slots=True, eq=False, repr=False, kw_only=True)
class Instance(Node):
    """A definition of the document, placed once more."""

    title: ClassVar[str] = "Instance"
    operands: ClassVar[tuple[int, int | None]] = (0, 1)
    refers: ClassVar[bool] = True
    definition: str = fields.text("", "Definition", "The id of the definition's root")


@dataclass(frozen=True, slots=True, eq=False, repr=False, kw_only=True)
class Broken(Node):
    """Stands in a resolved tree for a node whose fields have no value; never in a document."""

    title: ClassVar[str] = "Broken"
    operands: ClassVar[tuple[int, int | None]] = (0, None)
    message: str = fields.text("", "Message")
    stands_for: str = fields.text("", "Kind")

    @property
    def label(self) -> str:
        return self.name or self.stands_for


def range_fault(node: Node) -> str | None:
    """Why a resolved node's fields are out of their bounds, in the user's words, or None."""
    for spec in field_specs(type(node)):
        fault = spec.range_fault(getattr(node, spec.name))
        if fault:
            return f"{node.title}: {fault}"
    return None


def resolve_fields(node: Node, values: Mapping[str, float], children: tuple[Node, ...]) -> Node:
    """`node` with its own expressions replaced by numbers, over resolved children. Raises Refusal."""
    changes = {name: resolved(value, values) for name, value in node.values().items()}
    return node.with_(placement=node.placement.resolve(values), children=children, **changes)
