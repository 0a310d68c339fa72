"""Where shapes come from: one frozen dataclass a source, free of any import that costs time."""

from __future__ import annotations

from dataclasses import dataclass
