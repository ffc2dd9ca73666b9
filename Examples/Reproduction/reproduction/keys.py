# SPDX-License-Identifier: BSD-3-Clause
"""The choices that secret keys make, observed through the filter on a tiny mesh.

The positions of the carriers, the inverted slots and the derived message do not depend on the mesh: a
mesh with a few hundred vertices shows them in milliseconds.
"""

from __future__ import annotations

from functools import lru_cache
from typing import NamedTuple

import numpy as np
from spectralwatermark import vtkMeshAttack, vtkSpectralWatermarkDetect
from spectralwatermark.io import read_mesh
from spectralwatermark.execution import update
from vtkmodules.vtkCommonDataModel import vtkPolyData

from .models import PEBBLE
from .spectra import BELOW_FIRST_SLOT, SLOT_SIZE, harmonics_of

LONGEST = 25  # bits; shorter messages use the first part of the streams
SMALLEST_SLOT = 4  # components


class Streams(NamedTuple):
    """A row for each key, a column for each slot."""

    columns: np.ndarray  # index of the carrier's position, from position 2 on
    inverted: np.ndarray
    derived: np.ndarray  # the bits of the message that the key derives


def secret(number: int) -> str:
    return f"reproduction key {number}"


@lru_cache(maxsize=2)
def key_streams(count: int) -> Streams:
    """The streams of the first keys."""
    tiny = _tiny_mesh(1 + BELOW_FIRST_SLOT + LONGEST * SLOT_SIZE)
    tinier = _tiny_mesh(1 + LONGEST * SMALLEST_SLOT)
    places = [_places(tiny, secret(number)) for number in range(count)]
    return Streams(
        np.array([columns for columns, _ in places]),
        np.array([inverted for _, inverted in places]),
        np.array([_derived_message(tinier, secret(number)) for number in range(count)]))


def _tiny_mesh(harmonics: int) -> vtkPolyData:
    pebble = read_mesh(PEBBLE)
    smaller = vtkMeshAttack()
    smaller.SetInputData(pebble)
    smaller.SetAttackToSimplification()
    kept = 1.1 * harmonics / pebble.GetNumberOfPoints()
    smaller.SetSimplificationPercent(100.0 * (1.0 - kept))
    update(smaller)
    return harmonics_of(smaller.GetOutput(), harmonics)


def _detector(mesh: vtkPolyData, key: str) -> vtkSpectralWatermarkDetect:
    detector = vtkSpectralWatermarkDetect()
    detector.SetInputData(mesh)
    detector.SetSchemeToPaperSlots()
    detector.SetSecretKey(key)
    detector.SetFalsePositiveRate(1.0)
    return detector


def _places(mesh: vtkPolyData, key: str) -> tuple[list[int], list[bool]]:
    detector = _detector(mesh, key)
    detector.SetNumberOfBits(LONGEST)
    update(detector)
    table = detector.GetOutputDataObject(1)
    columns, inverted = [], []
    for slot in range(LONGEST):
        component, magnitude, average, bit = (
            table.GetValueByName(slot, name)
            for name in ("Component", "Magnitude", "Average", "Bit"))
        begin = BELOW_FIRST_SLOT + 1 + slot * SLOT_SIZE
        columns.append(component.ToInt() - begin - 1)  # position 2 is column 0
        inverted.append((magnitude.ToDouble() > average.ToDouble()) != (bit.ToInt() == 1))
    return columns, inverted


def _derived_message(mesh: vtkPolyData, key: str) -> list[int]:
    """Asks for one more bit each time, because the filter tells only the number of wrong bits."""
    detector = _detector(mesh, key)
    detector.SetFirstComponent(2)
    detector.SetSlotSize(SMALLEST_SLOT)
    detector.SetCarrierPosition(2)
    detector.UseDerivedMessageOn()
    message: list[int] = []
    wrong_before = 0
    for bits in range(1, LONGEST + 1):
        detector.SetNumberOfBits(bits)
        update(detector)
        wrong = round(detector.GetBitErrorRate() * bits)
        last = int(detector.GetExtractedMessage()[-1])
        message.append(last if wrong == wrong_before else 1 - last)
        wrong_before = wrong
    return message
