"""BMP files: the corpus' references, files built byte by byte, every depth out and in, broken files."""

import json
import struct
from io import BytesIO

import numpy as np
import pytest
from PIL import Image
from PIL.TiffImagePlugin import TiffImageFile

from solidtree.model.document.errors import Refusal
from solidtree.model.image.bitmap import MASKS_555, MASKS_565, MASKS_888, MASKS_8888, grey_palette, of_samples
from solidtree.model.image.bmp_reading import bitmap_of_bmp
from solidtree.model.image.bmp_writing import bmp_of_bitmap
from solidtree.model.image.fax import fax_rows
from solidtree.model.image.run_length import coded, expanded


def premultiplied(rgba):
    return np.concatenate([rgba[..., :3] * (rgba[..., 3:] / 255.0), rgba[..., 3:]], axis=2)


def suite(corpus):
    return json.loads((corpus / "bmp" / "expected_bmpsuite.json").read_text()).items()


def test_the_corpus_as_its_author_pictures_it(corpus):
    folder = corpus / "bmp" / "bmpsuite"
    off = {}
    for name, told in suite(corpus):
        if told["cls"] == "bad":
            with pytest.raises(Refusal):
                bitmap_of_bmp((folder / name).read_bytes())
            continue
        bitmap = bitmap_of_bmp((folder / name).read_bytes())
        got = premultiplied(bitmap.to_rgba())
        references = (np.array(Image.open(folder / "ref" / ref).convert("RGBA")) for ref in told["accept_refs"])
        least = min(np.abs(got - premultiplied(ref)).max() for ref in references if ref.shape == got.shape)
        # Channels of 9 bits and more were rounded once for the file and once for the reference.
        fine = bitmap.bits == 16 or name in ("q/rgb32-111110.bmp", "q/rgb32-7187.bmp", "q/rgba64.bmp")
        if least > (1 if fine else 0):
            off[name] = least
    assert not off


def file_of(width, height, bits, data, palette=b"", method=0, masks=b"", size=40, colours=0):
    at = 14 + size + len(masks) + len(palette)
    head = struct.pack("<IiiHHIIiiII", size, width, height, 1, bits, method, len(data), 0, 0, colours, 0).ljust(
        size, b"\0"
    )
    return struct.pack("<2sIHHI", b"BM", at + len(data), 0, 0, at) + head + masks + palette + data


BLACK_RED = bytes((0, 0, 0, 0, 0, 0, 255, 0))


def test_one_bit_bottom_up_and_top_down():
    rows = b"\x80\0\0\0" + b"\x40\0\0\0"
    up = bitmap_of_bmp(file_of(2, 2, 1, rows, BLACK_RED)).to_rgba()
    down = bitmap_of_bmp(file_of(2, -2, 1, rows, BLACK_RED)).to_rgba()
    assert up[..., 0].tolist() == [[0, 255], [255, 0]] and down[..., 0].tolist() == [[255, 0], [0, 255]]


def test_a_black_and_white_palette_at_eight_bits():
    data = file_of(4, 1, 8, bytes((0, 1, 1, 0)), bytes((0, 0, 0, 0, 255, 255, 255, 0)), colours=2)
    assert bitmap_of_bmp(data).to_rgba()[0, :, 0].tolist() == [0, 255, 255, 0]


def test_run_length_code_of_the_file_format_reference():
    # Microsoft's example for BI_RLE8 ("Bitmap Compression"), with the pixels that it gives.
    code = bytes.fromhex("0304 0506 0003 4556 6700 0278 0002 0501 0278 0000 091E 0001".replace(" ", ""))
    rows = expanded(code, 20, 3, 8)
    assert rows[0, :13].tolist() == [4] * 3 + [6] * 5 + [0x45, 0x56, 0x67] + [0x78] * 2
    assert rows[1].tolist() == [0] * 18 + [0x78] * 2 and rows[2, :9].tolist() == [0x1E] * 9


def test_run_length_code_of_four_bits():
    code = bytes.fromhex("0304 0506 0006 4556 6700 0478 0000 0901 0001".replace(" ", ""))
    rows = expanded(code, 18, 2, 4)
    assert rows[0].tolist() == [0, 4, 0, 0, 6, 0, 6, 0, 4, 5, 5, 6, 6, 7, 7, 8, 7, 8]
    assert rows[1, :9].tolist() == [0, 1, 0, 1, 0, 1, 0, 1, 0]


@pytest.mark.parametrize(
    ("code", "what"),
    [("0401", "leaves row"), ("0005010203", "ends within a run"), ("00020900", "skips out"), ("0201", "cut short")],
)
def test_broken_run_length_code_is_refused(code, what):
    with pytest.raises(Refusal, match=what):
        expanded(bytes.fromhex(code), 3, 1, 8)


@pytest.mark.parametrize("bits", [4, 8])
def test_run_length_code_out_and_in(bits):
    generator = np.random.default_rng(bits)
    samples = np.repeat(generator.integers(0, 2**bits, (20, 90)), generator.integers(1, 9, 90), axis=1).astype(np.uint8)
    samples[3] = generator.integers(0, 2**bits, samples.shape[1])
    assert (expanded(coded(samples, bits), samples.shape[1], 20, bits) == samples).all()


