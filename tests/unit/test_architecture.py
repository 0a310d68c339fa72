"""The dependency law: which part may import which, and where heavy libraries are allowed.

The imports are parsed, so a breach is found wherever it stands, inside a function too.
"""

from __future__ import annotations

import ast
import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import pytest

from grainfront.jit import KERNEL_SOURCES

ROOT = Path(__file__).parents[2]
SOURCES = ROOT / "src" / "grainfront"
MODULES = sorted(SOURCES.rglob("*.py"))

DATA = ("errors", "polygons", "particles")  # plain data types
STAGE = ("geometry", "jit", *DATA)

# Each part may import itself and these, with their submodules.
MAY_IMPORT = {
    "errors": (),
    "jit": (),
    "polygons": (),
    "particles": ("errors", "polygons"),
    "checked_yaml": ("errors",),
    "image_files": ("errors",),
    "geometry": ("jit",),
    "packing": STAGE,
    "shapes": (*STAGE, "image_files"),
    "statistics": STAGE,
    "replacement": STAGE,
    "certificate": STAGE,
    "laws": STAGE,
    "arrangement": (*STAGE, "laws", "image_files"),
    "draw": (*STAGE, "laws"),
    "scene": (
        "arrangement.regions",
        "arrangement.zones",
        "arrangement.resolve",
        "arrangement.polygons_file",
        "laws",
        "shapes.sources",
        "checked_yaml",
        "image_files",
        "particles",
        "errors",
    ),
    "files": DATA,
    "figures": (*DATA, "files.atomic"),
}
# Of these they may import types alone.
MAY_IMPORT_TYPES = {"files": ("shapes.database", "statistics", "certificate")}
# And of these only for the type checker, under `if TYPE_CHECKING`.
MAY_NAME_TYPES = {"figures": ("shapes.database", "statistics", "certificate")}
# They tie the stages together, and nothing else may import them.
TIES = {
    "__init__",
    "api",
    "cli",
    "stages",
    "studies",
    "warm_up",
    "from_scene",
}

LIBRARIES = {
    "numpy": ("",),
    "numba": ("jit", "geometry", "packing"),
    "scipy": ("shapes", "laws", "arrangement.silhouette", "studies.error_vs_time"),
    "shapely": (
        "polygons",
        "particles",
        "geometry.boxes",
        "geometry.pieces",
        "geometry.rooms",
        "packing.region",
        "packing.rooms",
        "packing.periodic",
        "shapes",
        "statistics",
        "arrangement",
        "files.netcdf",
        "figures.walls",
        "scene.domain",
        "studies.error_vs_time",
        "studies.stability",
    ),
    "skimage": ("image_files", "shapes.images", "shapes.outlines", "arrangement.silhouette"),
    "PIL": ("image_files",),
    "imageio": ("image_files",),
    "tifffile": ("image_files",),
    "netCDF4": ("files",),
    "xarray": ("files",),
    "pyvista": ("files.vtk",),
    "vtkmodules": ("files.vtk",),
    "matplotlib": ("figures",),
    "jsonschema": ("checked_yaml", "files.dataset"),
    "yaml": ("checked_yaml",),
    "tqdm": ("api", "cli"),
}


class Import(NamedTuple):
    """One imported name: of which module, and whether for the type checker alone."""

    module: str
    name: str | None
    type_checking: bool
    line: int


def module_name(path: Path) -> str:
    """Dotted name below `grainfront`; a package goes by its own name."""
    parts = path.relative_to(SOURCES).with_suffix("").parts
    return ".".join(parts[:-1] if len(parts) > 1 and parts[-1] == "__init__" else parts)


