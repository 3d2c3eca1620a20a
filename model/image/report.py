"""A bitmap's header as the textbook names it."""

from __future__ import annotations

from .bitmap import Bitmap


def header_facts(bitmap: Bitmap, file_size: int) -> dict[str, object]:
    """For JSON; sizes in bytes, `bytes_per_pixel` a fraction below 8 bits, palette rows red, green, blue, alpha."""
    whole, rest = divmod(bitmap.bits, 8)
    key = bitmap.colour_key
    return {
        "type": bitmap.type,
        "bits_per_pixel": bitmap.bits,
        "bytes_per_pixel": bitmap.bits / 8 if rest else whole,
        "colour_key": list(key) if isinstance(key, tuple) else key,
        "width": bitmap.width,
        "height": bitmap.height,
        "pitch": bitmap.pitch,
        "compression": bitmap.compression,
        "palette": None if bitmap.palette is None else bitmap.palette.tolist(),
        "alpha": bitmap.alpha,
        "masks": None if bitmap.masks is None else [f"{mask:0{bitmap.bits // 4}x}" for mask in bitmap.masks],
        "top_down": bitmap.top_down,
        "packed_size": bitmap.packed_size,
        "stored_size": bitmap.stored_size,
        "file_size": file_size,
    }
