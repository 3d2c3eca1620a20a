"""What the inspector tells of bitmaps, by the textbook's numbers and by counting."""

import numpy as np
import pytest

from solidtree.model.image.access import PAGE, counted, measured
from solidtree.model.image.bitmap import MASKS_565, of_samples
from solidtree.model.image.bmp_writing import bmp_of_bitmap
from solidtree.model.image.inspection import (
    byte_lines,
    channel,
    channels_of,
    lost_words,
    memory_rows,
    number_at,
    pixel_words,
    place_of,
)


def sizes(bitmap, file_size=None):
    return {what: size for what, size, _ in memory_rows(bitmap, file_size)}


def test_the_books_bitmaps_have_the_books_sizes():
    four = of_samples(np.zeros((100, 100), np.uint8), 4, np.full((16, 4), 255, np.uint8))
    assert sizes(four)["Packed"] == "5,000" and sizes(four)["Stored"] == "5,200" and sizes(four)["Palette"] == "64"
    true = of_samples(np.zeros((700, 500, 3), np.uint8), 24)
    assert sizes(true)["Packed"] == sizes(true)["Stored"] == "1,050,000"


@pytest.mark.parametrize("bits", [1, 2, 4, 8, 16, 24, 32])
def test_a_pixel_stands_where_it_is_said_to(bits):
    width, height = 13, 5
    generator = np.random.default_rng(bits)
    if bits == 24:
        samples = generator.integers(0, 256, (height, width, 3)).astype(np.uint8)
    else:
        kind = np.uint8 if bits <= 8 else f"<u{bits // 8}"
        samples = generator.integers(0, 2**bits, (height, width)).astype(kind)
    masks = {16: MASKS_565, 32: (0xFF0000, 0xFF00, 0xFF, 0)}.get(bits)
    bitmap = of_samples(samples, bits, masks=masks)
    stored = bitmap.pixels.tobytes()
    for x, y in ((0, 0), (7, 3), (12, 4)):
        if bits != 24:
            assert number_at(bitmap, x, y) == samples[y, x]
        byte, bit = place_of(bitmap, x, y)
        if bits < 8:
            assert stored[byte] >> (8 - bits - bit) & (2**bits - 1) == samples[y, x]
        else:
            expected = samples[y, x].tobytes()
            assert stored[byte : byte + len(expected)] == expected and bit == 0


def test_words_on_a_pixel():
    palette = np.array([[0, 0, 0, 255], [200, 100, 50, 255]], np.uint8)
    bitmap = of_samples(np.array([[0, 1, 1]], np.uint8), 1, palette)
    words = pixel_words(bitmap, bitmap.to_rgba(), 1, 0)
    assert words == "column 1, row 0: index 1: red 200, green 100, blue 50; byte 0, bit 1 of the pixels"


def test_channels_and_bit_planes():
    samples = np.array([[[10, 20, 30], [40, 50, 60]]], np.uint8)  # blue, green, red
    bitmap = of_samples(samples, 24)
    rgba = bitmap.to_rgba()
    assert channel(bitmap, rgba, "red")[0, :, 0].tolist() == [30, 60]
    assert channel(bitmap, rgba, "alpha").min() == 255
    grey = channel(bitmap, rgba, "luminance")[0, 0, 0]
    assert grey == round(0.2126 * 30 + 0.7152 * 20 + 0.0722 * 10)
    four = of_samples(np.array([[5, 8]], np.uint8), 4)
    assert channels_of(four)[-4:] == ["bit 3", "bit 2", "bit 1", "bit 0"]
    assert channel(four, four.to_rgba(), "bit 0")[0, :, 0].tolist() == [255, 0]
    assert channel(four, four.to_rgba(), "bit 3")[0, :, 0].tolist() == [0, 255]


def test_bytes_are_those_of_the_file():
    data = bmp_of_bitmap(of_samples(np.zeros((4, 4), np.uint8), 8, np.full((1, 4), 255, np.uint8)))
    (line, *_) = byte_lines(data, 5, 2)
    assert line.startswith("00000000  42 4d ") and line.endswith(data[:16].decode("latin-1").translate(
        {n: "·" for n in (*range(32), *range(127, 256))}))  # fmt: skip
    assert [bytes.fromhex(row[10:57]) for row in byte_lines(data, 0, 999)] == [
        data[at : at + 16] for at in range(0, len(data), 16)
    ]
    assert byte_lines(data[20:], 40, 1, base=20) == byte_lines(data, 40, 1)


def test_accesses_are_counted_and_tiles_spare_bytes():
    width, height, tile = 1000, 900, 64
    window, column, row = counted(width, height, tile, 1, 128)
    asked = np.zeros((height, width), bool)
    asked[386:514, 436:564] = True
    pages = np.unique(np.flatnonzero(asked) // PAGE)
    assert window.rows == len(pages) * PAGE
    down, across = np.nonzero(asked)
    assert window.tiles == len(set(zip((down // tile).tolist(), (across // tile).tolist(), strict=True))) * tile * tile
    assert column.tiles < column.rows / 10 and row.rows < row.tiles
    found = measured(np.zeros((300, 200, 3), np.uint8), 32, 50)
    assert [each.name for each in found] == ["window of 50 × 50", "column", "row"]
    assert all(each.rows_time > 0 and each.tiles_time > 0 for each in found)


def test_what_a_file_does_not_keep_is_told():
    palette = np.array([[0, 0, 0, 255], [9, 9, 9, 255]], np.uint8)
    keyed = of_samples(np.array([[0, 1]], np.uint8), 1, palette, colour_key=1)
    assert "colour key" in lost_words(keyed, ".bmp") and "palette" in lost_words(keyed, ".png")
    assert "transparency" in lost_words(keyed, ".jpg")
    assert lost_words(of_samples(np.zeros((2, 2, 3), np.uint8), 24), ".png") == ""
