# SPDX-License-Identifier: BSD-3-Clause
"""Tests the detector's p-values on unmarked meshes with thousands of messages and keys."""

from __future__ import annotations

import math
import zlib

import numpy as np
from spectralwatermark import vtkSpectralWatermarkDetect
from spectralwatermark.io import read_mesh
from spectralwatermark.execution import update
from vtkmodules.vtkCommonDataModel import vtkPolyData

from .detection import (
    DEFAULT_POSITION,
    POSITIONS,
    Cases,
    PValues,
    p_values,
    read_windows,
)
from .experiments import SEED
from .keys import key_streams, secret
from .models import Model
from .spectra import SLOT_SIZE, magnitudes_of, with_enough_harmonics

HARMONICS = 300
LENGTHS = (5, 15, 25)
ALPHAS = (0.1, 0.05, 0.03, 0.01, 0.001)
DIVISIONS = ("Normal", "Narrow")
RANDOM = "random message, no key"
KEYED = "secret key, any message"
DERIVED = "secret key, its own message"
FIXED_PATTERNS = ("0", "1", "10110", "10")
VERIFIED_KEYS = 2


def fixed_messages(length: int) -> list[str]:
    """Messages that somebody might choose by hand: all zeros, all ones, and patterns."""
    patterns = FIXED_PATTERNS[:3] if length == 5 else FIXED_PATTERNS
    return [(pattern * length)[:length] for pattern in patterns]


