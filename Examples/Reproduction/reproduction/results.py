# SPDX-License-Identifier: BSD-3-Clause
"""Sums and averages over the experiments, computed from the store alone."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

import numpy as np

from . import calibration, detection, paper, roc
from .detection import DEFAULT_POSITION, read_windows
from .experiments import ATTACK, MODES, UNATTACKED, Mode
from .models import Model
from .plan import Plan, calibration_key, mark_key, unmarked_key
from .spectra import BITS, SLOT_SIZE
from .store import Store


@dataclass(frozen=True)
class Spread:
    """Mean and standard deviation of some values."""

    mean: float
    deviation: float | None  # None for a single value


def spread(values: Sequence[float]) -> Spread | None:
    if not values:
        return None
    return Spread(float(np.mean(values)), float(np.std(values)) if len(values) > 1 else None)


# --- Tables 1 to 4 -----------------------------------------------------------------------------


@dataclass(frozen=True)
class EmbeddingRow:
    """A model in one mode; averages over the messages that converged."""

    model: Model
    marks: int
    converged: int
    iterations: Spread | None
    geometric: Spread | None
    curvature: Spread | None
    bits_right_otherwise: list[int]
    printed: paper.Row | None


def marks_of(plan: Plan, store: Store, model: Model, mode: Mode) -> dict[str, dict]:
    """The records of the marks, by message."""
    records = {message: store.get(mark_key(model, mode, message, UNATTACKED))
               for message in plan.messages}
    return {message: record for message, record in records.items() if record is not None}


def embedding_rows(plan: Plan, store: Store, mode: Mode) -> list[EmbeddingRow]:
    rows = []
    for model in plan.models:
        records = list(marks_of(plan, store, model, mode).values())
        if not records:
            continue
        good = [record for record in records if is_read(record)]
        rows.append(EmbeddingRow(
            model, len(records), len(good),
            spread([record["iterations"] for record in good]),
            spread([record["geometric"] for record in good]),
            spread([record["curvature"] for record in good]),
            sorted(BITS - record["errors"] for record in records if not is_read(record)),
            paper.printed(mode.key, model.name)))
    return rows


def is_read(record: dict) -> bool:
    """The blind detector decides, not the embedding filter's own report."""
    return record["errors"] == 0


@dataclass
class Convergence:
    """Counts over all marks of some modes."""

    marks: int = 0
    read: int = 0
    contradictions: int = 0  # between GetConverged() and the detector


def convergence(plan: Plan, store: Store, modes: Iterable[Mode] = MODES) -> Convergence:
    total = Convergence()
    for mode in modes:
        for model in plan.models:
            for record in marks_of(plan, store, model, mode).values():
                total.marks += 1
                total.read += is_read(record)
                total.contradictions += is_read(record) != record["converged"]
    return total


# --- Robustness --------------------------------------------------------------------------------


@dataclass
class Robustness:
    """The wrong bits in each marked mesh after one attack."""

    errors: list[int] = field(default_factory=list)

    def mean(self) -> float:
        return float(np.mean(self.errors))

    def read(self) -> int:
        """The number of marks that were read without any error."""
        return sum(errors == 0 for errors in self.errors)

    def share_read(self) -> float:
        return float(np.mean([errors == 0 for errors in self.errors]))


def robustness(
    plan: Plan, store: Store, models: Iterable[Model], mode: Mode, attack: str
) -> Robustness:
    """The results for all marks that were readable before the attack."""
    result = Robustness()
    for model in models:
        for message, mark in marks_of(plan, store, model, mode).items():
            record = store.get(mark_key(model, mode, message, attack))
            if record is not None and is_read(mark) \
                    and attack in (UNATTACKED, *plan.attacks_on(model, mode, message)):
                result.errors.append(record["errors"])
    return result


