"""Operations on saved sets of parameter values, and on the values of several parameters at once."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from ..document.document import Document, ParameterSet, parameter_values
from ..document.errors import Refusal
from ..document.expression import Expression, Number, number
from .parameters import declaring, names_of

Pairs = Sequence[tuple[str, Number | str]]


def set_parameters(document: Document, values: Pairs | Mapping[str, Number | str]) -> Document:
    """Give several parameters values at once, by name or as pairs of name and value.

    Refused as a whole where one does not exist, may not have its value, or where another one that is reckoned from
    them would be left without a value.
    """
    wanted: dict[str, Number] = {}
    for name, value in _pairs(values):
        document.parameter(name)
        if name in wanted:
            raise Refusal(f"the parameter {name} is given twice")
        wanted[name] = number(value, f"the parameter {name}")
    changed = {p.name: p.with_(value=wanted[p.name]) for p in document.parameters if p.name in wanted}
    changed = {name: new for name, new in changed.items() if new != document.parameter(name)}
    if not changed:
        return document
    document = declaring(document, list(wanted.values()))
    before = parameter_values(document.parameters)[1]
    after = document.with_(parameters=tuple(changed.get(p.name, p) for p in document.parameters))
    faults = parameter_values(after.parameters)[1]
    for name in (*changed, *faults):
        if name in faults and name not in before:
            raise Refusal(faults[name])
    return after


def _pairs(values: object) -> list[tuple[str, Number | str]]:
    pairs = list(values.items()) if isinstance(values, Mapping) else values
    if not isinstance(pairs, list | tuple) or not all(isinstance(p, list | tuple) and len(p) == 2 for p in pairs):
        raise Refusal(f"pairs of a parameter's name and its value are needed, not {values!r:.60}")
    return [(name, value) for name, value in pairs]


def with_texts(document: Document, texts: Iterable[str]) -> Document:
    """The document with values as they are written for a command: `width=12`, `depth=width / 2`."""
    pairs: dict[str, str] = {}
    for text in texts:
        name, sign, value = (part.strip() for part in text.partition("="))
        if not (name and sign and value):
            raise Refusal(f"{text!r:.60} gives no parameter a value: write it as name=value")
        pairs[name] = value
    return set_parameters(document, list(pairs.items()))


def find_set(document: Document, name: str) -> ParameterSet:
    """The saved set of this name. Raises Refusal."""
    for one in document.sets:
        if one.name == name:
            return one
    known = ", ".join(f"“{one.name}”" for one in document.sets[:8])
    raise Refusal(
        f"there is no set of parameters called “{name}”; " + (f"there is {known}" if known else "none is saved")
    )


def save_set(document: Document, name: str) -> Document:
    """Keep the values that all parameters have now under a name; a set of that name gets them instead of its own."""
    if not document.parameters:
        raise Refusal("there are no parameters whose values could be saved")
    return put_sets(document, ((_clean(name), tuple((p.name, p.value) for p in document.parameters)),))


def put_sets(document: Document, sets: Iterable[tuple[str, Iterable[tuple[str, Number | str]]]]) -> Document:
    """Add sets, as pairs of a name and pairs of parameter and value; like-named ones are replaced where they stand."""
    known = {parameter.name for parameter in document.parameters}
    result = {one.name: one for one in document.sets}
    for name, values in sets:
        new = ParameterSet(_clean(name), tuple(values))  # type: ignore[arg-type]  # text is read as a number there
        for parameter, _ in new.values:
            if parameter not in known:
                raise Refusal(f"the set “{new.name}”: there is no parameter called {parameter}")
        declaring(document, [value for _, value in new.values])
        if result.get(new.name) != new:
            result[new.name] = new
    held = tuple(result.values())
    same = len(held) == len(document.sets) and all(a is b for a, b in zip(held, document.sets, strict=True))
    return document if same else document.with_(sets=held)


def apply_set(document: Document, name: str) -> Document:
    """Give the parameters the values of a saved set; refused as a whole where one of them may not have its value.

    Parameters that the set does not name keep their values; `unknown_in_set` tells what it names and is not there.
    """
    one = find_set(document, name)
    unknown = set(unknown_in_set(document, one))
    values = [(parameter, value) for parameter, value in one.values if parameter not in unknown]
    if one.values and not values:
        raise Refusal(f"the set “{name}” names no parameter of this document")
    try:
        return set_parameters(document, values)
    except Refusal as refusal:
        raise Refusal(f"the set “{name}” cannot be applied: {refusal}") from None


def unknown_in_set(document: Document, one: ParameterSet) -> tuple[str, ...]:
    """The names in a set that are no parameters of the document, as in one read from a file."""
    known = {parameter.name for parameter in document.parameters}
    return tuple(name for name, value in one.values if name not in known or names_of(value) - known)


def fitting_sets(document: Document, sets: Iterable[ParameterSet]) -> tuple[list[ParameterSet], list[str]]:
    """Sets without what the document has no parameter for, and the names left out; a set left empty is left out too."""
    kept: list[ParameterSet] = []
    left_out: dict[str, None] = {}
    for one in sets:
        unknown = unknown_in_set(document, one)
        left_out |= dict.fromkeys(unknown)
        values = tuple((name, value) for name, value in one.values if name not in unknown)
        if values:
            kept.append(ParameterSet(one.name, values))
    return kept, list(left_out)


def rename_set(document: Document, name: str, new_name: str) -> Document:
    """Call a saved set otherwise."""
    old, new_name = find_set(document, name), _clean(new_name)
    if new_name == name:
        return document
    if any(one.name == new_name for one in document.sets):
        raise Refusal(f"there is a set of parameters called “{new_name}” already")
    new = ParameterSet(new_name, old.values)
    return document.with_(sets=tuple(new if one is old else one for one in document.sets))


def delete_set(document: Document, name: str) -> Document:
    """Forget a saved set; the parameters keep their values."""
    old = find_set(document, name)
    return document.with_(sets=tuple(one for one in document.sets if one is not old))


def set_in_force(document: Document) -> str:
    """The name of the first set whose values are those that the parameters have now; "" where there is none."""
    now: Mapping[str, Number] = {parameter.name: parameter.value for parameter in document.parameters}
    for one in document.sets:
        if one.values and all(now.get(name) == value for name, value in one.values):
            return one.name
    return ""


def as_text(value: Number) -> str:
    """A value as sets write it: the shortest text that reads as the same number, or the expression."""
    if isinstance(value, Expression):
        return value.text
    value = float(value)
    return str(int(value)) if value.is_integer() and abs(value) < 1e15 else repr(value)


def _clean(name: str) -> str:
    return " ".join(str(name).split())
