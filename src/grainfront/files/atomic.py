"""Files that are either whole or absent: written beside their place and renamed at the end."""

from __future__ import annotations

import os
import uuid
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from grainfront.errors import InputError


@contextmanager
def replacing(path: str | os.PathLike[str]) -> Iterator[Path]:
    """Yield a temporary name beside `path`; rename it to `path` if the block ends without error.

    An existing file at `path` stays untouched until then. Errors: those of `require_writable`;
    whatever the block raises, an OSError with the name of the file.
    """
    path = Path(path)
    require_writable(path)
    temporary = _temporary(path)
    try:
        yield temporary
        _sync(temporary)
        os.replace(temporary, path)
        _sync(path.parent)
    except OSError as error:
        if error.errno is None:
            raise
        # a full disk is told without a name, or with the temporary one
        raise OSError(error.errno, error.strerror, str(path)) from error
    finally:
        temporary.unlink(missing_ok=True)


def _temporary(path: Path) -> Path:
    """A name beside `path`; the suffix stays, because some writers choose the format by it."""
    return path.with_name(f".{path.stem}.{uuid.uuid4().hex}.partial{path.suffix}")


def require_writable(path: str | os.PathLike[str]) -> None:
    """Raise InputError where no file can be put at `path`.

    That is where its folder does not exist or cannot be written to, where something else than a
    file, such as a folder or a device, would be replaced, and where its name is not in UTF-8 or too
    long.
    """
    path = Path(path)
    if str(path).encode(errors="replace") != str(path).encode(errors="surrogateescape"):
        raise InputError(f"{str(path)!a}: is not a name in UTF-8")
    try:
        taken = path.exists() and not path.is_file()
        if not taken:
            _temporary(path).exists()
    except OSError as error:
        raise InputError(f"{path}: is not a name for a file ({error.strerror})") from None
    if taken:
        raise InputError(f"{path}: is a folder or a device, but must be the name of a file")
    if not path.parent.is_dir():
        raise InputError(f"{path}: the folder {path.parent} does not exist")
    if not os.access(path.parent, os.W_OK):
        raise InputError(f"{path}: the folder {path.parent} is not writable")


def write_text(path: str | os.PathLike[str], text: str) -> None:
    """Write `text` as UTF-8, whole or not at all."""
    with replacing(path) as temporary:
        temporary.write_text(text, encoding="utf-8")


def _sync(path: Path) -> None:
    """Wait until the file or folder is on the disk, so that a power cut cannot undo its order."""
    descriptor = os.open(path, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)
