"""A digest at the end of a file: damage shows before the file is opened.

HDF5 checks little of what it reads, and a flipped bit may end the process. It ignores what follows
its own bytes, though, so that other readers take sealed files for what they are.
"""

from __future__ import annotations

import hashlib
import os

from grainfront.errors import InputError

_MARK = b"\nSHA-256 of all bytes before this line: %s\n"
_BLOCK = 1 << 20
_LENGTH = len(_MARK % (b"0" * 64))


def seal(path: str | os.PathLike[str]) -> None:
    """Append the digest of a whole file."""
    with open(path, "r+b") as file:
        file.write(_MARK % hashlib.file_digest(file, "sha256").hexdigest().encode())


def require_sealed(path: str | os.PathLike[str]) -> None:
    """Raise InputError where a file is not what was sealed: cut off, changed or never whole."""
    digest = hashlib.sha256()
    with open(path, "rb") as file:
        left = os.fstat(file.fileno()).st_size - _LENGTH
        while left > 0 and (block := file.read(min(left, _BLOCK))):
            digest.update(block)
            left -= len(block)
        mark = file.read()
    if mark != _MARK % digest.hexdigest().encode():
        raise InputError(
            f"{path}: not a whole NetCDF file of grainfront: cut off, damaged or changed since it "
            "was written"
        )
