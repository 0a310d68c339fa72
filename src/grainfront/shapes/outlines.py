"""Pixels to outlines: closed sub-pixel curves free of the staircase, then of needless nodes.

The 0.5-level contour of a binary mask runs through the midpoints between inner and outer pixels.
Its nodes scatter about the true outline by a known amount and its length exceeds the true one by
5.5 % at every resolution. We take the smoothest closed curve that stays as close to those nodes as
the scatter allows (the discrepancy principle of Morozov 1966), in elliptic Fourier series (Kuhl &
Giardina 1982) about the grain's ellipse of inertia, so that an ellipse needs no smoothing at all.
"""

from __future__ import annotations

import numpy as np
import shapely
from scipy import ndimage
from skimage import measure

from grainfront.polygons import Polygons
from grainfront.shapes.descriptors import feret

# Root mean square of the distance, in pixels, of the contour from the true outline: along a grid
# line the crossing is uniform within ±1/2 (variance 1/12), and the mean of the squared cosine to
# the outline's normal is about 3/4, which gives 0.25. A curve fitted to the same contour comes
# closer to it than the true one; 0.21 gave the least bias on ellipses of 15 to 160 pixels.
RESIDUAL = 0.21
# No midpoint is farther than half a pixel from the true outline; a tenth more allows for the fit.
# It keeps corners, which a root mean square over the whole outline hardly sees.
LARGEST_RESIDUAL = 0.6
# Neighbouring midpoints err alike. On rasterised discs of 15 to 80 pixels the elongation found is
# that of independent errors of variance 1/16 square pixel, one every 2.7 pixels of outline.
ELONGATION_VARIANCE = 2.7 / 16.0
# The length, in pixels, below which waves of the contour are staircase when nodes are first spaced.
STAIRCASE_LENGTH = 7.0
# Steepness of the low-pass filter, as of a spline penalised in its fourth derivative.
FILTER_ORDER = 8
# The contour cuts 1/8 square pixel off every salient corner of the pixels' boundary, adds as much
# at every reentrant one, and a closed boundary has four more of the former.
CORNER_AREA = 4.0 / 8.0
# How many standard deviations of the scatter count as no elongation at all. Fewer find rasterised
# discs elongated by more than 0.5 %, more find aspect ratios of 1.1 too small by as much.
ELONGATION_DEVIATIONS = 2.5
# Largest distance from the smooth curve, relative to its size, at which a node is needless: a disc
# keeps 32 nodes, an ellipse of aspect ratio 3 keeps 44.
SIMPLIFICATION = 0.004


def smooth_outline(mask: np.ndarray) -> np.ndarray:
    """Outline of the one grain in a boolean mask, free of the staircase.

    `mask` must hold one region connected through pixel edges; its holes are ignored. Returns nodes
    (x = column, y = row, in pixels) of shape (n, 2), dense, counter-clockwise in (x, y), enclosing
    the area of the region. The curve may cross itself where the region is thinner than 2 pixels.
    """
    contour = raw_contour(mask)
    length = np.abs(np.diff(contour, append=contour[0])).sum()
    n_nodes = 1 << int(np.ceil(np.log2(max(2.0 * length, 128.0))))
    whiten, unwhiten = _inertia_frame(contour)
    nodes = _resample(contour, _arclength(contour), n_nodes)
    smoothed = _low_pass(nodes, length / STAIRCASE_LENGTH, kept=0)
    # The arclength of the rough curve in the frame in which the grain's ellipse is a circle makes
    # an ellipse a single harmonic.
    nodes = _resample(nodes, _arclength(_map(whiten, smoothed)), n_nodes)
    curve = _smoothest(_map(whiten, nodes), nodes, unwhiten)
    curve = _without_noise_elongation(curve, length)
    return _points(_with_area(curve, _area(contour) + CORNER_AREA))


def raw_contour(mask: np.ndarray) -> np.ndarray:
    """The outer 0.5-level contour of a boolean mask, as x + iy, counter-clockwise, not closed."""
    contours = measure.find_contours(np.pad(mask, 1).astype(np.float64), 0.5)
    points = max(contours, key=len)[:-1] - 1.0
    contour = points[:, 1] + 1j * points[:, 0]
    return contour if _area(contour) > 0.0 else contour[::-1]


