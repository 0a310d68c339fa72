"""JSON Schema and CDL header of every result dataset, made from their contracts.

``python -m grainfront.files.schema FOLDER`` says which files in the folder have drifted from the
contracts; with ``--fix`` it writes them.
"""

from __future__ import annotations

import argparse
import json
from pathlib import Path

from grainfront.files.atomic import write_text
from grainfront.files.contour import CONTOUR, CONTOUR_TIMING
from grainfront.files.contract import CONTACTS, PACKING, SHAPES
from grainfront.files.error_vs_time import ERROR_VS_TIME
from grainfront.files.header import cdl, json_schema
from grainfront.files.stability import STABILITY
from grainfront.files.statistics_contract import STATISTICS
from grainfront.files.target import TARGET

CONTRACTS = (
    SHAPES, PACKING, CONTACTS, STATISTICS, CONTOUR, CONTOUR_TIMING, ERROR_VS_TIME, STABILITY,
    TARGET,
)  # fmt: skip
"""Those of all result datasets."""


def documents() -> dict[str, str]:
    """File name and text of every schema and every CDL header."""
    texts = {}
    for contract in CONTRACTS:
        schema = json.dumps(json_schema(contract), indent=2, ensure_ascii=False)
        texts[f"{contract.name}.schema.json"] = f"{schema}\n"
        texts[f"{contract.name}.cdl"] = cdl(contract)
    return texts


def drifted(folder: Path) -> list[str]:
    """Names of the documents that `folder` lacks or holds with another text."""
    return [
        name
        for name, text in documents().items()
        if not (folder / name).is_file() or (folder / name).read_text(encoding="utf-8") != text
    ]


def main() -> int:
    """Compare (or with --fix, write) the documents; 1 if they had drifted and were not fixed."""
    parser = argparse.ArgumentParser(description=documents.__doc__)
    parser.add_argument("folder", type=Path, help="where the schemas are kept")
    parser.add_argument("--fix", action="store_true", help="write what has drifted")
    arguments = parser.parse_args()
    names = drifted(arguments.folder)
    for name in names:
        print(f"{name}: {'written' if arguments.fix else 'differs from the contract'}")
        if arguments.fix:
            write_text(arguments.folder / name, documents()[name])
    return int(bool(names) and not arguments.fix)


if __name__ == "__main__":
    raise SystemExit(main())
