"""The advancing front: Back and Front, two stacks whose tops meet at the gap (paper, Fig. 8)."""

from __future__ import annotations

import numpy as np

from grainfront.jit import inlined
from grainfront.packing.state import BOTTOM_WALL, LEFT_WALL, RIGHT_WALL, Front


def make_front(capacity: int) -> Front:
    """The front of an empty rectangle: Back holds the left wall, Front the bottom and the right."""
    member = np.empty(capacity + 3, dtype=np.int32)
    member[0], member[-2:] = LEFT_WALL, (BOTTOM_WALL, RIGHT_WALL)
    ends = np.array([1, member.size - 2], dtype=np.int64)
    return Front(member, np.full(capacity, -1, dtype=np.int32), ends)


@inlined
def front_length(front):
    """Members of Back and Front together."""
    return front.ends[0] + front.member.size - front.ends[1]


@inlined
def member_at(front, position):
    """The member at a position along the front."""
    back = front.ends[0]
    return front.member[np.uint64(position if position < back else position - back + front.ends[1])]


@inlined
def position_of(front, particle):
    """Position of a particle along the front, or -1 where it is buried."""
    slot = front.slot[particle]
    if slot < front.ends[0]:
        return slot
    return slot - front.ends[1] + front.ends[0]


@inlined
def _move(front, origin, target):
    member = front.member[origin]
    front.member[target] = member
    if member >= 0:
        front.slot[member] = target


@inlined
def move_gap(front, position):
    """Shift members from stack to stack until Back ends just before `position`."""
    while front.ends[0] < position:
        _move(front, front.ends[1], front.ends[0])
        front.ends[0] += 1
        front.ends[1] += 1
    while front.ends[0] > position:
        front.ends[0] -= 1
        front.ends[1] -= 1
        _move(front, front.ends[0], front.ends[1])


@inlined
def bury(front, i, k, particle):
    """Put a particle between positions i and k; the members between them leave the front."""
    move_gap(front, i + 1)
    for _ in range(i + 1, k):
        member = front.member[front.ends[1]]
        if member >= 0:
            front.slot[member] = -1
        front.ends[1] += 1
    front.member[front.ends[0]] = particle
    front.slot[particle] = front.ends[0]
    front.ends[0] += 1
