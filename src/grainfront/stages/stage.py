"""What every stage has in common: faults end the job with one sentence."""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from typing import ParamSpec

from grainfront import api
from grainfront.errors import InputError

P = ParamSpec("P")


def stage(run: Callable[P, None]) -> Callable[P, None]:
    """End the process with one sentence where the input is at fault."""

    @wraps(run)
    def told(*args: P.args, **kwargs: P.kwargs) -> None:
        try:
            run(*args, **kwargs)
        except (InputError, OSError, MemoryError) as error:
            raise SystemExit(api.sentence(error)) from None

    return told