def large_models(plan: Plan) -> list[Model]:
    """The meshes that were attacked in some modes only."""
    small = plan.robustness_models()
    return [model for model in plan.models if model not in small
            and any(plan.attacks_on(model, mode, message)
                    for mode in MODES for message in plan.messages)]


def claims(plan: Plan, store: Store) -> list[tuple[paper.Claim, Robustness]]:
    """The paper's claims of robustness with their results on all meshes."""
    return [(claim, robustness(plan, store, plan.models, _mode(claim.mode), claim.attack))
            for claim in paper.CLAIMS]


def _mode(key: str) -> Mode:
    return next(mode for mode in MODES if mode.key == key)


# --- Calibration -------------------------------------------------------------------------------


def calibrations(plan: Plan, store: Store) -> dict[Model, dict]:
    records = {model: store.get(calibration_key(plan, model)) for model in plan.models}
    return {model: record for model, record in records.items() if record is not None}


@dataclass(frozen=True)
class BitStatistics:
    """How the slots of unmarked meshes read, in one division."""

    division: int
    windows: int
    by_model: dict[str, float]  # share that reads 1
    by_position: np.ndarray
    variance_ratios: dict[int, float]  # by group size

    def share(self) -> float:
        return float(np.mean(list(self.by_model.values())))

    def extremes(self) -> tuple[float, float]:
        """The smallest and largest share over meshes and over positions."""
        values = [*self.by_model.values(), *self.by_position]
        return float(min(values)), float(max(values))

    def within_bounds(self) -> bool:
        least, most = self.extremes()
        return most <= detection.ONE_AT_MOST[self.division] \
            and 1.0 - least <= detection.ZERO_AT_MOST[self.division]


def bit_statistics(plan: Plan, store: Store, division: int) -> BitStatistics:
    by_model, positions, windows = {}, [], 0
    groups: dict[int, list[np.ndarray]] = {size: [] for size in (5, 10, 20)}
    for model, record in calibrations(plan, store).items():
        magnitudes, first = np.array(record["magnitudes"]), record["first"]
        ones = calibration.ones_by_position(magnitudes, first, division)
        by_model[model.name] = float(ones.mean())
        positions.append(ones)
        windows += (len(magnitudes) - SLOT_SIZE + 1 - (first - 1)) * len(ones)
        for size, sums in groups.items():
            sums.append(calibration.group_sums(magnitudes, first, division, size))
    return BitStatistics(division, windows, by_model, np.mean(positions, axis=0),
                         {size: calibration.variance_ratio(sums, size)
                          for size, sums in groups.items()})


UNLIKELY = 10000


def binomial_tail(hits: int, cases: int, probability: float) -> float:
    """The probability of that many hits or more; 1 if there are no more than expected."""
    if hits <= cases * probability:
        return 1.0
    tail = 0.0
    for count in range(hits, cases + 1):
        term = math.exp(
            math.lgamma(cases + 1) - math.lgamma(count + 1) - math.lgamma(cases - count + 1) +
            count * math.log(probability) + (cases - count) * math.log1p(-probability))
        tail += term
        if term < 1e-12 * tail or term == 0.0:
            break
    return tail


@dataclass
class Rates:
    """Measured false-positive rates of one kind of expectation, by threshold."""

    kind: str
    message: str
    division: int
    length: int
    keyed: bool
    cases: int = 0
    hits: dict[str, np.ndarray] = field(default_factory=dict)
    worst: dict[str, np.ndarray] = field(default_factory=dict)  # the highest of a single mesh

    def add(self, record: dict) -> None:
        self.cases += record["cases"]
        for detector in ("hard", "soft", "naive"):
            counts = np.array(record[detector])
            zero = np.zeros(len(counts))
            self.hits[detector] = self.hits.get(detector, zero) + counts
            self.worst[detector] = np.maximum(
                self.worst.get(detector, zero), counts / max(1, record["cases"]))

    def rate(self, detector: str) -> np.ndarray:
        return self.hits[detector] / max(1, self.cases)

    def too_many(self, detector: str) -> np.ndarray:
        """Thresholds where the rate exceeds the claim by more than chance explains.

        So many hits would occur once in UNLIKELY times if the cases were independent and the rate
        equal to the claim.
        """
        return np.array([binomial_tail(int(hits), self.cases, alpha) < 1.0 / UNLIKELY
                         for hits, alpha in zip(self.hits[detector], calibration.ALPHAS)])


