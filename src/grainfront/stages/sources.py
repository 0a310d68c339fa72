"""What of the package the results of each stage depend on: an edit of it asks for a new run."""

from __future__ import annotations

import hashlib
from pathlib import Path

_PACKAGE = Path(__file__).parents[1]
_ALWAYS = (
    "__init__", "api", "arrangement.polygons_file", "arrangement.regions", "arrangement.resolve",
    "arrangement.silhouette", "arrangement.zones", "checked_yaml", "errors", "image_files",
    "from_scene.limits", "from_scene.packing", "from_scene.statistics", "particles", "polygons",
    "scene", "stages",
)  # fmt: skip
_FILES = (
    "files.atomic", "files.contract", "files.dataset", "files.header", "files.netcdf", "files.seal",
)  # fmt: skip
_DATABASE = ("shapes.database", "shapes.descriptors")
_REGIONS = ("arrangement", "from_scene.regions")
_LAWS = ("laws", "shapes.sources", *_ALWAYS)
SOURCES = {
    "shapes": ("draw", "shapes", "laws", *_FILES, *_ALWAYS),
    "packing": (
        "draw", "geometry", "jit", "packing", *_REGIONS, *_DATABASE, *_FILES, *_LAWS,
    ),
    "packing_to_target": (
        "draw", "geometry", "jit", "packing", "files.contour", "files.target", *_REGIONS,
        *_DATABASE, *_FILES, *_LAWS,
    ),
    "replacement": ("geometry", "jit", "replacement", *_DATABASE, *_FILES, *_LAWS),
    "contacts": ("geometry", "jit", "statistics", *_FILES, *_LAWS),
    "statistics": (
        "certificate", "geometry", "jit", "statistics", "files.statistics",
        "files.statistics_contract", *_REGIONS, *_DATABASE, *_FILES, *_LAWS,
    ),
    "sweep": (
        "draw", "geometry", "jit", "packing", "statistics", "studies.sweep", "files.contour",
        *_REGIONS, *_DATABASE, *_FILES, *_LAWS,
    ),
    "contour_picture": ("figures", "files.contour", *_FILES, *_LAWS),
    "error_vs_time": (
        "certificate", "draw", "geometry", "jit", "packing", "replacement", "shapes", "statistics",
        "studies", "files.error_vs_time", *_REGIONS, *_FILES, *_LAWS,
    ),
    "error_vs_time_picture": ("figures", "files.error_vs_time", *_FILES, *_LAWS),
    "stability": (
        "certificate", "draw", "geometry", "jit", "packing", "shapes", "statistics",
        "studies.stability", "files.stability", *_REGIONS, *_FILES, *_LAWS,
    ),
    "stability_report": ("figures", "files.stability", "files.stability_table", *_FILES, *_LAWS),
    "arrangement_picture": ("figures", "geometry", "jit", "files.atomic", *_REGIONS, *_LAWS),
    "vtk": ("files.vtk", *_FILES, *_LAWS),
    "figures": (
        "certificate", "figures", "geometry", "jit", "shapes", "statistics",
        "files.statistics", "files.statistics_contract", *_FILES, *_LAWS,
    ),
}  # fmt: skip
"""What of the package each stage's results depend on: modules, and packages with all of theirs."""


def sources_digest(stage: str) -> str:
    """Hexadecimal digest of the sources that a stage uses: an edit of them asks for a new run."""
    digest = hashlib.sha256()
    for module in SOURCES[stage]:
        path = _PACKAGE.joinpath(*module.split("."))
        for file in sorted(path.rglob("*.py")) if path.is_dir() else [path.with_suffix(".py")]:
            digest.update(file.relative_to(_PACKAGE).as_posix().encode())
            digest.update(file.read_bytes())
    return digest.hexdigest()[:16]
