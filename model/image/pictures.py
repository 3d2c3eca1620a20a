"""Bitmaps of files and back, by the file's kind: BMP here, PNG, JPEG, TIFF and WebP through Pillow."""

from __future__ import annotations

import logging
import warnings
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ..document.errors import Refusal
from .bitmap import MOST_PIXELS, Bitmap, Bytes, of_rgba, of_samples

if TYPE_CHECKING:
    from PIL import Image

FORMATS = {".bmp": "BMP", ".dib": "BMP", ".png": "PNG", ".jpg": "JPEG", ".jpeg": "JPEG", ".tif": "TIFF",
           ".tiff": "TIFF", ".webp": "WEBP"}  # fmt: skip
_READ = ("PNG", "JPEG", "TIFF", "WEBP")
_DEEP = ("I;16", "I;16B", "I")
_MOST_BYTES = 2**30
logging.getLogger("PIL").addHandler(logging.NullHandler())  # what it logs is refused here in our words


def is_bitmap(data: bytes) -> bool:
    """Whether these are the first bytes of a kind of file that `read_bitmap` reads."""
    return (
        (data[:2] in (b"BM", b"BA") and len(data) > 26)
        or data.startswith((b"\x89PNG\r\n", b"\xff\xd8\xff", b"II*\0", b"MM\0*"))
        or (data[:4] == b"RIFF" and data[8:12] == b"WEBP")
    )


def read_bitmap(path: str | Path) -> Bitmap:
    """The bitmap in a BMP, PNG, JPEG, TIFF or WebP file, told by its first bytes.

    Indices and palettes of PNG and TIFF are kept, and a transparent index or colour of theirs is the colour key; of
    several pictures the first is taken. `Refusal` for what cannot be read.
    """
    data = file_bytes(path)
    if data[:2] in (b"BM", b"BA"):
        from .bmp_reading import bitmap_of_bmp

        return bitmap_of_bmp(data)
    with _opened(data, _READ) as picture:
        kind, mode = f"{picture.format}", picture.mode
        if mode in ("1", "L", "P"):
            return _indexed(picture, kind)
        key = picture.info.get("transparency")
        if mode == "RGB" and isinstance(key, tuple):
            rgb = np.asarray(picture)
            return of_samples(rgb[..., ::-1], 24, type=kind, compression=_method(picture), colour_key=key)
        return of_rgba(_rgba(picture), type=kind, compression=_method(picture))


def lightness(path: str | Path) -> np.ndarray:
    """(height, width) 0 to 1, as deep as the file has it, rows from the top down: grey, or the weighed mean of the
    colours (ITU-R BT.709), times alpha. Raises Refusal."""
    data = file_bytes(path)
    if data[:2] not in (b"BM", b"BA"):
        with _opened(data, _READ) as picture:
            if picture.mode in _DEEP:
                return np.clip(np.asarray(picture, np.float64) / 65535.0, 0.0, 1.0)
    rgba = read_bitmap(path).to_rgba()
    return (rgba[..., :3] @ np.array([0.2126, 0.7152, 0.0722])) * (rgba[..., 3] / 65025.0)


def file_bytes(path: str | Path) -> bytes:
    """A file's bytes, or a `Refusal` in words."""
    try:
        if Path(path).stat().st_size > _MOST_BYTES:
            raise Refusal("the file is larger than a gigabyte; cut the picture into parts")
        return Path(path).read_bytes()
    except OSError as error:
        raise Refusal(f"it cannot be read: {error.strerror or error}") from None


def rgba_of(data: bytes, formats: tuple[str, ...], size: tuple[int, int]) -> Bytes:
    """(height, width, 4) of a picture's bytes, which must be of one of the formats and of that (width, height)."""
    with _opened(data, formats) as picture:
        if picture.size != size:
            raise Refusal(f"the picture inside is {picture.size[0]} x {picture.size[1]}, not {size[0]} x {size[1]}")
        return _rgba(picture)


