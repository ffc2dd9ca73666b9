#!/usr/bin/env bash
# Writes vtkFiltersSpectralWatermark.pyi anew, with VTK's own generator, from the package in build/. To be run
# after a change of the filters' public face; Testing/Python/test_stubs.py tells when.
#
# The generator is not in Debian's python3-vtk9 but in its python3-paraview, which cannot be installed beside
# it: Wrapping/ParaView/build.sh has it unpacked.
set -euo pipefail
project=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
generator=$project/build/paraview/root/usr/lib/python3/dist-packages/vtkmodules/generate_pyi.py
[ -f "$generator" ] || "$project/Wrapping/ParaView/build.sh"

folder=$(mktemp -d)
trap 'rm -r "$folder"' EXIT
# Copied: beside it lie the VTK modules of ParaView, which Python would find first.
cp "$generator" "$folder"
PYTHONPATH=$project/build/lib/python3/dist-packages /usr/bin/python3 "$folder/generate_pyi.py" \
  -p spectralwatermark -o "$folder" vtkFiltersSpectralWatermark
{
  echo "# SPDX-License-Identifier: BSD-3-Clause"
  echo "# Made by make_stubs.sh."
  # The generator forgets to import what SafeDownCast() takes.
  sed "0,/^import vtkmodules/s//from vtkmodules.vtkCommonCore import vtkObjectBase\nimport vtkmodules/" \
    "$folder/vtkFiltersSpectralWatermark.pyi"
} >"$project/Wrapping/Python/spectralwatermark/vtkFiltersSpectralWatermark.pyi"
