"""Packing convex hulls by the optimised advancing front method (Du et al. 2023, section 4)."""

# Local fronts shorter than this are searched exhaustively, which costs little there: the pruned
# search relies on several pairs leading to the same place, and short fronts have but few.
PRUNED_FROM_N_LOC = 8


def search_of(n_angle: int, n_loc: int) -> str:
    """How the lowest trial is found, which decides on the kernels: "exhaustive" or "pruned"."""
    return "pruned" if n_angle * n_loc > 1 and n_loc >= PRUNED_FROM_N_LOC else "exhaustive"