def save_bitmap(bitmap: Bitmap, path: str | Path, *, quality: int = 90) -> None:
    """Write by the ending of `path`; `quality` 1 to 100 is for JPEG, which has no transparency."""
    format = FORMATS.get(Path(path).suffix.lower())
    if format is None:
        raise Refusal(f"{path}: the ending must be one of {', '.join(FORMATS)}")
    if format == "BMP":
        from .bmp_writing import bmp_of_bitmap

        data = bmp_of_bitmap(bitmap)
    else:
        data = encoded(bitmap.to_rgba(), format, quality)
    try:
        Path(path).write_bytes(data)
    except OSError as error:
        raise Refusal(f"{path}: it cannot be written: {error.strerror or error}") from None


def encoded(rgba: Bytes, format: str, quality: int = 90) -> bytes:
    """A file's bytes of (height, width, 4); PNG, TIFF and WebP lose nothing, and JPEG drops the alpha."""
    from PIL import Image

    picture = Image.fromarray(rgba)
    out = BytesIO()
    if format == "JPEG":
        picture.convert("RGB").save(out, format, quality=quality)
    elif format == "WEBP":
        picture.save(out, format, lossless=True, exact=True)
    else:
        picture.save(out, format)
    return out.getvalue()


class _opened:
    """A picture, loaded, with Pillow's complaints as refusals and its limit on pixels ours."""

    def __init__(self, data: bytes, formats: tuple[str, ...]) -> None:
        self._data, self._formats = data, formats

    def __enter__(self) -> Image.Image:
        from PIL import Image

        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                picture = Image.open(BytesIO(self._data), formats=self._formats)
                if picture.width * picture.height > MOST_PIXELS:
                    raise Refusal(f"it is {picture.width} x {picture.height} pixels, more than {MOST_PIXELS:,}; cut it")
                picture.load()
        except Refusal:
            raise
        except Image.UnidentifiedImageError:
            raise Refusal("it is no bitmap that can be read (BMP, PNG, JPEG, TIFF, WebP) or is cut short") from None
        except Image.DecompressionBombError as error:
            raise Refusal(f"it is too large to be opened ({error}); cut it") from None
        except Exception as error:  # Pillow's decoders raise whatever a broken file leads them to
            raise Refusal(f"it cannot be read ({error}); the file is damaged or cut short: get it anew") from None
        self._picture = picture
        return picture

    def __exit__(self, *_: object) -> None:
        self._picture.close()


def _method(picture: Image.Image) -> str:
    kinds = {"PNG": "deflate", "JPEG": "jpeg", "WEBP": "webp"}
    return kinds.get(picture.format or "", str(picture.info.get("compression", "none")))


def _rgba(picture: Image.Image) -> Bytes:
    if picture.mode in _DEEP:  # 16-bit grey, which Pillow would clip instead of scaling
        grey = np.clip(np.rint(np.asarray(picture, np.float64) / 257.0), 0, 255).astype(np.uint8)
        return np.stack([grey, grey, grey, np.full_like(grey, 255)], axis=2)
    if picture.mode == "F":
        raise Refusal("its pixels are fractions, not colours; save it with 8 bits a channel")
    return np.array(picture.convert("RGBA"))


def _indexed(picture: Image.Image, kind: str) -> Bitmap:
    key = picture.info.get("transparency")
    if picture.mode == "1":
        palette = np.array([[0, 0, 0, 255], [255, 255, 255, 255]], np.uint8)
        fields = {"colour_key": int(key > 0)} if isinstance(key, int) else {}
        return of_samples(np.asarray(picture, np.uint8), 1, palette, type=kind, compression=_method(picture), **fields)
    samples = np.asarray(picture)
    if picture.mode == "L":
        palette = np.repeat(np.arange(256, dtype=np.uint8)[:, None], 4, axis=1)
        palette[:, 3] = 255
    else:
        colours = np.array(picture.getpalette("RGB"), np.uint8).reshape(-1, 3)
        palette = np.full((max(len(colours), int(samples.max()) + 1), 4), 255, np.uint8)
        palette[len(colours) :, :3] = 0
        palette[: len(colours), :3] = colours
        if isinstance(key, bytes):
            share = np.frombuffer(key, np.uint8)[: len(palette)]
            palette[: len(share), 3] = share
            key = None
    key = key if isinstance(key, int) and key < len(palette) else None
    return of_samples(samples, 8, palette, type=kind, compression=_method(picture), colour_key=key)