def calibrate(model: Model, random_messages: int, keys: int, stride: int) -> list[dict]:
    """One model's spectrum, and how often each kind of expected message agrees with it by chance.

    Fixed messages are tried at every carrier position and at places in the spectrum that are
    `stride` components apart.
    """
    read = read_mesh(model.path)
    mesh, first = with_enough_harmonics(read, min(HARMONICS, read.GetNumberOfPoints() // 2))
    magnitudes = magnitudes_of(mesh)
    rates = []
    for division in range(len(DIVISIONS)):
        readings = read_windows(magnitudes, division)
        for length in LENGTHS:
            if first - 1 + length * SLOT_SIZE > len(magnitudes):
                continue
            rng = np.random.default_rng([SEED, zlib.crc32(model.name.encode()), length])
            sets = [
                (RANDOM, "", random_cases(rng, first, length, random_messages)),
                (KEYED, "", keyed_cases(first, length, keys, rng)),
                (DERIVED, "", keyed_cases(first, length, keys, None)),
            ]
            sets += [("fixed message, no key", message,
                      fixed_cases(message, first, len(readings.one), stride))
                     for message in fixed_messages(length)]
            for kind, message, cases in sets:
                rates.append({"division": division, "length": length, "kind": kind,
                              "message": message, "keyed": cases.keyed}
                             | hits(p_values(readings, cases)))
    compared, difference = verify(mesh, magnitudes, first)
    return [{"first": first, "vertices": model.vertices, "magnitudes": magnitudes.tolist(),
             "rates": rates, "compared": compared, "difference": difference}]


def hits(values: PValues) -> dict:
    """The number of p-values at or below each threshold."""
    return {"cases": len(values.hard)} | {
        detector: [int((getattr(values, detector) <= alpha).sum()) for alpha in ALPHAS]
        for detector in ("hard", "soft", "naive")}


def slots_from(first: int, length: int) -> np.ndarray:
    """Rows of Readings for the slots of a message."""
    return first - 1 + SLOT_SIZE * np.arange(length)


def random_cases(rng: np.random.Generator, first: int, length: int, count: int) -> Cases:
    shape = (count, length)
    return Cases(
        np.broadcast_to(slots_from(first, length), shape),
        np.full(shape, DEFAULT_POSITION),
        np.zeros(shape, dtype=bool),
        rng.integers(0, 2, shape),
        keyed=False)


def keyed_cases(first: int, length: int, count: int, rng: np.random.Generator | None) -> Cases:
    """Every key with a random message or, without a generator, with its derived message."""
    streams = key_streams(count)
    shape = (count, length)
    return Cases(
        np.broadcast_to(slots_from(first, length), shape),
        streams.columns[:, :length],
        streams.inverted[:, :length],
        streams.derived[:, :length] if rng is None else rng.integers(0, 2, shape),
        keyed=True)


def fixed_cases(message: str, first: int, windows: int, stride: int) -> Cases:
    length = len(message)
    starts = np.arange(first, windows + 1 - SLOT_SIZE * (length - 1) + 1, stride)
    starts = starts[starts - 1 + SLOT_SIZE * (length - 1) < windows]
    columns = np.repeat(np.arange(len(POSITIONS)), len(starts))
    rows = np.tile(starts, len(POSITIONS))[:, None] - 1 + SLOT_SIZE * np.arange(length)
    shape = rows.shape
    return Cases(
        rows,
        np.broadcast_to(columns[:, None], shape),
        np.zeros(shape, dtype=bool),
        np.broadcast_to([int(bit) for bit in message], shape),
        keyed=False)


# --- Against the filter ------------------------------------------------------------------------


def verify(mesh: vtkPolyData, magnitudes: np.ndarray, first: int) -> tuple[int, float]:
    """Compares the filter with numpy on some cases.

    Returns the count of p-values and likelihood ratios compared, and the largest difference.
    """
    length = min(15, (len(magnitudes) - first + 1) // SLOT_SIZE)
    rng = np.random.default_rng(SEED)
    compared, difference = 0, 0.0
    for division in range(len(DIVISIONS)):
        readings = read_windows(magnitudes, division)
        keyed = keyed_cases(first, length, VERIFIED_KEYS, rng)
        for cases in (random_cases(rng, first, length, 1), keyed):
            values = p_values(readings, cases)
            for case in range(len(cases.expected)):
                key = secret(case) if cases.keyed else ""
                expected = "".join(str(bit) for bit in cases.expected[case])
                filtered = filter_says(mesh, first, division, key, expected)
                ours = (values.hard[case], values.soft[case], values.ratio[case])
                compared += len(ours)
                difference = max(difference, *(abs(a - b) for a, b in zip(filtered, ours)))
    return compared, float(difference)


def filter_says(
    mesh: vtkPolyData, first: int, division: int, key: str, expected: str
) -> tuple[float, float, float]:
    detector = vtkSpectralWatermarkDetect()
    detector.SetInputData(mesh)
    detector.SetSchemeToPaperSlots()
    detector.SetFirstComponent(first)
    detector.SetSlotDivision(division)
    detector.SetSecretKey(key)
    detector.SetExpectedMessage(expected)
    detector.SetFalsePositiveRate(1.0)
    update(detector)
    hard = detector.GetPValue()
    detector.SetDetectorToLikelihood()
    update(detector)
    return hard, detector.GetPValue(), detector.GetLogLikelihoodRatio()


# --- How unmarked meshes read ------------------------------------------------------------------


def ones_by_position(magnitudes: np.ndarray, first: int, division: int) -> np.ndarray:
    """The share of windows that read 1, for each carrier position."""
    return read_windows(magnitudes, division).one[first - 1:].mean(axis=0)


def group_sums(magnitudes: np.ndarray, first: int, division: int, size: int) -> np.ndarray:
    """The number of ones in each group of consecutive slots, for all offsets and carrier positions."""
    one = read_windows(magnitudes, division).one[first - 1:].astype(int)
    sums = []
    for offset in range(SLOT_SIZE):
        slots = one[offset::SLOT_SIZE]
        for begin in range(0, len(slots) - size + 1, size):
            sums.append(slots[begin:begin + size].sum(axis=0))
    return np.concatenate(sums) if sums else np.zeros(0)


def variance_ratio(groups: list[np.ndarray], size: int) -> float:
    """The variance of the groups' ones, divided by that of independent draws with the same share of
    ones. It is 1 if slots are independent and all meshes alike, and NaN without groups.
    """
    sums = np.concatenate(groups)
    share = sums.mean() / size if len(sums) else 0.0
    return float(sums.var() / (size * share * (1.0 - share))) if 0.0 < share < 1.0 else math.nan
