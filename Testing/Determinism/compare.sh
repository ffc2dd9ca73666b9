#!/usr/bin/env bash
# Bits and decisions of the release build (build/) beside those of a debug build (build/debug).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
cmake --preset debug -DSPECTRALWATERMARK_WRAP_PYTHON=OFF -DSPECTRALWATERMARK_BUILD_EXAMPLES=OFF
cmake --build --preset debug --target PrintDecisions
cmake --build --preset release --target PrintDecisions
build/bin/PrintDecisions >build/decisions.release
build/debug/bin/PrintDecisions >build/decisions.debug
if ! diff build/decisions.release build/decisions.debug; then
  echo "release (<) and debug (>) differ" >&2
  exit 1
fi

# Ten of each mesh and scheme, but of the sphere two: nothing fits into it.
expected=42
for scan in cow casting; do
  if grep -q "^$scan, " build/decisions.release; then
    expected=$((expected + 20))
  else
    echo "left out: there is no $scan.ply (set SPECTRALWATERMARK_MESH_DIR)"
  fi
done
lines=$(wc -l <build/decisions.release)
if [ "$lines" -ne "$expected" ]; then
  echo "$lines lines of bits and decisions came, not $expected" >&2
  exit 1
fi
echo "$lines lines of bits and decisions are the same in release and debug"
