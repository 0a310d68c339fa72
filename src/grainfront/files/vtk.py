"""Packings as VTK polygon data (.vtp), which ParaView opens."""

from __future__ import annotations

import os

import numpy as np
import pyvista
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

from grainfront.errors import InputError
from grainfront.files.atomic import replacing
from grainfront.particles import Packing

CELL_FIELDS = ("size", "aspect_ratio", "orientation", "area", "circumradius", "shape")


def write_vtp(path: str | os.PathLike[str], packing: Packing) -> None:
    """Write one cell a particle, in the plane z = 0, with the data of the particles on the cells.

    The nodes keep all their bits; equal packings give equal bytes. Cell data: size, aspect_ratio,
    orientation (degree), area, circumradius, shape, particle (the order of placement) and, where
    there are regions, region. Errors: InputError where the name does not end in .vtp or the folder
    cannot be written to.
    """
    if not os.fspath(path).endswith(".vtp"):
        raise InputError(f"{path}: VTK polygon data need a name that ends in .vtp")
    polygons = packing.polygons
    points = np.column_stack([polygons.nodes, np.zeros(len(polygons.nodes))])
    # VTK wants each polygon as its node count followed by the indices of its nodes.
    faces = np.insert(np.arange(len(points)), polygons.offsets[:-1], polygons.node_counts)
    mesh = pyvista.PolyData(points, faces=faces)
    mesh.cell_data["particle"] = np.arange(polygons.count)
    for name in CELL_FIELDS:
        mesh.cell_data[name] = getattr(packing, name)
    if packing.region is not None:
        mesh.cell_data["region"] = packing.region
    mesh.set_active_scalars("size")
    # VTK writes to memory alone: on a full disk it would end the process
    writer = vtkXMLPolyDataWriter()
    writer.SetInputData(mesh)
    writer.WriteToOutputStringOn()
    if not writer.Write():
        raise OSError(f"{path}: VTK cannot write these polygons")
    with replacing(path) as temporary:
        temporary.write_text(writer.GetOutputString(), encoding="ascii")
