# SPDX-License-Identifier: BSD-3-Clause
"""What the commands share: running filters, and meshes that every filter takes."""

from __future__ import annotations

import time
from collections.abc import Callable

from spectralwatermark import vtkMeshAttack, vtkSpectralWatermarkAlgorithm
from spectralwatermark.execution import FilterError, update
from spectralwatermark.io import MeshFileError, read_mesh
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm

from ..tasks import Watermark


class FilterRunner:
    """Updates filters, shows their progress, and stops them when that is asked for."""

    def __init__(self, show: Callable[[float, str], None], stopped: Callable[[], bool]) -> None:
        self._show = show
        self._stopped = stopped

    def update(self, algorithm: vtkAlgorithm, what: str) -> float:
        """Returns the seconds taken; raises FilterError."""
        started = time.monotonic()
        update(algorithm, lambda share: self._show(share, what), self._stopped)
        return time.monotonic() - started


def read_valid_mesh(path: str) -> vtkPolyData:
    """Reads a mesh that the filters accept. Where a command has several inputs, the error so names the right one."""
    mesh = read_mesh(path)
    quick = vtkMeshAttack()
    quick.SetInputData(mesh)
    try:
        update(quick)
    except FilterError as error:
        raise MeshFileError(f"{path}: {error}") from None
    return mesh


def set_watermark(algorithm: vtkSpectralWatermarkAlgorithm, mark: Watermark) -> None:
    """Sets what embedding and detection have in common: scheme, length and secret."""
    if mark.scheme == "paper":
        algorithm.SetSchemeToPaperSlots()
    algorithm.SetNumberOfBits(mark.bits)
    if mark.secret.key_file:
        algorithm.SetSecretKeyFile(mark.secret.key_file)
    if mark.secret.key:
        algorithm.SetSecretKey(mark.secret.key)