def simplify(nodes: np.ndarray, tolerance: float = SIMPLIFICATION) -> np.ndarray:
    """Drop the nodes (Douglas & Peucker 1973) that stray less than `tolerance` × minimum width.

    The remaining polygon is scaled about its centroid to the area it had. Shapes (n, 2) → (m, 2).
    """
    polygon = shapely.Polygon(nodes)
    # A width good to a percent is enough here, and 128 nodes give it.
    sparse = shapely.MultiPoint(nodes[:: max(1, len(nodes) // 128)])
    width = feret(shapely.get_coordinates(sparse.convex_hull)[:0:-1]).size
    reduced = shapely.simplify(polygon, tolerance * width)
    corners = shapely.get_coordinates(reduced)[:-1]
    centre = shapely.get_coordinates(reduced.centroid)[0]
    return centre + (corners - centre) * np.sqrt(polygon.area / reduced.area)


def trace_labels(
    labels: np.ndarray, min_perimeter: float, min_solidity: float
) -> tuple[Polygons, dict[str, int]]:
    """Outlines of every grain of a label mask (0 = background), each label by itself.

    Of a label in several pieces the largest counts as the grain. Returns the outlines of the grains
    kept, in pixels (x = column, y = row), in the order of their labels, and the counts: `found`,
    `kept`, `hole` (kept, its holes filled) and the dropped: `border` (touches the image's border),
    `speck` (perimeter below `min_perimeter` pixels), `clump` (area below `min_solidity` × that of
    the hull), `self_crossing` (no simple outline: too thin for its pixels).
    """
    reasons = ("found", "kept", "border", "speck", "clump", "self_crossing", "hole")
    counts = dict.fromkeys(reasons, 0)
    outlines = []
    for label, box in enumerate(ndimage.find_objects(labels), start=1):
        if box is None:
            continue
        counts["found"] += 1
        if any(s.start == 0 or s.stop == n for s, n in zip(box, labels.shape, strict=True)):
            counts["border"] += 1
            continue
        piece = _largest_piece(labels[box] == label)
        # No outline is longer than its staircase: this spares the work of smoothing specks.
        if _perimeter(raw_contour(piece)) < min_perimeter:
            counts["speck"] += 1
            continue
        outline = smooth_outline(piece)
        verdict = _verdict(outline, min_perimeter, min_solidity)
        counts[verdict] += 1
        if verdict == "kept":
            counts["hole"] += int(ndimage.binary_fill_holes(piece).sum() > piece.sum())
            corner = np.array([box[1].start, box[0].start])
            outlines.append(simplify(outline) + corner)
    return Polygons.of(outlines), counts


def _verdict(outline: np.ndarray, min_perimeter: float, min_solidity: float) -> str:
    polygon = shapely.Polygon(outline)
    if not (polygon.is_valid and shapely.Polygon(simplify(outline)).is_valid):
        return "self_crossing"
    if polygon.length < min_perimeter:
        return "speck"
    if polygon.area < min_solidity * polygon.convex_hull.area:
        return "clump"
    return "kept"


def _largest_piece(mask: np.ndarray) -> np.ndarray:
    pieces, count = ndimage.label(mask)
    if count == 1:
        return mask
    return pieces == 1 + np.argmax(np.bincount(pieces.ravel())[1:])


def _smoothest(white: np.ndarray, nodes: np.ndarray, unwhiten: np.ndarray) -> np.ndarray:
    """The smoothest curve as close to `nodes` as RESIDUAL (rms) and LARGEST_RESIDUAL ask.

    `white` are the nodes in the frame of inertia, where they are filtered; distances are measured
    along the normals of the curve.
    """

    def fit(cutoff: float) -> tuple[np.ndarray, bool]:
        curve = _map(unwhiten, _low_pass(white, cutoff, kept=1))
        distance = np.abs(((nodes - curve) * np.conj(_normals(curve))).real)
        close = np.mean(distance**2) <= RESIDUAL**2 and distance.max() <= LARGEST_RESIDUAL
        return curve, bool(close)

    # From nothing but the ellipse up to every harmonic; 12 halvings of the logarithm are 0.2 %.
    low, high = 0.25, len(nodes) / 4.0
    curve, close = fit(low)
    if close:
        return curve
    for _ in range(12):
        middle = np.sqrt(low * high)
        low, high = (low, middle) if fit(middle)[1] else (middle, high)
    return fit(high)[0]


def _without_noise_elongation(curve: np.ndarray, length: float) -> np.ndarray:
    """Take the scatter of the pixels out of the elongation, lest every disc be found elongated.

    A disc's elongation is never negative, so its mean is biased by the scatter; we subtract the
    square of ELONGATION_DEVIATIONS from the squared amplitude of the harmonic that elongates. At 15
    pixels this finds aspect ratios of 1.02 to 1.05 up to 1 % too small, which no estimate escapes
    that is right for discs.
    """
    harmonics = np.fft.fft(curve)
    amplitude = np.abs(harmonics[-1]) / len(curve)
    noise = ELONGATION_DEVIATIONS**2 * ELONGATION_VARIANCE / (2.0 * length)
    if amplitude > 0.0:
        harmonics[-1] *= np.sqrt(max(0.0, 1.0 - noise / amplitude**2))
    return np.fft.ifft(harmonics)


def _low_pass(curve: np.ndarray, cutoff: float, kept: int) -> np.ndarray:
    """Damp the harmonics beyond `cutoff`; those up to `kept` stay as they are."""
    n = len(curve)
    harmonic = np.maximum(np.abs(np.fft.fftfreq(n, 1.0 / n)) - kept, 0.0)
    return np.fft.ifft(np.fft.fft(curve) / (1.0 + (harmonic / cutoff) ** FILTER_ORDER))


def _inertia_frame(contour: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The symmetric map, of determinant 1, of the ellipse of inertia to a circle; its inverse."""
    z, z_next = contour, np.roll(contour, -1)
    cross = (np.conj(z) * z_next).imag
    centre = ((z + z_next) * cross).sum() / (3.0 * cross.sum())
    z, z_next = z - centre, z_next - centre
    cross = (np.conj(z) * z_next).imag
    x, y, u, v = z.real, z.imag, z_next.real, z_next.imag
    xx, yy = (cross * (x * x + x * u + u * u)).sum(), (cross * (y * y + y * v + v * v)).sum()
    xy = (cross * (2 * x * y + x * v + u * y + 2 * u * v)).sum() / 2.0
    moments, axes = np.linalg.eigh([[xx, xy], [xy, yy]])
    stretch = (moments / np.sqrt(moments.prod())) ** 0.5
    return (axes / stretch) @ axes.T, (axes * stretch) @ axes.T


def _with_area(curve: np.ndarray, area: float) -> np.ndarray:
    """Move every node along its normal by the same distance, to first order in it, to this area."""
    return curve + _normals(curve) * (area - _area(curve)) / _perimeter(curve)


def _map(matrix: np.ndarray, z: np.ndarray) -> np.ndarray:
    x, y = matrix @ [z.real, z.imag]
    return x + 1j * y


def _normals(curve: np.ndarray) -> np.ndarray:
    """Outward unit normals of a counter-clockwise curve at its nodes."""
    tangent = np.roll(curve, -1) - np.roll(curve, 1)
    return -1j * tangent / np.abs(tangent)


def _arclength(curve: np.ndarray) -> np.ndarray:
    """Arclength at every node and, last, of the closed curve: shape (n + 1,)."""
    return np.concatenate([[0.0], np.cumsum(np.abs(np.diff(curve, append=curve[0])))])


def _resample(curve: np.ndarray, position: np.ndarray, n_nodes: int) -> np.ndarray:
    """Nodes equally spaced in `position`, which is given at every node and at the closing one."""
    equal = np.arange(n_nodes) * (position[-1] / n_nodes)
    return np.interp(equal, position, np.append(curve, curve[0]))


def _area(curve: np.ndarray) -> float:
    return 0.5 * float((np.conj(curve) * np.roll(curve, -1)).imag.sum())


def _perimeter(curve: np.ndarray) -> float:
    return float(np.abs(np.diff(curve, append=curve[0])).sum())


def _points(curve: np.ndarray) -> np.ndarray:
    return np.column_stack([curve.real, curve.imag])
