"""Reading and replacing files; what goes wrong is said in the user's words."""

from __future__ import annotations

import contextlib
import errno
import os
import secrets
from collections.abc import Callable
from pathlib import Path
from typing import BinaryIO

from ..document.errors import Refusal

_REASONS = {
    errno.ENOENT: "there is no such file or folder",
    errno.ENOTDIR: "a part of the path is no folder",
    errno.EISDIR: "this is a folder, not a file",
    errno.EACCES: "permission is denied; choose another place or change its permissions",
    errno.EPERM: "permission is denied; choose another place or change its permissions",
    errno.EROFS: "the disk is read-only; choose another place",
    errno.ENOSPC: "the disk is full; free some space or choose another place",
    errno.EDQUOT: "the disk quota is used up; free some space or choose another place",
    errno.ENAMETOOLONG: "the name is too long",
    errno.EIO: "the disk reports an error; choose another place",
    errno.ESTALE: "the network drive is gone; choose another place",
}


def reason_of(error: OSError) -> str:
    """What went wrong, without the file's name, which the caller knows."""
    return _REASONS.get(error.errno or 0, (error.strerror or "the file cannot be used").lower())


def one_line(text: str) -> str:
    """A message that quotes a file, without the line breaks and control characters that the file may have."""
    return "".join(c if c.isprintable() else "·" for c in text[:500])


def read_whole(path: str | os.PathLike[str], most: int) -> bytes:
    """The bytes of a file of at most `most` bytes. Raises Refusal."""
    try:
        with open(path, "rb") as stream:
            size = os.fstat(stream.fileno()).st_size
            if size <= most:
                data = stream.read(most + 1)  # a pipe or a growing file says a smaller size than it has
                if len(data) <= most:
                    return data
                size = len(data)
    except OSError as error:
        raise Refusal(reason_of(error)) from None
    raise Refusal(f"the file has more than {most / 1e9:.1f} GB, which is more than is read")


def replace_file(path: str | os.PathLike[str], write: Callable[[BinaryIO], object]) -> None:
    """Puts a file in the place of `path`, wholly or not at all; permissions and a symbolic link stay.

    `write` fills a temporary file in the same folder, which is flushed to the disk and then renamed. Raises Refusal;
    the file that was there is then untouched.
    """
    target = Path(os.path.realpath(path))
    temporary = target.with_name(f".{target.name[:60]}.{secrets.token_hex(4)}.part")
    try:
        if target.is_dir():
            raise IsADirectoryError(errno.EISDIR, "")
        with open(temporary, "xb") as stream:
            write(stream)
            stream.flush()
            with contextlib.suppress(FileNotFoundError):
                os.chmod(temporary, target.stat().st_mode & 0o7777)
            os.fsync(stream.fileno())
        os.replace(temporary, target)
        _flush_folder(target.parent)
    except OSError as error:
        raise Refusal(f"cannot be written: {reason_of(error)}") from None
    finally:
        with contextlib.suppress(OSError):
            temporary.unlink(missing_ok=True)


def _flush_folder(folder: Path) -> None:
    # Without this a power cut may bring the old name back. Not every file system knows it, so it may fail.
    with contextlib.suppress(OSError):
        handle = os.open(folder, os.O_RDONLY)
        try:
            os.fsync(handle)
        finally:
            os.close(handle)
