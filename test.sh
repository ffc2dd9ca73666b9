#!/usr/bin/env bash
# Builds and runs the tests.
#
#   ./test.sh               the quick set: what every change must pass
#   ./test.sh --full        everything below, which takes hours
#   ./test.sh --full PART   of it, one part or several:
#
#     clang        clang, with warnings as errors
#     tidy         clang-tidy over Filters/
#     asan         the C++ tests under AddressSanitizer and UndefinedBehaviorSanitizer
#     tsan         the tests with threads under ThreadSanitizer
#     fuzz         every fuzz target for 20 seconds
#     coverage     at least 90 % of the lines of Filters/
#     paraview     the plugin, in ParaView
#     release      every test in its long form: scans in every mode, all trials, a million triangles
#     determinism  bits and decisions of a debug build beside those of the release
#     valgrind     some of the tests under valgrind
#     packages     the Debian packages in a clean root
#
# Quick are the tests of the release build that take at most about 15 seconds of processor time. Longer
# ones look at SPECTRALWATERMARK_FULL_TESTS, which --full sets: without it they try fewer cases, or skip
# where no smaller form keeps their meaning. CTest's label "long" marks what the quick set leaves out
# altogether. Benchmarks are built by --full alone.
#
# Tests on real scans look in SPECTRALWATERMARK_MESH_DIR and skip without it (see CONTRIBUTING.md).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
source ./dependencies.sh

PARTS=(clang tidy asan tsan fuzz coverage paraview release determinism valgrind packages)
jobs=$(nproc)
# Tests run side by side, each on several threads: idle ones should not spin.
export OMP_WAIT_POLICY=passive

configure_clang() {
  cmake --preset clang -DSPECTRALWATERMARK_WARNINGS_AS_ERRORS=ON
}

run_clang() {
  configure_clang
  cmake --build --preset clang
}

run_tidy() {
  configure_clang
  git ls-files 'Filters/*.cxx' | xargs -P "$jobs" -n 1 clang-tidy --quiet -p build/clang
}

run_asan() {
  cmake --preset asan
  cmake --build --preset asan
  # VTK's singletons outlive main: leaks are looked for in the Core tests only. Whole scans would
  # take hours here, and add no code path.
  ASAN_OPTIONS=detect_leaks=0 ctest --preset asan -j "$jobs" --exclude-regex 'Scans/|RealMeshes'
}

run_tsan() {
  cmake --preset tsan
  cmake --build --preset tsan --target CoreTests FilterTests
  ctest --preset tsan -j "$jobs" --tests-regex 'Concurrency|Threads'
}

run_fuzz() {
  cmake --preset fuzz
  cmake --build --preset fuzz --target Fuzzers
  ctest --preset fuzz
}

run_coverage() {
  Testing/Coverage/coverage.sh
}

run_paraview() {
  Wrapping/ParaView/build.sh
  Wrapping/ParaView/test.sh
}

build_release() {
  cmake --preset release -DSPECTRALWATERMARK_BUILD_TESTING=ON \
    -DSPECTRALWATERMARK_WARNINGS_AS_ERRORS=ON -DSPECTRALWATERMARK_BUILD_BENCHMARKS="${1:-ON}"
  cmake --build --preset release
}

run_quick() {
  build_release OFF
  ctest --preset release -j "$jobs" --label-exclude long
}

run_release() {
  build_release
  SPECTRALWATERMARK_FULL_TESTS=1 ctest --preset release -j "$jobs"
}

run_determinism() {
  build_release
  Testing/Determinism/compare.sh
}

run_valgrind() {
  build_release
  valgrind --quiet --error-exitcode=1 build/bin/FilterTests \
    --gtest_filter='Concurrency.AFilterThat*:MeshAttack.UnknownAttack*'
}

run_packages() {
  build_release
  Testing/Packages/test.sh
}

usage() {
  echo "usage: ./test.sh [--full [PART...]], PART one of: ${PARTS[*]}" >&2
  exit 2
}

parts=(quick)
if [ $# -gt 0 ]; then
  [ "$1" = --full ] || usage
  shift
  parts=("${PARTS[@]}")
  [ $# -eq 0 ] || parts=("$@")
  for part in "${parts[@]}"; do
    [[ " ${PARTS[*]} " == *" $part "* ]] || usage
  done
fi

install_missing "${BUILD_PACKAGES[@]}" "${TEST_PACKAGES[@]}" "${DEMO_PACKAGES[@]}"
[ "${parts[*]}" = quick ] || install_missing "${FULL_TEST_PACKAGES[@]}"
for part in "${parts[@]}"; do
  [ "$part" = quick ] || echo "== $part"
  "run_$part"
done
