"""Tables of measurements, in Markdown."""

from __future__ import annotations

import statistics
from collections.abc import Iterable
from dataclasses import dataclass
from typing import NamedTuple


class Spread(NamedTuple):
    """Least, median and largest value of repeated runs."""

    least: float
    median: float
    largest: float

    @classmethod
    def of(cls, values: Iterable[float]) -> Spread:
        """The spread of some values."""
        values = list(values)
        return cls(min(values), statistics.median(values), max(values))

    def text(self, form: str = ".3g") -> str:
        """Median (least–largest)."""
        return f"{self.median:{form}} ({self.least:{form}}–{self.largest:{form}})"


@dataclass(frozen=True)
class Table:
    """A titled table; `note` says what was measured and how."""

    title: str
    note: str
    header: tuple[str, ...]
    rows: list[tuple[str, ...]]

    def markdown(self) -> str:
        """The table as Markdown."""
        lines = [self.header, ("---",) + ("--:",) * (len(self.header) - 1), *self.rows]
        body = "\n".join(f"| {' | '.join(line)} |" for line in lines)
        return f"## {self.title}\n\n{self.note}\n\n{body}\n"
