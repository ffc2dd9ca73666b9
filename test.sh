#!/usr/bin/env bash
# Builds and runs the tests.
#
#   ./test.sh          the quick set: what every change must pass
#   ./test.sh --full   also: the filters under the sanitizers and valgrind, clang with warnings as errors,
#                      clang-tidy, fuzzing, coverage, debug beside release, the ParaView plugin, large scans in
#                      every mode, and the packages in a clean root
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
# Tests run side by side, each on several threads: idle ones should not spin.
export OMP_WAIT_POLICY=passive

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
  # VTK's singletons outlive main: leaks are looked for in the Core tests only. Whole scans would
  # take hours here, and add no code path.
  ASAN_OPTIONS=detect_leaks=0 ctest --preset asan -j "$jobs" --exclude-regex 'Scans/|RealMeshes'
  echo "== thread sanitizer"
  cmake --preset tsan
  cmake --build --preset tsan --target CoreTests FilterTests
  ctest --preset tsan -j "$jobs" --tests-regex 'Concurrency|Threads'
  echo "== fuzzing, 20 seconds each"
  cmake --preset fuzz
  cmake --build --preset fuzz --target Fuzzers
  ctest --preset fuzz
  echo "== coverage"
  Testing/Coverage/coverage.sh
  echo "== ParaView plugin"
  Wrapping/ParaView/build.sh
  Wrapping/ParaView/test.sh
  export SPECTRALWATERMARK_FULL_TESTS=1 # large scans in every mode, in the release build below
fi

cmake --preset release -DSPECTRALWATERMARK_BUILD_TESTING=ON \
  -DSPECTRALWATERMARK_WARNINGS_AS_ERRORS=ON
cmake --build --preset release
ctest --preset release -j "$jobs"
if [ $full = yes ]; then
  echo "== bits and decisions of debug and release"
  Testing/Determinism/compare.sh
  echo "== valgrind"
  valgrind --quiet --error-exitcode=1 build/bin/FilterTests \
    --gtest_filter='Concurrency.AFilterThat*:MeshAttack.UnknownAttack*'
  echo "== packages in a clean root"
  Testing/Packages/test.sh
fi
