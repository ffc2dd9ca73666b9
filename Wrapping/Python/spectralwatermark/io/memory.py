# SPDX-License-Identifier: BSD-3-Clause
"""Refuses a file that would not fit into memory, before it is read.

Linux grants memory that is not there, and kills the process that uses it. Each format's module
holds MEMORY_PER_BYTE: the least peak memory that was measured for each byte of a file, with a mesh
of a million triangles. Text and compressed files take up to four times as much.
Testing/Benchmark/memory measures it.
"""

from __future__ import annotations

from .errors import MeshFileError

FREE_MEMORY = "close other programs, or simplify the mesh in another program first"

# Less than this is not worth a check.
_LITTLE_MEMORY = 50e6


def require_memory(needed: float) -> None:
    """Raises MeshFileError when fewer than `needed` bytes are free."""
    if needed <= _LITTLE_MEMORY:
        return
    # Imported here: small files can be read without the compiled library.
    from .. import vtkSpectralWatermarkAlgorithm

    free = vtkSpectralWatermarkAlgorithm.GetAvailableMemory()
    if needed > free:
        raise MeshFileError(f"reading it needs at least {needed / 1e9:.1f} GB of memory, but only "
                            f"{free / 1e9:.1f} GB are free; {FREE_MEMORY}")
