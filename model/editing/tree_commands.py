"""Commands on the tree: what is selected in it, where nodes stand in it, and what kind they are."""

from __future__ import annotations

from collections.abc import Callable

from ..document.from_outlines import Extrude, Revolve
from ..document.kind_names import function_name
from ..document.nodes import KINDS, Instance, Node
from ..document.outlines import Outlines
from ..document.tree import index_of, parent, walk
from ..operations.structure import OF_SOLIDS
from .chosen import chosen
from .commands import Command, chosen_fault, done
from .session import Session

JOINING = ("union", "difference", "intersection", "hull", "minkowski")
SINGLE = ("linear_array", "polar_array", "mirror")


# What is selected.


def _parents(session: Session) -> list[str]:
    return list(dict.fromkeys(above.id for above in chosen(session).above if above is not None))


def _no_parent(session: Session) -> str | None:
    return chosen_fault()(session) or (None if _parents(session) else "a solid stands in no operation")


def _children(session: Session) -> list[str]:
    return [child.id for node in chosen(session).nodes for child in node.children]


def _no_children(session: Session) -> str | None:
    return chosen_fault()(session) or (None if _children(session) else "it has no operands")


def _same_kind(session: Session) -> None:
    kinds = {type(node) for node in chosen(session).nodes}
    others = (node.id for node in walk(*session.document.roots) if type(node) in kinds)
    session.select(dict.fromkeys((*session.selection, *others)))


def _definitions(session: Session) -> list[str]:
    return list(dict.fromkeys(node.definition for node in chosen(session).nodes if isinstance(node, Instance)))


def _no_instance(session: Session) -> str | None:
    return chosen_fault()(session) or (None if _definitions(session) else "select an instance")


def _instances(session: Session) -> list[str]:
    """The instances of the selected definitions, and those that share a definition with a selected instance."""
    wanted = {*session.selection, *_definitions(session)}
    nodes = walk(*session.document.roots)
    return [node.id for node in nodes if isinstance(node, Instance) and node.definition in wanted]


def _no_instances(session: Session) -> str | None:
    return chosen_fault()(session) or (None if _instances(session) else "it has no instances")


# Where they stand.


def _siblings(session: Session) -> tuple[Node | None, list[int]]:
    """The operation that holds all that is selected, and their places in it, in order; no places where it does not."""
    looked = chosen(session)
    homes = {None if above is None else above.id for above in looked.above}
    families = {family for above, family in zip(looked.above, looked.families, strict=True) if above is None}
    if len(homes) != 1 or len(families) > 1 or "definitions" in families:
        return None, []
    return looked.above[0], sorted(looked.places)


def _family(session: Session, above: Node | None) -> tuple[Node, ...]:
    """The operands among which the selected nodes stand, or the roots."""
    return getattr(session.document, chosen(session).families[0]) if above is None else above.children


def _siblings_fault(session: Session) -> str | None:
    return chosen_fault()(session) or (None if _siblings(session)[1] else "select operands of one operation")


def _shift_fault(by: int) -> Callable[[Session], str | None]:
    def fault(session: Session) -> str | None:
        wrong = _siblings_fault(session)
        if wrong:
            return wrong
        above, places = _siblings(session)
        count = len(_family(session, above))
        ends = range(len(places)) if by < 0 else range(count - len(places), count)
        return ("it is the first already" if by < 0 else "it is the last already") if places == list(ends) else None

    return fault


def _shift(by: int) -> Callable[[Session], None]:
    label = "Move up" if by < 0 else "Move down"
    return lambda s: done(s.do("reorder", list(s.selection), by, label=label))


def _in_order(session: Session) -> list[str]:
    looked = chosen(session)
    return [node.id for _, node in sorted(zip(looked.places, looked.nodes, strict=True), key=lambda pair: pair[0])]


def _out_fault(session: Session) -> str | None:
    wrong = _siblings_fault(session)
    return wrong or ("a solid stands in no operation" if _siblings(session)[0] is None else None)


def _out(session: Session) -> None:
    above, _ = _siblings(session)
    assert above is not None
    document = session.document
    outer, place = parent(document, above.id), index_of(document, above.id) + 1
    flat = Outlines(document.definitions)
    # Among the roots it stands behind one of its own family only: outlines apart from solids, neither in definitions.
    in_definition = any(root is above for root in document.definitions)
    beside = outer is not None or (not in_definition and (above in flat) == (chosen(session).nodes[0] in flat))
    target = (None if outer is None else outer.id, place) if beside else (None,)
    session.do("relocate", _in_order(session), *target, label="Move out", select=session.selection)


def _sibling_above(session: Session) -> Node | None:
    above, places = _siblings(session)
    return _family(session, above)[places[0] - 1] if places and places[0] > 0 else None


def _in_fault(session: Session) -> str | None:
    wrong = _siblings_fault(session)
    if wrong:
        return wrong
    target = _sibling_above(session)
    if target is None:
        return "there is no operation above it"
    return None if isinstance(target, OF_SOLIDS) else f"“{target.label}”, which stands above it, takes no operands"


def _in(session: Session) -> None:
    target = _sibling_above(session)
    assert target is not None
    session.do("relocate", _in_order(session), target.id, label="Move in", select=session.selection)


