"""Fuzz for a while and count: `python tests/fuzz/run.py --minutes 30`.

Random scenes and damaged files take turns; the first failure ends the run with the example that
shows it, made as small as it gets. A hang ends it too, with the place where it hung; what hung is
left in the file `--example`.
"""

from __future__ import annotations

import argparse
import faulthandler
import sys
import time
from collections import Counter
from pathlib import Path

from hypothesis import HealthCheck, given, settings

from grainfront.warm_up import compile_kernels

sys.path.insert(0, str(Path(__file__).parent))
from damage import check_file, damaged_files
from scenes import check_scene, kind_of, scenes

EXAMPLES_A_TURN = 100
HANGS_S = 100.0  # no example takes more than seconds
SEARCHES = [f"{regions}{search}" for regions in ("", "arranged_")
            for search in ("exhaustive", "pruned", "controlled",
                           "exhaustive_outlined", "pruned_outlined")]  # fmt: skip


def begin(path: Path, example: object) -> None:
    """Write down what is tried next, and give it as long as nothing takes that does not hang."""
    path.write_text(repr(example), encoding="utf-8")
    faulthandler.dump_traceback_later(HANGS_S, exit=True)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--minutes", type=float, default=30.0)
    parser.add_argument("--example", type=Path, default=Path("fuzzed.txt"))
    options = parser.parse_args()
    counts: Counter[str] = Counter()
    profile = settings(
        max_examples=EXAMPLES_A_TURN, deadline=None, database=None,
        suppress_health_check=list(HealthCheck),
    )  # fmt: skip

    @profile
    @given(scenes())
    def try_scene(described):
        begin(options.example, described)
        counts[f"{kind_of(described[0])} {check_scene(*described)}"] += 1

    @profile
    @given(damaged_files())
    def try_file(damaged):
        begin(options.example, damaged)
        counts[f"{damaged[0]} {check_file(*damaged)}"] += 1

    for search in SEARCHES:
        compile_kernels(search)
    end = time.monotonic() + 60.0 * options.minutes
    while time.monotonic() < end:
        try_scene()
        for _ in range(4):
            try_file()
        print(f"{sum(counts.values())}: {dict(sorted(counts.items()))}", flush=True)
    faulthandler.cancel_dump_traceback_later()
    options.example.unlink(missing_ok=True)


if __name__ == "__main__":
    main()