def imports_of(path: Path) -> Iterator[Import]:
    """All imports of a source file."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    for_types = {
        id(inner)
        for node in ast.walk(tree)
        if isinstance(node, ast.If) and ast.unparse(node.test).endswith("TYPE_CHECKING")
        for statement in node.body
        for inner in ast.walk(statement)
    }
    for node in ast.walk(tree):
        hidden = id(node) in for_types
        if isinstance(node, ast.Import):
            for alias in node.names:
                yield Import(alias.name, None, hidden, node.lineno)
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{path}:{node.lineno} imports relatively"
            for alias in node.names:
                yield _resolved(node.module or "", alias.name, hidden, node.lineno)


def _resolved(module: str, name: str, hidden: bool, line: int) -> Import:
    """`from package import module` is an import of that module."""
    folder = SOURCES.parent.joinpath(*module.split("."))
    if (folder / f"{name}.py").exists() or (folder / name / "__init__.py").exists():
        return Import(f"{module}.{name}", None, hidden, line)
    return Import(module, name, hidden, line)


def within(module: str, allowed: tuple[str, ...]) -> bool:
    """Whether a module is one of those allowed or lies below one."""
    return any(module == part or not part or module.startswith(f"{part}.") for part in allowed)


def lawful(part: str, imported: Import) -> bool:
    """Whether a part may import this of the package."""
    module = imported.module.removeprefix("grainfront").removeprefix(".")
    if within(module, (part, *MAY_IMPORT[part])):
        return True
    is_type = imported.name is not None and imported.name[0].isupper()
    if is_type and within(module, MAY_IMPORT_TYPES.get(part, ())):
        return True
    return imported.type_checking and is_type and within(module, MAY_NAME_TYPES.get(part, ()))


def breaches(path: Path) -> list[str]:
    """What a source file imports of the package against the law."""
    part = module_name(path).split(".")[0]
    if part in TIES:
        return []
    return [
        f"{path.relative_to(ROOT)}:{found.line} imports {found.module}"
        for found in imports_of(path)
        if found.module.split(".")[0] == "grainfront" and not lawful(part, found)
    ]


def test_every_part_has_its_law():
    parts = {module_name(path).split(".")[0] for path in MODULES}
    assert parts - TIES == set(MAY_IMPORT)


def test_the_dependency_law_holds():
    assert [breach for path in MODULES for breach in breaches(path)] == []


@pytest.mark.parametrize(
    ("module", "statement"),
    [
        ("geometry.contact", "from grainfront.polygons import Polygons"),
        ("packing.pack", "from grainfront.laws import Law"),
        ("packing.pack", "def pack():\n    import grainfront.scene"),
        ("shapes.database", "from grainfront import files"),
        ("scene", "from grainfront.shapes import database"),
        ("files.statistics", "from grainfront.statistics import measure"),
        ("figures.laws", "from grainfront.statistics import Distribution"),
    ],
)
def test_a_breach_is_found(module, statement, tmp_path, monkeypatch):
    path = tmp_path / "src" / "grainfront" / Path(*module.split(".")).with_suffix(".py")
    for name in ("laws", "scene", "files", "statistics", "shapes/database"):
        stub = tmp_path / "src" / "grainfront" / name
        stub.parent.mkdir(parents=True, exist_ok=True)
        stub.with_suffix(".py").touch()
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(statement)
    monkeypatch.setattr(sys.modules[__name__], "ROOT", tmp_path)
    monkeypatch.setattr(sys.modules[__name__], "SOURCES", tmp_path / "src" / "grainfront")
    assert len(breaches(path)) == 1


def test_libraries_are_imported_only_where_they_are_used():
    misplaced = []
    for path in MODULES:
        for found in imports_of(path):
            library = found.module.split(".")[0]
            if library == "grainfront" or library in sys.stdlib_module_names:
                continue
            if not within(module_name(path), LIBRARIES.get(library, ())):
                misplaced.append(f"{path.relative_to(ROOT)}:{found.line} imports {library}")
    assert misplaced == []


def test_packing_needs_numpy_and_numba_alone():
    code = (
        "import sys, numpy, numba\n"
        "before = set(sys.modules)\n"  # numba itself imports some of the others
        "import grainfront.packing.pack\n"
        f"print(set({sorted(LIBRARIES)}) & (set(sys.modules) - before))"
    )
    found = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert found.stdout.strip() == "set()"


def test_the_kernel_cache_watches_every_kernel():
    watched = tuple(source.removesuffix(".py") for source in KERNEL_SOURCES)
    unwatched = [
        module_name(path)
        for path in MODULES
        if {found.name for found in imports_of(path)} & {"kernel", "inlined", "njit"}
        and not within(module_name(path), watched)
    ]
    assert unwatched == []


def test_workflow_scripts_only_call_the_package():
    foreign = [
        f"{path.relative_to(ROOT)}:{found.line} imports {found.module}"
        for path in (ROOT / "workflow").rglob("*.py")
        for found in imports_of(path)
        if found.module.split(".")[0] not in {"grainfront", "snakemake", *sys.stdlib_module_names}
    ]
    assert foreign == []


# Words that tie a checkout to a package registry or to one machine, or that readers cannot follow.
ELSEWHERE = {
    "a package registry": re.compile(
        r"pypi\.(org|python)|pythonhosted\.|anaconda\.(org|com)|(--extra)?-index-url|artifactory"
    ),
    "a folder of one machine": re.compile(r"(?<![\w.}$/])/(work|root|home|Users|tmp|mnt)/\w"),
    "a document that is not here": re.compile(r"\bDESIGN(\.md|\s+(section\s+)?\d)"),
}


def committed_files() -> list[Path]:
    """All text files under version control."""
    listed = subprocess.run(
        ["git", "ls-files", "-z"], cwd=ROOT, capture_output=True, text=True, check=False
    )
    if listed.returncode:
        pytest.skip("not a git checkout: the files under version control are unknown")
    paths = [ROOT / name for name in listed.stdout.split("\0") if name]
    return [path for path in paths if path.is_file() and path.suffix != ".png"]


@pytest.mark.parametrize("what", ELSEWHERE)
def test_no_file_names(what):
    named = [
        f"{path.relative_to(ROOT)}:{number}: {line.strip()}"
        for path in committed_files()
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), start=1)
        if ELSEWHERE[what].search(line) and path != Path(__file__)
    ]
    assert named == []
