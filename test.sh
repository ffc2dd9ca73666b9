#!/usr/bin/env bash
# Builds and runs the tests.
#
#   ./test.sh          the quick set: what every change must pass
#   ./test.sh --full   also: the filters under the sanitizers, clang with warnings as errors,
#                      and clang-tidy
#
# Tests on real scans look in SPECTRALWATERMARK_MESH_DIR and skip without it (see CONTRIBUTING.md).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
source ./dependencies.sh

full=no
case "${1:-}" in
  "") ;;
  --full) full=yes ;;
  *)
    echo "usage: ./test.sh [--full]" >&2
    exit 2
    ;;
esac

install_missing "${BUILD_PACKAGES[@]}" "${TEST_PACKAGES[@]}" "${DEMO_PACKAGES[@]}"
jobs=$(nproc)

if [ $full = yes ]; then
  install_missing "${FULL_TEST_PACKAGES[@]}"
  echo "== clang, warnings as errors"
  cmake --preset clang -DSPECTRALWATERMARK_WARNINGS_AS_ERRORS=ON
  cmake --build --preset clang
  echo "== clang-tidy"
  git ls-files 'Filters/*.cxx' | xargs -P "$jobs" -n 1 clang-tidy --quiet -p build/clang
  echo "== address and undefined behaviour sanitizers"
  cmake --preset asan
  cmake --build --preset asan
  # VTK's singletons outlive main: leaks are looked for in the Core tests only.
  ASAN_OPTIONS=detect_leaks=0 ctest --preset asan -j "$jobs" --output-on-failure
fi

cmake --preset release -DSPECTRALWATERMARK_BUILD_TESTING=ON \
  -DSPECTRALWATERMARK_WARNINGS_AS_ERRORS=ON
cmake --build --preset release
ctest --preset release -j "$jobs"
