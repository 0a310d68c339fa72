"""Ragged polygons: the plain data type that every stage hands on."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Polygons:
    """Simple polygons, counter-clockwise, the first node not repeated at the end.

    Polygon i has the nodes ``nodes[offsets[i]:offsets[i + 1]]``; `nodes` is float64 of shape
    (n_nodes, 2), `offsets` int64 of shape (n_polygons + 1,).
    """

    nodes: np.ndarray
    offsets: np.ndarray

    @classmethod
    def of(cls, polygons: Iterable[np.ndarray]) -> Polygons:
        """Join single polygons, each of shape (n, 2)."""
        parts = [np.asarray(p, dtype=np.float64) for p in polygons]
        offsets = np.zeros(len(parts) + 1, dtype=np.int64)
        np.cumsum([len(p) for p in parts], out=offsets[1:])
        return cls(np.concatenate(parts) if parts else np.empty((0, 2)), offsets)

    @property
    def count(self) -> int:
        """How many polygons there are."""
        return self.offsets.size - 1

    @property
    def node_counts(self) -> np.ndarray:
        """Nodes of each polygon, shape (n_polygons,)."""
        return np.diff(self.offsets)

    def polygon(self, i: int) -> np.ndarray:
        """Nodes of polygon i, shape (n, 2), a view."""
        return self.nodes[self.offsets[i] : self.offsets[i + 1]]

    def chosen(self, index: np.ndarray) -> Polygons:
        """Some of the polygons alone."""
        counts = self.node_counts[index]
        offsets = np.concatenate([[0], np.cumsum(counts)]).astype(np.int64)
        nodes = np.arange(offsets[-1]) + np.repeat(self.offsets[:-1][index] - offsets[:-1], counts)
        return Polygons(self.nodes[nodes], offsets)

    def joined(self, other: Polygons) -> Polygons:
        """These polygons and others after them."""
        offsets = np.concatenate([self.offsets, other.offsets[1:] + self.offsets[-1]])
        return Polygons(np.concatenate([self.nodes, other.nodes]), offsets)

    def to_shapely(self) -> np.ndarray:
        """Shapely polygons, shape (n_polygons,)."""
        import shapely

        rings = np.repeat(np.arange(self.count), self.node_counts)
        return shapely.polygons(shapely.linearrings(self.nodes, indices=rings))
