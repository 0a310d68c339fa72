"""Measure the kernels, the packings and the checks: `python benchmarks/run.py [--quick]`.

Writes `benchmarks/results.md`. Subjects are files of this folder, each with a function
`tables(quick)`; medians are over repeated runs, and compilation is excluded everywhere but in its
own table. Measure on an idle machine.
"""

from __future__ import annotations

import argparse
from importlib import import_module
from pathlib import Path

from machine import description

from grainfront.files.atomic import write_text

SUBJECTS = (
    "kernels",
    "packings",
    "pruning",
    "arrangement",
    "growth",
    "checks",
    "effort",
    "targets",
    "compilation",
)
RESULTS = Path(__file__).with_name("results.md")


def main() -> None:
    """Measure all subjects or those named; only a full run is written to the results."""
    parser = argparse.ArgumentParser(description="Measure grainfront.")
    parser.add_argument("subjects", nargs="*", metavar="SUBJECT", help=", ".join(SUBJECTS))
    parser.add_argument("--quick", action="store_true", help="try each once, small; writes nothing")
    options = parser.parse_args()
    unknown = sorted(set(options.subjects) - set(SUBJECTS))
    if unknown:
        parser.error(f"there is no subject {', '.join(unknown)}, only {', '.join(SUBJECTS)}")
    sections = [f"# Benchmarks\n\n{description()}\n"]
    for subject in options.subjects or SUBJECTS:
        for table in import_module(subject).tables(options.quick):
            print(table.markdown(), flush=True)
            sections.append(table.markdown())
    if not (options.quick or options.subjects):
        write_text(RESULTS, "\n".join(sections))


if __name__ == "__main__":
    main()
