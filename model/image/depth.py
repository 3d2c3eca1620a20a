"""Other depths, with and without dithering; colour key to alpha and back; what compression costs and loses."""

from __future__ import annotations

from dataclasses import dataclass
from io import BytesIO
from math import inf, log10
from typing import Literal

import numpy as np

from ..document.errors import Refusal
from .bitmap import MASKS_555, MASKS_565, MASKS_888, MASKS_8888, Bitmap, Bytes, Masks, grey_palette, of_samples

Dither = Literal["none", "floyd-steinberg", "bayer"]


def with_depth(
    bitmap: Bitmap, bits: int, dither: Dither = "none", *, grey: bool = False, masks: Masks | None = None
) -> Bitmap:
    """The bitmap at 1, 2, 4, 8, 16, 24 or 32 bits a pixel.

    Up to 8 bits the palette is found by median cut (Heckbert 1982), or is even grey levels with `grey`; 1 bit is black
    and white. 16 bits have `masks` 565 unless told. Alpha is kept by 32 bits only, elsewhere it is dropped. 24 and 32
    bits lose no colour and take no dithering.
    """
    rgba = bitmap.to_rgba()
    if bits == 24:
        return of_samples(rgba[..., 2::-1], 24)
    if bits == 32:
        words = np.ascontiguousarray(rgba[..., [2, 1, 0, 3]]).view("<u4")[..., 0]
        if (rgba[..., 3] == 255).all():
            return of_samples(words & np.uint32(0xFFFFFF), 32, masks=MASKS_888)
        return of_samples(words, 32, masks=MASKS_8888)
    rgb = np.ascontiguousarray(rgba[..., :3])
    if bits == 16:
        return _in_words(rgb, masks or MASKS_565, dither)
    if bits not in (1, 2, 4, 8):
        raise Refusal(f"{bits} bits a pixel cannot be made; take 1, 2, 4, 8, 16, 24 or 32")
    return _in_indices(rgb, bits, dither, grey or bits == 1)


def keyed_to_alpha(bitmap: Bitmap) -> Bitmap:
    """32 bits in which the pixels of the colour key, and only those, are clear."""
    words = np.ascontiguousarray(bitmap.to_rgba()[..., [2, 1, 0, 3]]).view("<u4")[..., 0]
    return of_samples(words, 32, masks=MASKS_8888)


def alpha_to_key(bitmap: Bitmap, key: tuple[int, int, int], threshold: int = 128) -> Bitmap:
    """24 bits in which pixels of an alpha below `threshold` have the colour `key`, which is their key.

    Refused where an opaque pixel has that colour already: it would vanish.
    """
    rgba = bitmap.to_rgba()
    clear = rgba[..., 3] < threshold
    if ((rgba[..., :3] == np.array(key, np.uint8)).all(axis=2) & ~clear).any():
        raise Refusal(f"the colour {key} is that of visible pixels too; choose another for the key")
    rgb = np.where(clear[..., None], np.array(key, np.uint8), rgba[..., :3])
    return of_samples(rgb[..., ::-1], 24, colour_key=key)


@dataclass(frozen=True, slots=True, eq=False)
class Comparison:
    """What one picture is against another; sizes in bytes."""

    sizes: tuple[int, int]
    difference: Bytes
    """(height, width, 3): how far each channel is off."""
    largest: int
    psnr: float
    """Peak signal to noise in decibels over red, green and blue; infinite where nothing differs."""


def compared(one: Bitmap, other: Bitmap, sizes: tuple[int, int] | None = None) -> Comparison:
    """Two pictures of the same width and height; `sizes` are those of their files where known, else as stored."""
    if (one.width, one.height) != (other.width, other.height):
        raise Refusal(f"{one.width} x {one.height} and {other.width} x {other.height} pixels cannot be compared")
    first, second = (bitmap.to_rgba()[..., :3] for bitmap in (one, other))
    difference = np.where(first > second, first - second, second - first)
    mean = float(np.square(difference, dtype=np.float64).mean())
    return Comparison(
        sizes or (one.stored_size, other.stored_size),
        difference,
        int(difference.max()),
        10.0 * log10(255.0**2 / mean) if mean else inf,
    )


def through_jpeg(bitmap: Bitmap, quality: int) -> tuple[Bitmap, Comparison]:
    """The picture that JPEG of a quality, 1 to 100, gives back, and what that costs and loses."""
    from PIL import Image

    from .pictures import encoded

    data = encoded(bitmap.to_rgba(), "JPEG", quality)
    with Image.open(BytesIO(data)) as picture:
        back = of_samples(np.asarray(picture)[..., ::-1], 24, type="JPEG", compression="jpeg")
    return back, compared(bitmap, back, (bitmap.stored_size, len(data)))


