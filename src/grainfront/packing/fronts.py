"""The loop about the kernel: one front, and among obstacles as many as there are places for."""

from __future__ import annotations

from typing import TYPE_CHECKING

from grainfront.packing.advance import advance

if TYPE_CHECKING:
    from grainfront.packing.under_way import State


def advance_to(state: State, limit: int) -> None:
    """Place particles until there are `limit` of them or the domain is full."""
    if state.keeper is not None:
        state.keeper.share_out(state.front, state.placed, state.queues, state.supply)
    *arguments, _, _ = state
    advance(*arguments, limit)
    if state.domain.obstacles is not None:
        from grainfront.packing.elsewhere import other_fronts

        for _ in other_fronts(state, state.domain.obstacles, limit):
            advance(*arguments, limit)
