# SPDX-License-Identifier: BSD-3-Clause
"""True against false positives as a detector's threshold falls."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Curve:
    """A curve from (0, 0) to (1, 1) with a point for each value of the statistic."""

    false_positives: np.ndarray
    true_positives: np.ndarray

    def area(self) -> float:
        x, y = self.false_positives, self.true_positives
        return float((np.diff(x) * (y[1:] + y[:-1]) / 2.0).sum())

    def true_positives_at(self, rate: float) -> float:
        """The largest share of true positives with no more false positives than that."""
        return float(self.true_positives[self.false_positives <= rate + 1e-12].max())


def curve(positives: np.ndarray, negatives: np.ndarray) -> Curve:
    thresholds = np.unique(np.concatenate([positives, negatives]))[::-1]
    return Curve(
        np.concatenate([[0.0], _share_at_least(negatives, thresholds)]),
        np.concatenate([[0.0], _share_at_least(positives, thresholds)]))


def _share_at_least(values: np.ndarray, thresholds: np.ndarray) -> np.ndarray:
    below = np.searchsorted(np.sort(values), thresholds, side="left")
    return 1.0 - below / len(values)
