"""What hangs together by pairs."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Numbers = NDArray[np.int64]


def pieces(one: NDArray[np.integer], two: NDArray[np.integer], count: int) -> Numbers:
    """(count,) which of `count` things hang together by the pairs (k,), (k,), numbered by their first member."""
    from scipy.sparse import coo_matrix
    from scipy.sparse.csgraph import connected_components

    if not count:
        return np.zeros(0, np.int64)
    graph = coo_matrix((np.ones(len(one), np.int8), (one, two)), (count, count))
    number, label = connected_components(graph, directed=False)
    first = np.full(number, count)
    np.minimum.at(first, label, np.arange(count))
    rank = np.empty(number, np.int64)
    rank[np.argsort(first)] = np.arange(number)
    return rank[label]
