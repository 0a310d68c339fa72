"""Compiling the kernels: one decorator, and a cache that notices every change of their sources.

Numba's own cache looks only at the file of the function it compiles, so an edit of an inlined
kernel in another file would go unnoticed. The cache folder here is named by a digest of all kernel
sources, the Python and numba versions and the processor.
"""

from __future__ import annotations

import hashlib
import os
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import numba

_PACKAGE = Path(__file__).parent
KERNEL_SOURCES = ("jit.py", "certificate.py", "geometry", "packing")


@cache
def kernel_digest() -> str:
    """Hexadecimal digest of everything that the machine code depends on."""
    digest = hashlib.sha256()
    for part in (sys.version, numba.__version__, str(numba.core.codegen.get_host_cpu_features())):
        digest.update(part.encode())
    for source in KERNEL_SOURCES:
        path = _PACKAGE / source
        for file in sorted(path.rglob("*.py")) if path.is_dir() else [path]:
            digest.update(file.relative_to(_PACKAGE).as_posix().encode())
            digest.update(file.read_bytes())
    return digest.hexdigest()[:16]


@cache
def cache_folder() -> Path:
    """The first writable folder for compiled kernels: GRAINFRONT_CACHE, the user's, a temporary."""
    user_cache = os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache"
    folders = [Path(user_cache) / "grainfront", Path(tempfile.gettempdir()) / "grainfront"]
    if os.environ.get("GRAINFRONT_CACHE"):
        folders = [Path(os.environ["GRAINFRONT_CACHE"])]
    for folder in folders:
        try:
            (folder / kernel_digest()).mkdir(parents=True, exist_ok=True)
        except OSError:
            continue
        if os.access(folder / kernel_digest(), os.W_OK):
            return folder / kernel_digest()
    raise OSError(f"no writable folder for compiled kernels among {', '.join(map(str, folders))}")


# Kernels work on the arrays they are given and allocate none, so that arrays need no reference
# counts; counting them atomically would take most of the time of an advancing front.
_OPTIONS: dict[str, Any] = {"error_model": "numpy", "_nrt": False}


def kernel(function: Callable[..., Any]) -> Any:
    """Compile a kernel on first use and cache it on disk."""
    config: Any = numba.config  # its settings are made at run time
    previous = config.CACHE_DIR
    config.CACHE_DIR = str(cache_folder())
    try:
        return numba.njit(cache=True, nogil=True, **_OPTIONS)(function)
    finally:
        config.CACHE_DIR = previous


def inlined(function: Callable[..., Any]) -> Any:
    """Compile a small kernel into each of its callers: arrays are not passed word by word."""
    return numba.njit(forceinline=True, **_OPTIONS)(function)


@dataclass
class Compilation:
    """The seconds that compiling kernels took, or reading them from the cache."""

    seconds: float = 0.0


@contextmanager
def compiling(name: str) -> Iterator[Compilation]:
    """Time the first calls of kernels; say so on standard error where they are yet to compile."""
    compiled = cache_folder() / f"{name}.compiled"
    config: Any = numba.config
    if not compiled.exists() and not config.DISABLE_JIT:
        print(f"Compiling the kernels of the {name}, once …", file=sys.stderr, flush=True)
    compilation = Compilation()
    start = time.perf_counter()
    yield compilation
    compilation.seconds = time.perf_counter() - start
    compiled.touch()
