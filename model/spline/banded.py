"""Systems of equations whose matrix is a band, also one that goes around: what interpolation and fitting solve."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Numbers = NDArray[np.intp]

DENSE = 192
"""Up to so many unknowns LAPACK's dense solver is as fast."""
ORTHOGONAL = 48
"""Up to so many unknowns the slower orthogonal decomposition costs nothing to speak of."""


def solved(entries: Floats, first: Numbers, right: Floats) -> Floats:
    """(n, d) x of the n equations in which row i has the `entries` (n, w) in the columns first[i], first[i] + 1, ...

    Columns are modulo n. Row i must lie within w columns of the diagonal. Block elimination (as Golub and Van Loan
    2013, 4.5.1) with the last unknowns as border; stable for the totally positive matrices of B-splines (de Boor and
    Pinkus 1977) and for normal equations. Raises LinAlgError for a singular matrix.
    """
    count, width = entries.shape
    columns = (first[:, None] + np.arange(width)) % count
    numbers = np.broadcast_to(np.arange(count)[:, None], columns.shape)
    size = max(2 * width, 32)
    blocks = (count - width) // size
    if count <= DENSE or blocks < 2:
        dense = np.zeros((count, count))
        np.add.at(dense, (numbers, columns), entries)
        return np.asarray(np.linalg.solve(dense, right), float)
    inner = blocks * size
    border = count - inner
    band = np.zeros((blocks, size, 3 * size))
    here = (numbers < inner) & (columns < inner)
    block = numbers[here] // size
    np.add.at(band, (block, numbers[here] % size, columns[here] - (block - 1) * size), entries[here])
    beside = np.zeros((inner, border + right.shape[1]))
    beside[:, border:] = right[:inner]
    there = (numbers < inner) & (columns >= inner)
    np.add.at(beside, (numbers[there], columns[there] - inner), entries[there])
    last = np.zeros((border, count))
    below = numbers >= inner
    np.add.at(last, (numbers[below] - inner, columns[below]), entries[below])
    known = _block_tridiagonal(band, beside.reshape(blocks, size, -1)).reshape(inner, -1)
    through = last[:, :inner] @ known
    rest = np.linalg.solve(last[:, inner:] - through[:, :border], right[inner:] - through[:, border:])
    return np.concatenate([known[:, border:] - known[:, :border] @ rest, rest], dtype=float)


def least_squares(
    rows: Floats, first: Numbers, values: Floats, count: int, ends: Floats | None = None, cyclic: bool = False
) -> Floats:
    """(count, d) unknowns x for which the rows (w, m), from column first[i] on, give the values (m, d) best.

    `ends` (2, d) are the first and the last unknown, given. Few unknowns by orthogonal decomposition, which finds the
    shortest x where several are best; many by the normal equations and a correction (Björck 1987). Raises LinAlgError
    where these do not determine x.
    """
    width = len(rows)
    columns = first + np.arange(width)[:, None]
    if cyclic:
        columns %= count
    if count <= ORTHOGONAL:
        dense = np.zeros((len(first), count))
        np.add.at(dense, (np.broadcast_to(np.arange(len(first)), columns.shape), columns), rows)
        if ends is None:
            return np.asarray(np.linalg.lstsq(dense, values, rcond=None)[0], float)
        inner = np.linalg.lstsq(dense[:, 1:-1], values - dense[:, [0, -1]] @ ends, rcond=None)[0]
        return np.concatenate([ends[:1], inner, ends[1:]], dtype=float)
    if ends is not None:
        made = np.zeros((count, values.shape[1]))
        made[[0, -1]] = ends
        values = values - np.einsum("wm,wmd->md", rows, made[columns])
        rows = np.where((columns == 0) | (columns == count - 1), 0.0, rows)
    normal = np.zeros((count, 2 * width - 1))
    for i in range(width):
        for j in range(width):
            normal[:, width - 1 + j - i] += np.bincount(columns[i], rows[i] * rows[j], count)
    if ends is not None:
        normal[[0, -1], width - 1] = 1.0
    start = np.arange(count) - width + 1
    x = np.zeros((count, values.shape[1]))
    for _ in range(2):
        off = values - np.einsum("wm,wmd->md", rows, x[columns])
        pull = np.zeros_like(x)
        np.add.at(pull, columns, rows[..., None] * off)
        x += solved(normal, start, pull)
    if ends is not None:
        x[[0, -1]] = ends
    return x


def _block_tridiagonal(band: Floats, right: Floats) -> Floats:
    """(k, b, c) x of a matrix with rows of blocks (k, b, 3 b): before, on and after the diagonal."""
    size = band.shape[1]
    after = np.empty((len(band), size, size))
    made = right.copy()
    for k, row in enumerate(band):
        middle, side = row[:, size : 2 * size], made[k]
        if k:
            middle = middle - row[:, :size] @ after[k - 1]
            side = side - row[:, :size] @ made[k - 1]
        both = np.linalg.solve(middle, np.concatenate([row[:, 2 * size :], side], axis=1))
        after[k], made[k] = both[:, :size], both[:, size:]
    for k in range(len(band) - 2, -1, -1):
        made[k] -= after[k] @ made[k + 1]
    return made
