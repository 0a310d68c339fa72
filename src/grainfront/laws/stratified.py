"""Drawing from a law by randomised stratification, so that every prefix is close to the law."""

from __future__ import annotations

import numpy as np

from grainfront.laws.law import Law

# Strata of a block. The more there are, the weaker the correlation of neighbours, −1/(strata − 1),
# but the longer the incomplete block that may end a prefix.
STRATA = 32
# Multiples of the golden ratio, modulo 1, are the most evenly spread of all such sequences.
GOLDEN = (np.sqrt(5.0) - 1.0) / 2.0
# u = 0 and u = 1 are kept out: there the quantile of an unbounded law is infinite.
SMALLEST_U = 2.0**-53


def stratified(law: Law, n: int, rng: np.random.Generator) -> np.ndarray:
    """Draw `n` values of `law`, float64 of shape (n,), with far less noise than independent draws.

    Each block of STRATA values has one value in each of as many strata of equal probability, in
    random order; within a stratum, the values of successive blocks follow a golden-ratio sequence
    of random start. Each value alone follows the law exactly; the count of any range of values
    in any prefix errs by a few units, whereas that of independent draws errs by sqrt(n).
    """
    n_blocks = -(-n // STRATA)
    stratum = rng.permuted(np.tile(np.arange(STRATA), (n_blocks, 1)), axis=1)
    start = rng.random(STRATA)
    within = (start[stratum] + GOLDEN * np.arange(n_blocks)[:, None]) % 1.0
    u = ((stratum + within) / STRATA).ravel()[:n]
    return law.quantile(np.clip(u, SMALLEST_U, 1.0 - SMALLEST_U))
