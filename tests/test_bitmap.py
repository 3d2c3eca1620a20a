"""Bitmaps: sizes, views, colour key, depths, dithering, what compression loses, files by Pillow, normals."""

from math import inf, log10

import numpy as np
import pytest
from PIL import Image

from solidtree.model.document.errors import Refusal
from solidtree.model.image.bitmap import MASKS_555, of_rgba, of_samples, packed_size, pitch_of
from solidtree.model.image.depth import alpha_to_key, bayer, compared, keyed_to_alpha, through_jpeg, with_depth
from solidtree.model.image.heights import colours_of_normals, normals_of
from solidtree.model.image.pictures import read_bitmap, save_bitmap


def ramp(height=32, width=64):
    grey = np.tile(np.linspace(0, 255, width).astype(np.uint8), (height, 1))
    return of_samples(np.stack([grey] * 3, axis=2), 24)


def test_sizes():
    assert (packed_size(100, 100, 4), 100 * pitch_of(100, 4)) == (5000, 5200)
    assert (packed_size(500, 700, 24), 700 * pitch_of(500, 24)) == (1_050_000, 1_050_000)
    bitmap = of_samples(np.zeros((100, 100), np.uint8), 4)
    assert (bitmap.pitch, bitmap.packed_size, bitmap.stored_size) == (52, 5000, 5200)


def test_views_share_the_bytes():
    for bits, shape in ((8, (3, 5)), (16, (3, 5)), (24, (3, 5, 3)), (32, (3, 5))):
        bitmap = of_samples(np.zeros(shape, f"u{bits // 8}" if bits != 24 else "u1"), bits)
        bitmap.samples()[1, 2] = 7
        assert np.shares_memory(bitmap.samples(), bitmap.pixels) and bitmap.pixels[1].any()


def test_a_colour_key_shows_nothing_and_comes_back():
    rgba = np.zeros((2, 2, 4), np.uint8)
    rgba[..., 3] = 255
    rgba[0, 0] = (1, 2, 3, 0)
    keyed = alpha_to_key(of_rgba(rgba), (255, 0, 255))
    assert keyed.bits == 24 and keyed.to_rgba()[0, 0].tolist() == [255, 0, 255, 0]
    assert keyed_to_alpha(keyed).to_rgba()[..., 3].tolist() == [[0, 255], [255, 255]]
    with pytest.raises(Refusal, match="visible"):
        alpha_to_key(of_rgba(rgba), (0, 0, 0))


@pytest.mark.parametrize("dither", ["none", "floyd-steinberg", "bayer"])
@pytest.mark.parametrize("bits", [1, 2, 4, 8, 16])
def test_a_depth_keeps_the_mean_when_it_is_dithered(bits, dither):
    bitmap = ramp()
    less = with_depth(bitmap, bits, dither, grey=bits <= 8)
    assert less.bits == bits
    levels = 2**bits if bits <= 8 else 32
    values = less.to_rgba()[..., :3].astype(float)
    step = 255.0 / (levels - 1)
    assert np.abs(values - bitmap.to_rgba()[..., :3]).max() <= (step / 2 + 1 if dither == "none" else 2 * step + 1)
    if dither != "none":  # over 8 x 8 pixels the mean stays, but for the ends of the ramp
        means = [each.reshape(4, 8, 8, 8).mean(axis=(1, 3)) for each in (values[..., 0], bitmap.to_rgba()[..., 0])]
        assert np.abs(means[0] - means[1])[:, 1:-1].max() <= 255 / 8


def test_depths_that_lose_nothing():
    colours = np.random.default_rng(2).integers(0, 256, (16, 3), np.uint8)
    bitmap = of_samples(colours[np.arange(256).reshape(16, 16) % 16], 24)
    assert (with_depth(bitmap, 4).to_rgba() == bitmap.to_rgba()).all()
    assert (with_depth(bitmap, 32).to_rgba() == bitmap.to_rgba()).all()
    words = with_depth(bitmap, 16, masks=MASKS_555)
    assert (with_depth(words, 16, masks=MASKS_555).samples() == words.samples()).all()


