"""A bitmap as a data structure: rows of `pitch` bytes, depth, palette, masks, colour key."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Bytes = NDArray[np.uint8]
Masks = tuple[int, int, int, int]

DEPTHS = (1, 2, 4, 8, 16, 24, 32, 64)
MASKS_555: Masks = (0x7C00, 0x03E0, 0x001F, 0)
MASKS_565: Masks = (0xF800, 0x07E0, 0x001F, 0)
MASKS_888: Masks = (0xFF0000, 0xFF00, 0xFF, 0)
MASKS_8888: Masks = (0xFF0000, 0xFF00, 0xFF, 0xFF000000)
MOST_PIXELS = 2**27
"""Pictures of more pixels are refused: their RGBA would take more than half a gigabyte."""


def packed_size(width: int, height: int, bits: int) -> int:
    """Bytes of the pixels when no row is padded: only the last byte may be part empty."""
    return (width * height * bits + 7) // 8


def pitch_of(width: int, bits: int) -> int:
    """Bytes from a row to the next, a multiple of 4 as in BMP and DIB."""
    return (width * bits + 31) // 32 * 4


@dataclass(frozen=True, slots=True, eq=False)
class Bitmap:
    """Pixels as they are stored.

    `pixels` (height, pitch) uint8 holds the rows in stored order, bottom row first unless `top_down`; pixels of less
    than a byte fill it from the highest bit, larger ones are little-endian (blue, green, red, alpha). `palette` (n, 4)
    is RGBA and stands for up to 8 bits. `masks` are the red, green, blue and alpha bits of 16 and 32 bits.
    `colour_key` is the index or the (red, green, blue) that shows nothing. 64 bits are four signed 16-bit channels in
    which 8192 is 1, in linear light (Windows' s2.13).
    """

    width: int
    height: int
    bits: int
    pixels: Bytes
    palette: Bytes | None = None
    masks: Masks | None = None
    colour_key: int | tuple[int, int, int] | None = None
    top_down: bool = False
    type: str = "bitmap"
    """What the file's header calls itself."""
    compression: str = "none"

    @property
    def pitch(self) -> int:
        """Bytes from a row to the next."""
        return self.pixels.shape[1]

    @property
    def alpha(self) -> bool:
        """Whether pixels have a degree of opacity of their own."""
        if self.palette is not None:
            return bool((self.palette[:, 3] < 255).any())
        return self.bits == 64 or bool(self.masks and self.masks[3])

    @property
    def packed_size(self) -> int:
        """Bytes without padding."""
        return packed_size(self.width, self.height, self.bits)

    @property
    def stored_size(self) -> int:
        """Bytes with every row padded to the pitch."""
        return self.pitch * self.height

    def rows(self) -> Bytes:
        """(height, pitch), the top row first; a view."""
        return self.pixels if self.top_down else self.pixels[::-1]

    def samples(self) -> NDArray[np.unsignedinteger]:
        """The pixels' numbers from the top row on: indices or words (height, width); 24 and 64 bits (height, width, n).

        A view of `pixels`, but for less than 8 bits, which are unpacked.
        """
        rows, width = self.rows(), self.width
        if self.bits < 8:
            shifts = np.arange(8 - self.bits, -1, -self.bits, dtype=np.uint8)
            used = rows[:, : (width * self.bits + 7) // 8, None]
            return ((used >> shifts) & np.uint8(2**self.bits - 1)).reshape(self.height, -1)[:, :width]
        if self.bits == 8:
            return rows[:, :width]
        if self.bits == 24:
            return rows[:, : 3 * width].reshape(self.height, width, 3)
        if self.bits == 64:
            return rows[:, : 8 * width].view("<u2").reshape(self.height, width, 4)
        return rows[:, : width * self.bits // 8].view(f"<u{self.bits // 8}")

    def to_rgba(self) -> Bytes:
        """(height, width, 4), the top row first, not premultiplied; an index outside the palette is black."""
        samples = self.samples()
        if self.bits <= 8:
            table = np.zeros((256, 4), np.uint8)
            table[:, 3] = 255
            palette = grey_palette(self.bits) if self.palette is None else self.palette
            table[: len(palette)] = palette[:256]
            if isinstance(self.colour_key, int):
                table[self.colour_key, 3] = 0
            rgba = table[samples]
        elif self.bits == 24:
            rgba = np.empty((self.height, self.width, 4), np.uint8)
            rgba[..., :3] = samples[..., ::-1]
            rgba[..., 3] = 255
        elif self.bits == 64:
            rgba = _of_linear(samples)
        else:
            rgba = np.empty((self.height, self.width, 4), np.uint8)
            masks = self.masks or (MASKS_555 if self.bits == 16 else MASKS_888)
            for channel, mask in enumerate(masks):
                rgba[..., channel] = _channel(samples, mask) if mask or channel < 3 else 255
        if isinstance(self.colour_key, tuple):
            rgba[(rgba[..., :3] == np.array(self.colour_key, np.uint8)).all(axis=2), 3] = 0
        return rgba


def grey_palette(bits: int) -> Bytes:
    """(2 ** bits, 4): even steps from black to white."""
    levels = np.rint(np.linspace(0.0, 255.0, 2**bits)).astype(np.uint8)
    return np.stack([levels, levels, levels, np.full_like(levels, 255)], axis=1)


def packed(samples: NDArray[np.unsignedinteger], bits: int) -> Bytes:
    """Rows (height, pitch) of samples as `Bitmap.samples` gives them."""
    height, width = samples.shape[:2]
    rows = np.zeros((height, pitch_of(width, bits)), np.uint8)
    if bits < 8:
        per_byte = 8 // bits
        padded = np.zeros((height, -(-width // per_byte) * per_byte), np.uint8)
        padded[:, :width] = samples
        for place in range(per_byte):
            rows[:, : padded.shape[1] // per_byte] |= padded[:, place::per_byte] << (8 - bits * (place + 1))
        return rows
    flat = np.ascontiguousarray(samples, f"<u{bits // 8}" if bits in (16, 32) else "<u2" if bits == 64 else np.uint8)
    rows[:, : width * bits // 8] = flat.view(np.uint8).reshape(height, -1)
    return rows


def of_samples(samples: NDArray[np.unsignedinteger], bits: int, palette: Bytes | None = None, **fields) -> Bitmap:
    """A top-down bitmap of samples from the top row on; `fields` are those of `Bitmap`."""
    height, width = samples.shape[:2]
    return Bitmap(width, height, bits, packed(samples, bits), palette=palette, top_down=True, **fields)


def of_rgba(rgba: Bytes, **fields) -> Bitmap:
    """32 bits with alpha where a pixel of (height, width, 4) is not opaque, else 24."""
    if (rgba[..., 3] == 255).all():
        return of_samples(rgba[..., 2::-1], 24, **fields)
    words = np.ascontiguousarray(rgba[..., [2, 1, 0, 3]]).view("<u4")[..., 0]
    return of_samples(words, 32, masks=MASKS_8888, **fields)


def _channel(words: NDArray[np.unsignedinteger], mask: int) -> Bytes:
    """The bits of a mask as 0 to 255, the largest value being 255, rounded."""
    if not mask:
        return np.zeros(words.shape, np.uint8)
    shift = (mask & -mask).bit_length() - 1
    most = mask >> shift
    values = (words & words.dtype.type(mask & np.iinfo(words.dtype).max)) >> words.dtype.type(shift)
    if most == 255:
        return values.astype(np.uint8)
    if most < 2**16:
        return np.floor(np.arange(most + 1) * (255.0 / most) + 0.5).astype(np.uint8)[values]
    return np.floor(values * (255.0 / most) + 0.5).astype(np.uint8)


def _of_linear(samples: NDArray[np.unsignedinteger]) -> Bytes:
    """Blue, green, red, alpha in s2.13 as RGBA; the colours through the curve of sRGB (IEC 61966-2-1)."""
    linear = np.clip(np.arange(-(2**15), 2**15) / 8192.0, 0.0, 1.0)
    curved = np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)
    order = np.arange(2**16, dtype=np.uint16).view(np.int16).astype(np.int32) + 2**15
    of_colour, of_alpha = (np.rint(255.0 * values[order]).astype(np.uint8) for values in (curved, linear))
    return np.concatenate([of_colour[samples[..., 2::-1]], of_alpha[samples[..., 3:]]], axis=2)
