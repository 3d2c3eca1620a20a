"""Bitmaps on the command line: the header as JSON, the pixels as PNG, and what is no bitmap."""

import json

import numpy as np
import pytest
from PIL import Image

from solidtree.model.image.bitmap import of_samples
from solidtree.model.image.pictures import save_bitmap


@pytest.fixture
def path(tmp_path):
    palette = np.array([[255, 0, 255, 255], [1, 2, 3, 255]], np.uint8)
    save_bitmap(of_samples(np.eye(100, dtype=np.uint8), 4, palette), tmp_path / "a.bmp")
    return tmp_path / "a.bmp"


def test_the_header(solidtree, path):
    status, out, _ = solidtree("bitmap", path)
    told = json.loads(out)
    assert status == 0 and told["file_size"] == path.stat().st_size == 14 + 40 + 8 + 5200
    assert (told["bits_per_pixel"], told["bytes_per_pixel"], told["colour_key"]) == (4, 0.5, None)
    assert (told["width"], told["height"], told["pitch"], told["alpha"]) == (100, 100, 52, False)
    assert (told["packed_size"], told["stored_size"], told["compression"]) == (5000, 5200, "none")
    assert told["palette"] == [[255, 0, 255, 255], [1, 2, 3, 255]]


def test_the_pixels_and_a_key(solidtree, path, tmp_path):
    status, out, _ = solidtree("bitmap", path, tmp_path / "out.png", "--key", "255,0,255")
    assert status == 0 and json.loads(out)["colour_key"] == [255, 0, 255]
    with Image.open(tmp_path / "out.png") as picture:
        assert picture.mode == "RGBA"
        assert [picture.getpixel(at) for at in ((0, 0), (1, 0))] == [(1, 2, 3, 255), (255, 0, 255, 0)]


def test_another_depth(solidtree, path):
    told = json.loads(solidtree("bitmap", path, "--depth", "16", "--dither", "bayer")[1])
    assert (told["bits_per_pixel"], told["masks"][:3]) == (16, ["f800", "07e0", "001f"])


def test_what_is_no_bitmap_takes_one_line(solidtree, tmp_path):
    (tmp_path / "a.bmp").write_bytes(b"BM and no more")
    for name in ("a.bmp", "missing.bmp"):
        status, out, err = solidtree("bitmap", tmp_path / name)
        assert (status, out) == (2, "") and err.count("\n") == 1 and err.startswith(f"solidtree: {tmp_path / name}: ")
