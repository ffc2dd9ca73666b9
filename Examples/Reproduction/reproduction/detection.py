# SPDX-License-Identifier: BSD-3-Clause
"""A second implementation of the paper's detector in numpy: readings, likelihoods, p-values.

It reads all slots at once and tries thousands of messages and keys on a spectrum in a second.
calibration.verify() compares it with vtkSpectralWatermarkDetect.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from .spectra import SLOT_SIZE

POSITIONS = np.arange(2, SLOT_SIZE)  # possible positions of a carrier, 1-based
DEFAULT_POSITION = 3  # index of position 5

# The filter's upper bounds for the share of slots of an unmarked mesh that read 0 and 1 (no key).
ZERO_AT_MOST = (0.60, 0.57)  # by division
ONE_AT_MOST = (0.52, 0.52)

UNMARKED_MEAN = (0.03, 0.14)  # mean of (c - a) / a, by division
UNMARKED_DEVIATION = (0.56, 0.83)
LOST_SHARE = 0.3
KEPT_CORRELATION = 0.8
WEIGHT_STEPS = 20000.0

_erfc = np.vectorize(math.erfc, otypes=[float])


@dataclass(frozen=True)
class Readings:
    """All windows of ten components of a spectrum: a row for each first component (0-based), a
    column for each carrier position."""

    division: int
    magnitude: np.ndarray
    average: np.ndarray
    deviation: np.ndarray
    one: np.ndarray  # eq. 12
    log_zero: np.ndarray  # log likelihood ratios against an unmarked mesh
    log_one: np.ndarray


def read_windows(magnitudes: np.ndarray, division: int, embedding: int = 0) -> Readings:
    windows = np.lib.stride_tricks.sliding_window_view(magnitudes, SLOT_SIZE)
    average = np.empty((len(windows), len(POSITIONS)))
    deviation = np.empty_like(average)
    for column, position in enumerate(POSITIONS):
        if division == 0:
            references = [i for i in range(SLOT_SIZE - 1) if i != position - 1]
        else:
            references = [position - 2, position]
        average[:, column] = windows[:, references].mean(axis=1)
        deviation[:, column] = windows[:, references].std(axis=1)
    magnitude = windows[:, POSITIONS - 1]
    zero, one = log_likelihood_ratios(magnitude, average, deviation, division, embedding)
    return Readings(division, magnitude, average, deviation, magnitude > average, zero, one)


def log_likelihood_ratios(
    magnitude: np.ndarray, average: np.ndarray, deviation: np.ndarray, division: int,
    embedding: int, turbulence: float = 1.0,
) -> tuple[np.ndarray, np.ndarray]:
    """Log likelihood ratios of a slot with a 0, and of one with a 1, against an unmarked slot."""
    valid = average > 0.0
    safe = np.where(valid, average, 1.0)
    u = magnitude / safe - 1.0
    s = turbulence * deviation / safe
    mean, spread = UNMARKED_MEAN[division], UNMARKED_DEVIATION[division]
    unmarked = _log_normal(u, mean, spread)
    ratios = []
    for side, target in ((-1.0, np.maximum(-1.0, -s)), (1.0, s)):
        threshold = target if embedding == 0 else np.zeros_like(target)
        marked = _log_marked_above(side * u, side * mean, spread, side * threshold, side * target)
        ratios.append(np.where(valid, marked - unmarked, 0.0))
    return ratios[0], ratios[1]


def _log_marked_above(
    x: np.ndarray, mean: float, spread: float, threshold: np.ndarray, target: np.ndarray
) -> np.ndarray:
    noise = spread * math.sqrt(1.0 - KEPT_CORRELATION**2)

    def drawn(u: np.ndarray) -> np.ndarray:
        return mean + KEPT_CORRELATION * (u - mean)

    unmarked = _log_normal(x, mean, spread)
    stayed = unmarked + _log_upper_tail((threshold - drawn(x)) / noise)
    moved = _log_upper_tail((mean - threshold) / spread) + _log_normal(x, drawn(target), noise)
    kept = math.log(1.0 - LOST_SHARE) + np.logaddexp(stayed, moved)
    return np.logaddexp(math.log(LOST_SHARE) + unmarked, kept)


def _log_normal(x: np.ndarray, mean: float | np.ndarray, deviation: float) -> np.ndarray:
    z = (x - mean) / deviation
    return -0.5 * z * z - math.log(deviation) - 0.5 * math.log(2.0 * math.pi)


def _log_upper_tail(z: np.ndarray) -> np.ndarray:
    near = np.log(0.5 * _erfc(np.minimum(z, 30.0) / math.sqrt(2.0)))
    far = _log_normal(z, 0.0, 1.0) - np.log(np.maximum(z, 1.0))
    return np.where(z < 30.0, near, far)


@dataclass(frozen=True)
class Cases:
    """Detections to try on one spectrum, one in each row: the slots and the expected bits."""

    rows: np.ndarray  # row in Readings, by case and slot
    columns: np.ndarray
    inverted: np.ndarray  # whether the keystream inverts the bit
    expected: np.ndarray  # 0 or 1
    keyed: bool


@dataclass(frozen=True)
class PValues:
    """P-values from counting bits, weighing them, and counting them as if all were fair coins."""

    hard: np.ndarray
    soft: np.ndarray
    naive: np.ndarray
    ratio: np.ndarray  # log likelihood ratio


def p_values(readings: Readings, cases: Cases) -> PValues:
    where = (cases.rows, cases.columns)
    inverted = cases.inverted
    bits = (readings.one[where] ^ inverted).astype(int)
    zero = np.where(inverted, readings.log_one[where], readings.log_zero[where])
    one = np.where(inverted, readings.log_zero[where], readings.log_one[where])
    agree = bits == cases.expected
    fair = np.full(bits.shape, 0.5)
    probability = fair if cases.keyed else np.where(
        cases.expected == 1, ONE_AT_MOST[readings.division], ZERO_AT_MOST[readings.division])
    evidence = np.maximum(0.0, np.where(bits == 1, one - zero, zero - one))
    ones = np.ones_like(bits)
    return PValues(
        weighted_tail(ones, probability, agree),
        weighted_tail(rounded_weights(evidence), probability, agree),
        weighted_tail(ones, fair, agree),
        np.where(cases.expected == 1, one, zero).sum(axis=1))


def rounded_weights(evidence: np.ndarray) -> np.ndarray:
    step = evidence.sum(axis=1, keepdims=True) / WEIGHT_STEPS
    rounded = np.floor(evidence / np.where(step > 0.0, step, 1.0) + 0.5).astype(int)
    return np.where(step > 0.0, rounded, 1)


def weighted_tail(
    weights: np.ndarray, probabilities: np.ndarray, agree: np.ndarray
) -> np.ndarray:
    """For each row P(sum of w_i X_i >= sum of w_i agree_i), X_i 1 with probability p_i.

    The filter adds up a distribution. This function meets in the middle instead: it compares all
    sums of the first half of the slots with the sorted sums of the second.
    """
    count, slots = weights.shape
    chunk = max(1, 2**19 >> (slots - slots // 2))  # rows at a time, to bound the memory
    parts = [_weighted_tail(weights[i:i + chunk], probabilities[i:i + chunk], agree[i:i + chunk])
             for i in range(0, count, chunk)]
    return np.concatenate(parts) if parts else np.zeros(0)


def _weighted_tail(
    weights: np.ndarray, probabilities: np.ndarray, agree: np.ndarray
) -> np.ndarray:
    count, slots = weights.shape
    half = slots // 2
    reached = (weights * agree).sum(axis=1)
    first, first_p = _all_sums(weights[:, :half], probabilities[:, :half])
    second, second_p = _all_sums(weights[:, half:], probabilities[:, half:])
    order = np.argsort(second, axis=1, kind="stable")
    second = np.take_along_axis(second, order, axis=1)
    second_p = np.take_along_axis(second_p, order, axis=1)
    tails = np.zeros((count, second.shape[1] + 1))
    tails[:, :-1] = second_p[:, ::-1].cumsum(axis=1)[:, ::-1]
    # One search serves all rows, because each row's sums are lifted above those of the previous row.
    total = int(weights.sum(axis=1).max()) + 2
    lift = total * np.arange(count)[:, None]
    wanted = np.clip(reached[:, None] - first, 0, total - 1) + lift
    index = np.searchsorted((second + lift).ravel(), wanted.ravel()).reshape(wanted.shape)
    index -= second.shape[1] * np.arange(count)[:, None]
    return np.minimum(1.0, (first_p * np.take_along_axis(tails, index, axis=1)).sum(axis=1))


def _all_sums(weights: np.ndarray, probabilities: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """For every subset of a row's slots, its sum of weights and its probability."""
    sums = np.zeros((len(weights), 1), dtype=np.int64)
    chances = np.ones((len(weights), 1))
    for slot in range(weights.shape[1]):
        p = probabilities[:, slot:slot + 1]
        sums = np.hstack([sums, sums + weights[:, slot:slot + 1]])
        chances = np.hstack([chances * (1.0 - p), chances * p])
    return sums, chances