@pytest.mark.parametrize("width", [1, 3, 8, 33])
@pytest.mark.parametrize("bits", [1, 2, 4, 8, 16, 24, 32])
def test_every_depth_out_and_in(bits, width):
    generator = np.random.default_rng(width)
    samples = generator.integers(0, 2 ** min(bits, 8), (5, width, *((3,) if bits == 24 else ())), np.uint8)
    every = {"masks": {16: MASKS_565, 32: MASKS_8888}[bits]} if bits in (16, 32) else {}
    if every:
        samples = generator.integers(0, 2**bits, (5, width), np.uint32).astype(f"u{bits // 8}")
    palette = None
    if bits <= 8:
        palette = generator.integers(0, 256, (2**bits, 4), np.uint8)
        palette[:, 3] = 255
    bitmap = of_samples(samples, bits, palette, **every)
    data = bmp_of_bitmap(bitmap)
    back = bitmap_of_bmp(data)
    assert back.top_down and (back.samples() == samples).all() and (back.to_rgba() == bitmap.to_rgba()).all()
    if bits != 2:  # Pillow has no 2 bits
        with Image.open(BytesIO(data)) as picture:
            theirs = np.array(picture.convert("RGBA")).astype(int)
        assert np.abs(theirs - bitmap.to_rgba()).max() <= (8 if bits == 16 else 0)  # it cuts 5 bits off
    if bits in (4, 8):
        assert (bitmap_of_bmp(bmp_of_bitmap(bitmap, run_length=True)).to_rgba() == bitmap.to_rgba()).all()


@pytest.mark.parametrize("masks", [MASKS_555, (0xE000, 0x1C00, 0x0300, 0x00FF), (0x7, 0x38, 0x1C0, 0)])
def test_sixteen_bits_of_any_masks(masks):
    words = np.arange(2**16, dtype=np.uint16).reshape(256, 256)
    bitmap = bitmap_of_bmp(bmp_of_bitmap(of_samples(words, 16, masks=masks)))
    for channel, mask in enumerate(masks):
        if mask:
            values = (words & mask).astype(float) / mask * 255.0
            assert np.abs(bitmap.to_rgba()[..., channel] - values).max() <= 0.5 + 1e-9
    assert bitmap.alpha == bool(masks[3])


def test_unused_bits_are_not_alpha():
    bitmap = bitmap_of_bmp(bmp_of_bitmap(of_samples(np.array([[0x00112233]], np.uint32), 32, masks=MASKS_888)))
    assert bitmap.to_rgba().tolist() == [[[0x11, 0x22, 0x33, 255]]] and not bitmap.alpha


def test_a_small_file_of_many_pixels_is_refused_at_once():
    palette = grey_palette(8).tobytes()
    for method, width, height in ((1, 10_000, 10_000), (0, 2**31 - 1, 2**31 - 1), (0, 3_000_000, 2_000_000)):
        with pytest.raises(Refusal):
            bitmap_of_bmp(file_of(width, height, 8, b"\0\1", palette, method))


def test_a_file_without_its_palette_is_refused():
    with pytest.raises(Refusal, match="palette has 0"):
        bitmap_of_bmp(file_of(4, 1, 8, bytes(4)))


def test_only_refusals_come_of_broken_files():
    samples = (np.indices((9, 13)).sum(axis=0) % 16).astype(np.uint8)
    generator = np.random.default_rng(5)
    for data in (bmp_of_bitmap(of_samples(samples, 4)), bmp_of_bitmap(of_samples(samples, 4), run_length=True)):
        broken = [data[:length] for length in range(len(data))]
        for _ in range(1500):
            flipped = bytearray(data)
            for place in generator.integers(0, len(data), 2):
                flipped[place] = generator.integers(0, 256)
            broken.append(bytes(flipped))
        for each in broken:
            try:
                assert bitmap_of_bmp(each).to_rgba().shape[2] == 4
            except Refusal as refusal:
                assert "\n" not in str(refusal)


def test_huffman_code_as_libtiff_writes_it():
    generator = np.random.default_rng(7)
    for width in (1, 63, 64, 65, 1791, 1792, 2623, 5000):
        lengths = generator.integers(1, width + 1, 60)
        rows = np.resize(np.repeat(np.arange(60) % 2, lengths), (6, width)).astype(np.uint8)
        rows[0], rows[1] = 0, 1
        out = BytesIO()
        Image.fromarray(rows.astype(bool)).save(out, "TIFF", compression="group3")
        with Image.open(BytesIO(out.getvalue())) as picture:
            assert isinstance(picture, TiffImageFile)
            tags = picture.tag_v2
            black = 1 if tags[262] else 0  # of libtiff, runs of the bit 1 are black
            (start,), (length,) = tags[273], tags[279]
        code = out.getvalue()[start : start + length]
        assert (fax_rows(code, width, 6) == (rows == black)).all()
        with pytest.raises(Refusal):
            fax_rows(code[: len(code) // 2], width, 6)
