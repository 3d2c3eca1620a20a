"""Where the nodes of a tree stand in a drawing: close together, parents over the middle of their children.

The method is that of Reingold and Tilford (1981) in the form that Buchheim, Jünger and Leipert gave it (“Improving
Walker's algorithm to run in linear time”, 2002), for nodes of different widths, and without recursion.
"""

from __future__ import annotations

from collections.abc import Sequence


class TidyTree:
    """The places of nodes 0 (the root), 1, ...

    `children[i]` are a node's children from left to right; `left[i]` and `right[i]` how far it reaches to either side
    of its middle. Two neighbours on a level keep `gap` between them.
    """

    def __init__(
        self, children: Sequence[Sequence[int]], left: Sequence[float], right: Sequence[float], gap: float
    ) -> None:
        count = len(children)
        self._children, self._left, self._right, self._gap = children, left, right, gap
        self._parent = [-1] * count
        self._number = [0] * count
        for parent, family in enumerate(children):
            for number, child in enumerate(family):
                self._parent[child], self._number[child] = parent, number
        self._thread = [-1] * count
        self._ancestor = list(range(count))
        self._prelim, self._mod = [0.0] * count, [0.0] * count
        self._shift, self._change = [0.0] * count, [0.0] * count
        self._default = [family[0] if family else -1 for family in children]
        self.contour_steps = 0
        """How many pairs of nodes were compared; never more than there are nodes."""
        self.x = [0.0] * count
        """The middle of each node; the root's is 0."""
        self.depth = [0] * count
        order = self._from_the_top()
        for node in self._from_below(order):
            self._settle(node)
        inherited = [0.0] * count
        for node in order:
            self.x[node] = self._prelim[node] + inherited[node]
            for child in children[node]:
                inherited[child] = inherited[node] + self._mod[node]
                self.depth[child] = self.depth[node] + 1
        middle = self.x[0] if count else 0.0
        self.x = [x - middle for x in self.x]

    def _from_the_top(self) -> list[int]:
        order, stack = [], [0] if self._children else []
        while stack:
            node = stack.pop()
            order.append(node)
            stack += reversed(self._children[node])
        return order

    def _from_below(self, order: list[int]) -> list[int]:
        """Children before their parents, and left ones before right ones."""
        done, stack = [], [(order[0], False)] if order else []
        while stack:
            node, ready = stack.pop()
            if ready or not self._children[node]:
                done.append(node)
            else:
                stack.append((node, True))
                stack += [(child, False) for child in reversed(self._children[node])]
        return done

    def _apart(self, a: int, b: int) -> float:
        return self._right[a] + self._gap + self._left[b]

    def _settle(self, node: int) -> None:
        """The first walk: a place beside the left sibling, then the sub-tree beside all that is left of it."""
        family, parent = self._children[node], self._parent[node]
        before = self._children[parent][self._number[node] - 1] if parent >= 0 and self._number[node] else -1
        middle = 0.0
        if family:
            self._execute_shifts(family)
            middle = (self._prelim[family[0]] + self._prelim[family[-1]]) / 2
        if before >= 0:
            self._prelim[node] = self._prelim[before] + self._apart(before, node)
            self._mod[node] = self._prelim[node] - middle if family else 0.0
            self._apportion(node, before, parent)
        else:
            self._prelim[node] = middle

    def _execute_shifts(self, family: Sequence[int]) -> None:
        shift = change = 0.0
        for child in reversed(family):
            self._prelim[child] += shift
            self._mod[child] += shift
            change += self._change[child]
            shift += self._shift[child] + change

    def _next_left(self, node: int) -> int:
        return self._children[node][0] if self._children[node] else self._thread[node]

    def _next_right(self, node: int) -> int:
        return self._children[node][-1] if self._children[node] else self._thread[node]

    def _apportion(self, node: int, before: int, parent: int) -> None:
        """Push the sub-tree off the ones to the left of it, contour against contour."""
        mod, prelim = self._mod, self._prelim
        inner_right, outer_right = node, node  # the contours of this sub-tree
        inner_left, outer_left = before, self._children[parent][0]  # and of those on its left
        sum_ir, sum_or, sum_il, sum_ol = mod[inner_right], mod[outer_right], mod[inner_left], mod[outer_left]
        below_left, below_right = self._next_right(inner_left), self._next_left(inner_right)
        while below_left >= 0 and below_right >= 0:
            self.contour_steps += 1
            inner_left, inner_right = below_left, below_right
            outer_left, outer_right = self._next_left(outer_left), self._next_right(outer_right)
            self._ancestor[outer_right] = node
            shift = prelim[inner_left] + sum_il + self._apart(inner_left, inner_right) - prelim[inner_right] - sum_ir
            if shift > 0:
                self._move(self._uppermost(inner_left, node, parent), node, shift)
                sum_ir += shift
                sum_or += shift
            sum_il += mod[inner_left]
            sum_ir += mod[inner_right]
            sum_ol += mod[outer_left]
            sum_or += mod[outer_right]
            below_left, below_right = self._next_right(inner_left), self._next_left(inner_right)
        if below_left >= 0 and self._next_right(outer_right) < 0:
            self._thread[outer_right] = below_left
            mod[outer_right] += sum_il - sum_or
        if below_right >= 0 and self._next_left(outer_left) < 0:
            self._thread[outer_left] = below_right
            mod[outer_left] += sum_ir - sum_ol
            self._default[parent] = node

    def _uppermost(self, inner: int, node: int, parent: int) -> int:
        ancestor = self._ancestor[inner]
        return ancestor if self._parent[ancestor] == parent else self._default[parent]

    def _move(self, first: int, last: int, shift: float) -> None:
        """Shift a sub-tree; those between get their share when the shifts are executed."""
        between = self._number[last] - self._number[first]
        self._change[last] -= shift / between
        self._shift[last] += shift
        self._change[first] += shift / between
        self._prelim[last] += shift
        self._mod[last] += shift