def false_positives(plan: Plan, store: Store) -> list[Rates]:
    collected: dict[tuple, Rates] = {}
    for record in calibrations(plan, store).values():
        for entry in record["rates"]:
            key = (entry["kind"], entry["message"], entry["division"], entry["length"])
            if key not in collected:
                collected[key] = Rates(entry["kind"], entry["message"], entry["division"],
                                       entry["length"], entry["keyed"])
            collected[key].add(entry)
    return list(collected.values())


def verification(plan: Plan, store: Store) -> tuple[int, float]:
    """The count of numbers compared between the filter and numpy, and the largest difference."""
    records = calibrations(plan, store).values()
    return (sum(record["compared"] for record in records),
            max((record["difference"] for record in records), default=0.0))


# --- ROC ---------------------------------------------------------------------------------------


@dataclass(frozen=True)
class RocSummary:
    """The curves of both detectors in one division, and the number of cases behind them."""

    curves: dict[str, roc.Curve]  # by detector: hard, soft
    positives: int
    negatives: int
    attacked_meshes: int  # that the negatives come from


def roc_summaries(
    plan: Plan, store: Store, families: Sequence[str] | None = None
) -> dict[str, RocSummary]:
    """Summaries by division, under all attacks or those of some families."""
    attacks = [key for key in plan.attacks if families is None or ATTACK[key].family in families]
    summaries = {}
    for division, name in enumerate(calibration.DIVISIONS):
        positive = _positives(plan, store, division, attacks)
        negative, meshes = _negatives(plan, store, division, attacks)
        if positive.size and negative.size:
            curves = {"hard": roc.curve(positive[:, 0], negative[:, 0]),
                      "soft": roc.curve(positive[:, 1], negative[:, 1])}
            summaries[name] = RocSummary(curves, len(positive), len(negative), meshes)
    return summaries


def _positives(plan: Plan, store: Store, division: int, attacks: Sequence[str]) -> np.ndarray:
    """The number of agreeing bits and the likelihood ratio of every attacked mark."""
    scores = []
    for mode in (mode for mode in MODES if mode.division == division):
        for model in plan.robustness_models():
            for message, mark in marks_of(plan, store, model, mode).items():
                for attack in attacks if is_read(mark) else ():
                    record = store.get(mark_key(model, mode, message, attack))
                    if record is not None:
                        scores.append((BITS - record["errors"], record["ratio"]))
    return np.array(scores)


def _negatives(
    plan: Plan, store: Store, division: int, attacks: Sequence[str]
) -> tuple[np.ndarray, int]:
    """The same for unmarked meshes, each with every possible message."""
    messages = (np.arange(2**BITS)[:, None] >> np.arange(BITS)) & 1
    scores, meshes = [], 0
    for model in plan.robustness_models():
        for attack in attacks:
            record = store.get(unmarked_key(model, attack))
            if record is None:
                continue
            meshes += 1
            for embedding in (0, 1):
                readings = read_windows(np.array(record["slots"]), division, embedding)
                slots = (SLOT_SIZE * np.arange(BITS), DEFAULT_POSITION)
                agree = (messages == readings.one[slots]).sum(axis=1)
                ratio = np.where(messages == 1, readings.log_one[slots],
                                 readings.log_zero[slots]).sum(axis=1)
                scores.append(np.column_stack([agree, ratio]))
    return np.concatenate(scores) if scores else np.zeros((0, 2)), meshes