def _promote_fault(session: Session) -> str | None:
    wrong = chosen_fault(1, 1)(session)
    if wrong:
        return wrong
    above, places = _siblings(session)
    if above is None:
        return "a solid stands in no operation"
    return "it is the first operand already" if places == [0] else None


def _swap_fault(session: Session) -> str | None:
    return None if len(session.selection) == 2 else "select two nodes"


# What they are.


def _change_fault(kind: str) -> Callable[[Session], str | None]:
    wanted = next(k for k in KINDS.values() if function_name(k) == kind)
    outline = wanted in (Extrude, Revolve)

    def fault(session: Session) -> str | None:
        wrong = chosen_fault()(session)
        if wrong:
            return wrong
        for node in chosen(session).nodes:
            if not isinstance(node, (Extrude, Revolve) if outline else OF_SOLIDS):
                return f"“{node.label}” is no operation that can become one"
            if wanted.operands[1] == 1 and len(node.children) != 1:
                return f"“{node.label}” has {len(node.children)} operands; it takes one"
        return None

    return fault


def _is(kind: str) -> Callable[[Session], bool]:
    return lambda s: bool(s.selection) and all(function_name(type(node)) == kind for node in chosen(s).nodes)


def _change(kind: str, title: str) -> Command:
    return Command(
        f"change_to_{kind}", title, "Combine/Change to",
        lambda s: done(s.do("change_kind", list(s.selection), kind, label=f"Change to {title.lower()}")),
        _change_fault(kind), icon=kind, tip=f"{title} of the operands that the selected operations have",
        checked=_is(kind),
    )  # fmt: skip


def _title(kind: str) -> str:
    return next(k.title for k in KINDS.values() if function_name(k) == kind)


# What is shown.


def _isolate_fault(session: Session) -> str | None:
    return chosen_fault()(session) or (
        "a definition has no place of its own: isolate one of its instances"
        if any(chosen(session).in_definition)
        else None
    )


def _isolate(session: Session) -> None:
    """Show the selected nodes alone; once more for the same ones ends it."""
    alone = set(session.selection) == set(session.isolated)
    session.isolate(() if alone else session.selection)


def _show_hidden(session: Session) -> None:
    session.do("set_visible", _hidden(session), True, label="Show all hidden")


def _hidden(session: Session) -> list[str]:
    return [node.id for node in walk(*session.document.roots) if not node.visible]


TREE_COMMANDS: tuple[Command, ...] = (
    Command("group", "Group", "Combine", lambda s: done(s.do("combine", "union", list(s.selection), "Group",
            label="Group")), chosen_fault(), "Ctrl+G", "group", "A union around the selected nodes, in their place"),
    *(_change(kind, _title(kind)) for kind in (*JOINING, *SINGLE, "extrude", "revolve")),
    Command("move_up", "Move up", "Edit/Order", _shift(-1), _shift_fault(-1), "Alt+Up", "arrow_up",
            "Before the operand above, within the same operation"),
    Command("move_down", "Move down", "Edit/Order", _shift(1), _shift_fault(1), "Alt+Down", "arrow_down",
            "Behind the operand below, within the same operation"),
    Command("move_out", "Move out", "Edit/Order", _out, _out_fault, "Alt+Left", "arrow_left",
            "Out of the operation, to stand behind it"),
    Command("move_in", "Move in", "Edit/Order", _in, _in_fault, "Alt+Right", "arrow_right",
            "Into the operation above, as its last operand"),
    Command("promote", "Make base", "Edit/Order", lambda s: done(s.do("promote", s.selection[0], label="Make base")),
            _promote_fault, "Alt+Home", "first", "The first operand of its operation: what a difference is cut from"),
    Command("swap", "Swap", "Edit/Order", lambda s: done(s.do("swap", *s.selection)), _swap_fault, "", "swap",
            "Let two nodes change places in the tree"),
    Command("select_parent", "Parent", "Edit/Select", lambda s: s.select(_parents(s)), _no_parent, "Ctrl+Up", "",
            "The operation in which it stands"),
    Command("select_children", "Operands", "Edit/Select", lambda s: s.select(_children(s)), _no_children, "Ctrl+Down",
            "", "The operands of the selected operations"),
    Command("select_same_kind", "Same kind", "Edit/Select", _same_kind, chosen_fault(), "", "",
            "Every node of the kinds that are selected"),
    Command("select_definition", "Definition", "Edit/Select", lambda s: s.select(_definitions(s)), _no_instance, "",
            "", "What the selected instance is an instance of"),
    Command("select_instances", "Instances", "Edit/Select", lambda s: s.select(_instances(s)), _no_instances, "", "",
            "All that share the selected definition"),
    Command("isolate", "Isolate", "View", _isolate, _isolate_fault, "I", "isolate",
            "Show the selected nodes alone, a view that the document knows nothing of"),
    Command("show_all", "Show all", "View", lambda s: s.isolate(()),
            lambda s: None if s.isolated else "nothing is isolated", "Shift+I", "", "End the isolation"),
    Command("show_hidden", "Show all hidden", "Edit", _show_hidden,
            lambda s: None if _hidden(s) else "nothing is hidden", "Alt+H", "", "Make every hidden node visible"),
)  # fmt: skip
