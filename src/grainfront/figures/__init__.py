"""Every picture: each function takes what is to be seen and gives a matplotlib Figure.

Nothing is computed here but positions on the paper; numbers come from `statistics`.
"""

from grainfront.figures.contacts import contacts
from grainfront.figures.contour import contour
from grainfront.figures.error_vs_time import error_vs_time
from grainfront.figures.laws import laws
from grainfront.figures.packing import packing
from grainfront.figures.photograph import photograph
from grainfront.figures.rose import rose
from grainfront.figures.signed_distance import signed_distance
from grainfront.figures.stability import clearance, stability
from grainfront.figures.style import save_png

__all__ = [
    "clearance",
    "contacts",
    "contour",
    "error_vs_time",
    "laws",
    "packing",
    "photograph",
    "rose",
    "save_png",
    "signed_distance",
    "stability",
]
