"""Booleans of many operands, cut so that a small change re-cuts little.

A wide union is a hidden tree of small ones. A difference remembers what it was cut from: where only a few of many
operands change, the solid without those few is kept, and only they are cut anew.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from hashlib import blake2b

from manifold3d import Manifold, OpType

WIDE = 64
GROUP = 32
MANY = 48
"""From how many subtracted operands on a difference is remembered."""


@dataclass(slots=True)
class Operand:
    """A placed solid and the key of its value: equal keys are equal solids in equal places."""

    key: bytes
    solid: Manifold


def joint_key(word: str, keys: list[bytes]) -> bytes:
    state = blake2b(word.encode(), digest_size=16)
    for key in keys:
        state.update(key)
    return state.digest()


Remember = Callable[[bytes, Callable[[], Manifold]], Manifold]
"""`remember(key, make)`: the kept solid of this key, or a new one that is kept from now on."""


def union_of(operands: list[Operand], remember: Remember | None = None) -> Manifold:
    """The union. With `remember`, through a hidden tree where there are many: a change of one then re-cuts little."""
    while remember is not None and len(operands) > WIDE:
        groups = [operands[i : i + GROUP] for i in range(0, len(operands), GROUP)]
        operands = [_group(group, remember) for group in groups]
    return _union([operand.solid for operand in operands])


def _group(group: list[Operand], remember: Remember) -> Operand:
    if len(group) == 1:
        return group[0]
    key = joint_key("union", [operand.key for operand in group])
    return Operand(key, remember(key, lambda: forced(_union([operand.solid for operand in group]))))


def _union(solids: list[Manifold]) -> Manifold:
    if not solids:
        return Manifold()
    return solids[0] if len(solids) == 1 else Manifold.batch_boolean(solids, OpType.Add)


def forced(solid: Manifold) -> Manifold:
    """manifold3d works when it is asked for something; this asks."""
    solid.num_tri()
    return solid


@dataclass(slots=True)
class Cut:
    """The last difference with this first operand: its subtracted operands by key, and the result."""

    tail: dict[bytes, Operand]
    result: Manifold


class Cuts:
    """Differences of many operands, remembered by their first one, for an editor where one operand moves at a time."""

    def __init__(self, most: int = 8) -> None:
        self._last: dict[bytes, Cut] = {}
        self._most = most

    def difference_of(self, first: Operand, tail: list[Operand], remember: Remember) -> Manifold:
        """`first` less all of `tail`."""
        if len(tail) < MANY:
            return forced(first.solid - union_of(tail))
        wanted = {operand.key: operand for operand in tail}
        last = self._last.pop(first.key, None)
        few = max(1, len(tail) // 16)
        result: Manifold | None = None
        if last is not None:
            gone = [key for key in last.tail if key not in wanted]
            new = [key for key in wanted if key not in last.tail]
            if len(gone) + len(new) <= 2 * few:
                result = self._recut(first, wanted, last, gone, new, remember)
        if result is None:
            result = forced(first.solid - union_of(tail))
        self._last[first.key] = Cut(wanted, result)
        if len(self._last) > self._most:
            self._last.pop(next(iter(self._last)))
        return result

    def _recut(
        self,
        first: Operand,
        wanted: dict[bytes, Operand],
        last: Cut,
        gone: list[bytes],
        new: list[bytes],
        remember: Remember,
    ) -> Manifold:
        """The difference, from the solid that lacks only the operands which change: all that stay are cut already."""
        stay = [key for key in wanted if key in last.tail]
        base = last.result
        if gone:
            key = joint_key("less", [first.key, *sorted(stay)])
            base = remember(key, lambda: forced(first.solid - union_of([wanted[k] for k in stay])))
        return forced(base - _union([wanted[key].solid for key in new])) if new else base