def test_thresholds_of_bayer():
    assert (bayer(1) * 4 - 0.5).tolist() == [[0, 2], [3, 1]]
    assert sorted((bayer(3) * 64 - 0.5).ravel().tolist()) == list(range(64))


def test_comparison():
    one = of_samples(np.zeros((4, 4, 3), np.uint8), 24)
    other = of_samples(np.full((4, 4, 3), 10, np.uint8), 24)
    found = compared(one, other)
    assert found.largest == 10 and found.psnr == pytest.approx(20 * log10(255 / 10))
    assert compared(one, one).psnr == inf
    with pytest.raises(Refusal):
        compared(one, ramp())


def test_a_lower_quality_is_smaller_and_worse():
    noise = of_samples(np.random.default_rng(3).integers(0, 256, (64, 64, 3), np.uint8), 24)
    good, poor = (through_jpeg(noise, quality)[1] for quality in (95, 20))
    assert good.sizes[1] > poor.sizes[1] and good.psnr > poor.psnr


@pytest.mark.parametrize("ending", ["png", "tiff", "webp", "bmp"])
def test_files_that_lose_nothing(tmp_path, ending):
    rgba = np.random.default_rng(4).integers(0, 256, (7, 9, 4), np.uint8)
    save_bitmap(of_rgba(rgba), tmp_path / f"a.{ending}")
    assert (read_bitmap(tmp_path / f"a.{ending}").to_rgba() == rgba).all()


def test_indices_and_keys_of_png_are_kept(tmp_path):
    picture = Image.new("P", (2, 1))
    picture.putpalette([1, 2, 3, 4, 5, 6])
    picture.putpixel((1, 0), 1)
    picture.save(tmp_path / "a.png", transparency=1)
    bitmap = read_bitmap(tmp_path / "a.png")
    assert bitmap.bits == 8 and bitmap.to_rgba().tolist() == [[[1, 2, 3, 255], [4, 5, 6, 0]]]


def test_sixteen_bit_grey_is_scaled(tmp_path):
    Image.fromarray(np.array([[0, 257 * 100, 65535]], np.uint16)).save(tmp_path / "a.png")
    assert read_bitmap(tmp_path / "a.png").to_rgba()[0, :, 0].tolist() == [0, 100, 255]


@pytest.mark.parametrize("ending", ["png", "jpg", "tif", "webp"])
def test_a_file_cut_short_is_refused(tmp_path, ending):
    path = tmp_path / f"a.{ending}"
    save_bitmap(of_samples(np.random.default_rng(3).integers(0, 256, (64, 64, 3), np.uint8), 24), path)
    path.write_bytes(path.read_bytes()[:-2000])
    with pytest.raises(Refusal, match="cut short"):
        read_bitmap(path)


def test_a_tilted_plane_has_its_normal_everywhere():
    rows, columns = np.indices((6, 7)) * 0.5
    normals = normals_of(0.3 * columns - 0.2 * rows, texel=0.5, strength=2.0)
    wanted = np.array([-0.6, -0.4, 1.0])  # up is against the rows: the plane rises by 0.2 upwards
    assert normals == pytest.approx(np.broadcast_to(wanted / np.linalg.norm(wanted), normals.shape))
    assert colours_of_normals(normals_of(np.zeros((2, 2))))[0, 0].tolist() == [128, 128, 255]


def test_waves_wrap():
    around = np.sin(np.linspace(0, 2 * np.pi, 64, endpoint=False))
    normals = normals_of(np.tile(around, (3, 1)), wrap=True)
    slopes = -normals[1, :, 0] / normals[1, :, 2]
    step = 2 * np.pi / 64
    assert slopes == pytest.approx(np.cos(np.arange(64) * step) * np.sin(step))
