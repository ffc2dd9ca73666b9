#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks who includes whom in Filters/: the folders of Core, the folder Private, the filters."""

import re
import sys
from pathlib import Path

FILTERS = Path(__file__).resolve().parents[2] / "Filters"

# What each folder may include besides itself; what those folders include comes with them.
ROOMS = {
    "Core/Support": [],
    "Core/Mesh": ["Core/Support"],
    "Core/LinearAlgebra": ["Core/Support"],
    "Core/Eigensolver": ["Core/LinearAlgebra"],
    "Core/Harmonics": ["Core/Eigensolver", "Core/Mesh"],
    "Core/Payload": ["Core/Support"],
    "Core/RobustScheme": ["Core/Mesh", "Core/Payload"],
    "Core/PaperScheme": ["Core/Harmonics", "Core/Payload", "Core/Mesh"],
    "Core/Attacks": ["Core/Mesh"],
    "Core/Distortion": ["Core/Mesh"],
}
ROOMS["Private"] = [room for room in ROOMS]
ROOMS["."] = ["Private"]

# Libraries that one source file alone includes.
ONLY_IN = {"sodium": "Core/Payload/SecretKey.cxx", "Spectra/": "Core/Eigensolver/SpectraSolver.cxx",
           "Eigen/MetisSupport": "Core/LinearAlgebra/ShiftedFactorization.cxx"}
BASE_CLASSES = ("vtkTriangleMeshAlgorithm", "vtkSpectralWatermarkAlgorithm")


def reach(room: str) -> set[str]:
    return {room}.union(*(reach(each) for each in ROOMS[room]))


def complaints(path: Path) -> list[str]:
    name = path.relative_to(FILTERS)
    room = name.parent.as_posix()
    found = []
    for line, text in enumerate(path.read_text().splitlines(), 1):
        include = re.match(r'#include ([<"])([^>"]+)[>"]', text)
        if not include:
            continue
        system, header = include[1] == "<", include[2]
        own = not system and (FILTERS / header).exists()
        if own and not (Path(header).parent.as_posix() in reach(room)):
            found.append(f"{name}:{line}: {room} must not include {header}")
        if own and room == "." and header.startswith("vtk") and Path(header).stem not in (
                name.stem, *BASE_CLASSES):
            found.append(f"{name}:{line}: filters do not include one another ({header})")
        if not system and not own and room.startswith(("Core", "Private")):
            found.append(f"{name}:{line}: {header}: write the path from Filters/")
        if room.startswith("Core") and header.startswith("vtk"):
            found.append(f"{name}:{line}: Core does not know VTK ({header})")
        for library, only in ONLY_IN.items():
            if system and header.startswith(library) and name.as_posix() != only:
                found.append(f"{name}:{line}: {header} belongs in {only}")
    return found


def main() -> int:
    files = [path for path in sorted(FILTERS.rglob("*")) if path.suffix in (".h", ".cxx")]
    rooms = {path.parent.relative_to(FILTERS).as_posix() for path in files}
    found = [f"{room}: this folder is in no rule" for room in sorted(rooms - set(ROOMS))]
    for path in files:
        if path.parent.relative_to(FILTERS).as_posix() in ROOMS:
            found += complaints(path)
    print("\n".join(found) or f"{len(files)} files keep the include rules")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
