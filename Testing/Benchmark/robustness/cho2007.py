# SPDX-License-Identifier: BSD-3-Clause
"""The baseline: J.-W. Cho, R. Prost and H.-Y. Jung, "An oblivious watermarking for 3-D polygonal meshes
using distribution of vertex norms", IEEE Transactions on Signal Processing 55(1), 2007; the variant
that changes means.

Equal bins divide the range of the vertices' distances from their centre, one bin for each bit. The
distances within a bin are mapped to [0, 1], where their mean is about a half, and raised to a power that
brings the mean to a half plus the strength for a 1, and to a half minus the strength for a 0. Reading
compares the means with a half.
"""

from __future__ import annotations

import numpy as np

STRENGTH = 0.05  # alpha of the publication
MOST_BISECTIONS = 60


def _norms(points: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    centre = points.mean(axis=0)
    offsets = points - centre
    return centre, offsets, np.linalg.norm(offsets, axis=1)


def _bins(norms: np.ndarray, count: int) -> tuple[np.ndarray, np.ndarray, float]:
    """The bin of each norm, its place within it, and the bins' width."""
    width = (norms.max() - norms.min()) / count
    places = (norms - norms.min()) / width
    bins = np.minimum(places.astype(int), count - 1)
    return bins, places - bins, width


def _exponent(places: np.ndarray, target: float) -> float:
    """k with mean(places^k) = target; the mean falls as k grows."""
    low, high = 1e-3, 1e3
    for _ in range(MOST_BISECTIONS):
        middle = np.sqrt(low * high)
        low, high = (middle, high) if np.mean(places**middle) > target else (low, middle)
    return np.sqrt(low * high)


def embed(points: np.ndarray, bits: str, strength: float = STRENGTH) -> np.ndarray:
    centre, offsets, norms = _norms(points)
    bins, places, width = _bins(norms, len(bits))
    changed = norms.copy()
    for number, bit in enumerate(bits):
        inside = np.flatnonzero(bins == number)
        # The smallest and the largest distance stay: they define the bins for the reader.
        inside = inside[(norms[inside] > norms.min()) & (norms[inside] < norms.max())]
        if len(inside) == 0:
            continue
        sign = 1.0 if bit == "1" else -1.0
        if sign * (places[inside].mean() - 0.5) >= strength:
            continue
        power = _exponent(places[inside], 0.5 + sign * strength)
        changed[inside] = norms.min() + width * (number + places[inside] ** power)
    scale = np.divide(changed, norms, out=np.ones_like(norms), where=norms > 0.0)
    return centre + offsets * scale[:, None]


def extract(points: np.ndarray, count: int) -> str:
    _, _, norms = _norms(points)
    bins, places, _ = _bins(norms, count)
    sums = np.bincount(bins, weights=places, minlength=count)
    sizes = np.bincount(bins, minlength=count)
    return "".join("1" if total > 0.5 * size else "0" for total, size in zip(sums, sizes))
