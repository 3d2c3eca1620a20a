"""Arrays in tiles: the index formula, both ways, and files read by window, column and level."""

import numpy as np
import pytest

from solidtree.model.document.errors import Refusal
from solidtree.model.image.tiled_file import Piece, TiledFile, bands_of_pieces, write_tiled
from solidtree.model.image.tiles import position_of, tile_and_place, tiled, tiled_index, untiled


def test_nine_by_nine_in_tiles_of_three():
    rows = np.arange(81).reshape(9, 9)
    order = tiled(rows, 3).ravel()
    assert order[:9].tolist() == [0, 1, 2, 9, 10, 11, 18, 19, 20]
    assert order[9:12].tolist() == [3, 4, 5] and order[27] == 27
    assert tiled_index(4, 1, 9, 3) == 13 and tile_and_place(4, 1, 9, 3) == (1, 4)


@pytest.mark.parametrize(("height", "width", "tile"), [(3, 3, 3), (7, 10, 4), (1, 9, 2), (8, 8, 8), (5, 4, 16)])
def test_the_formula_is_the_memory(height, width, tile):
    rows = np.arange(1, height * width + 1).reshape(height, width)
    y, x = np.indices(rows.shape)
    flat = tiled(rows, tile).ravel()
    index = tiled_index(x, y, width, tile)
    assert (flat[index] == rows).all() and flat.sum() == rows.sum()
    number, place = tile_and_place(x, y, width, tile)
    assert (number * tile * tile + place == index).all()
    assert (np.array(position_of(index, width, tile)) == [x, y]).all()
    assert (untiled(tiled(rows, tile), width, height) == rows).all()


@pytest.fixture
def picture(tmp_path):
    pixels = np.random.default_rng(1).integers(0, 256, (75, 131, 3), np.uint8)
    write_tiled(tmp_path / "a.tiles", (pixels[at : at + 7] for at in range(0, 75, 7)), 131, 75, 3, tile=16)
    return pixels, tmp_path / "a.tiles"


def test_windows_and_columns(picture):
    pixels, path = picture
    file = TiledFile(path)
    assert (file.window(0, 0, 131, 75) == pixels).all()
    before = file.bytes_read
    assert (file.window(30, 14, 5, 4) == pixels[14:18, 30:35]).all()
    assert file.bytes_read - before == 4 * 16 * 16 * 3
    before = file.bytes_read
    assert (file.column(130) == pixels[:, 130]).all()
    assert file.bytes_read - before == 5 * 16 * 16 * 3
    with pytest.raises(Refusal, match="leave"):
        file.window(130, 0, 2, 2)


def test_levels_are_means(picture):
    pixels, path = picture
    file = TiledFile(path)
    assert file.levels == [(131, 75), (66, 38), (33, 19), (17, 10), (9, 5)]
    even = np.pad(pixels, ((0, 1), (0, 1), (0, 0)), mode="edge").astype(int)
    means = (even[::2, ::2] + even[1::2, ::2] + even[::2, 1::2] + even[1::2, 1::2] + 2) // 4
    assert (file.window(0, 0, 66, 38, level=1) == means).all()
    assert file.window(0, 0, 9, 5, level=4).mean() == pytest.approx(pixels.mean(), abs=4)


def test_one_picture_of_many(tmp_path):
    loaded = []

    def load(value):
        loaded.append(value)
        return np.full((20, 20, 1), value, np.uint8)

    places = [(0, 0), (20, 0), (0, 20), (30, 30), (-10, 35)]
    pieces = [Piece(x, y, 20, 20, lambda value=n + 1: load(value)) for n, (x, y) in enumerate(places)]
    write_tiled(tmp_path / "a", bands_of_pieces(pieces, 45, 45, 1, rows=8), 45, 45, 1, tile=16)
    whole = TiledFile(tmp_path / "a").window(0, 0, 45, 45)[..., 0]
    wanted = np.zeros((45, 45), np.uint8)
    for n, (x, y) in enumerate(places):
        wanted[y : y + 20, max(x, 0) : x + 20] = n + 1
    assert (whole == wanted).all() and sorted(loaded) == [1, 2, 3, 4, 5]


def test_what_is_no_file_of_tiles_is_refused(picture, tmp_path):
    _, path = picture
    path.write_bytes(path.read_bytes()[:-1])
    with pytest.raises(Refusal, match="bytes"):
        TiledFile(path)
    path.write_bytes(b"x" * 100)
    with pytest.raises(Refusal, match="no file of tiles"):
        TiledFile(path)
    with pytest.raises(Refusal, match="rows came"):
        write_tiled(tmp_path / "b", [np.zeros((3, 4, 1), np.uint8)], 4, 5, 1)