def bayer(order: int) -> np.ndarray:
    """Thresholds (2 ** order, 2 ** order) in (0, 1), each step of 1 / 4 ** order once (Bayer 1973)."""
    matrix = np.zeros((1, 1))
    for _ in range(order):
        matrix = np.block([[4 * matrix, 4 * matrix + 2], [4 * matrix + 3, 4 * matrix + 1]])
    return (matrix + 0.5) / matrix.size


def _thresholds(height: int, width: int) -> np.ndarray:
    matrix = bayer(3)
    return np.tile(matrix, (-(-height // 8), -(-width // 8)))[:height, :width]


def _in_indices(rgb: Bytes, bits: int, dither: Dither, grey: bool) -> Bitmap:
    from PIL import Image

    picture = Image.fromarray(rgb)
    if grey:
        picture = picture.convert("L").convert("RGB")
        palette = grey_palette(bits)
    else:
        found = picture.quantize(2**bits, Image.Quantize.MEDIANCUT, dither=Image.Dither.NONE)
        colours = np.array(found.getpalette("RGB"), np.uint8).reshape(-1, 3)[: 2**bits]
        palette = np.full((len(colours), 4), 255, np.uint8)
        palette[:, :3] = colours
    if dither == "bayer":
        # One step between neighbours of an even palette is the height of the thresholds.
        step = 255.0 / (2**bits - 1) if grey else 255.0 / (2 ** (bits / 3) - 1)
        shifted = np.asarray(picture, np.float32) + (_thresholds(*rgb.shape[:2]) - 0.5)[..., None] * step
        picture = Image.fromarray(np.clip(np.rint(shifted), 0, 255).astype(np.uint8))
    if grey and dither != "floyd-steinberg":
        levels = np.asarray(picture)[..., 0].astype(np.uint16)
        return of_samples(((levels * (2**bits - 1) + 127) // 255).astype(np.uint8), bits, palette)
    table = Image.new("P", (1, 1))
    # Pillow fills a short palette with black, which would take pixels: the last colour stands in its place.
    full = np.concatenate([palette[:, :3], np.repeat(palette[-1:, :3], 256 - len(palette), axis=0)])
    table.putpalette(full.tobytes())
    method = Image.Dither.FLOYDSTEINBERG if dither == "floyd-steinberg" else Image.Dither.NONE
    indices = np.minimum(np.asarray(picture.quantize(palette=table, dither=method)), len(palette) - 1)
    return of_samples(indices.astype(np.uint8), bits, palette)


def _in_words(rgb: Bytes, masks: Masks, dither: Dither) -> Bitmap:
    words = np.zeros(rgb.shape[:2], np.uint16)
    if masks not in (MASKS_555, MASKS_565):
        raise Refusal("16 bits are made with 5, 5, 5 or 5, 6, 5 bits for red, green and blue")
    for channel, mask in enumerate(masks[:3]):
        low = mask & -mask
        most = mask // low
        values = rgb[..., channel].astype(np.float32) * np.float32(most / 255.0)
        if dither == "bayer":
            levels = np.floor(values + _thresholds(*rgb.shape[:2]).astype(np.float32))
        elif dither == "floyd-steinberg":
            levels = _diffused(values)
        else:
            levels = np.floor(values + 0.5)
        words |= (np.clip(levels, 0, most).astype(np.uint32) * low).astype(np.uint16)
    return of_samples(words, 16, masks=masks)


def _diffused(values: np.ndarray) -> np.ndarray:
    """Whole numbers near `values` (height, width), the error passed on (Floyd and Steinberg 1976).

    Pixels on a slanted line, x + 2 y constant, do not wait for each other: each line is one step.
    """
    height, width = values.shape
    rest = np.zeros((height + 1, width + 2))
    rest[:height, 1:-1] = values
    levels = np.zeros((height, width))
    for line in range(width + 2 * (height - 1)):
        y = np.arange(max(0, (line - width + 2) // 2), min(height - 1, line // 2) + 1)
        x = line - 2 * y
        wanted = rest[y, x + 1]
        levels[y, x] = np.floor(wanted + 0.5)
        error = wanted - levels[y, x]
        rest[y, x + 2] += error * (7 / 16)
        rest[y + 1, x] += error * (3 / 16)
        rest[y + 1, x + 1] += error * (5 / 16)
        rest[y + 1, x + 2] += error * (1 / 16)
    return levels
