#!/usr/bin/env bash
# Prints, file by file, how many lines of Filters/ the C++ tests run; fails under 90 percent.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source ./dependencies.sh
install_missing "${BUILD_PACKAGES[@]}" "${TEST_PACKAGES[@]}" "${FULL_TEST_PACKAGES[@]}"
least=90

cmake --preset coverage
cmake --build --preset coverage --target CoreTests FilterTests
build=build/coverage
rm -f $build/*.profraw
export LLVM_PROFILE_FILE=$build/%m.profraw # %m: one for each program and library
$build/bin/CoreTests --gtest_brief=1
# Whole scans would take hours here, and add no code path.
$build/bin/FilterTests --gtest_brief=1 --gtest_filter='-Scans/*:RealMeshes*'
llvm-profdata merge -sparse -o $build/tests.profdata $build/*.profraw
libraries=("$build"/lib/libvtkFiltersSpectralWatermark*.so)
llvm-cov report -instr-profile=$build/tests.profdata -show-region-summary=false \
  -show-branch-summary=false $build/bin/CoreTests -object $build/bin/FilterTests \
  -object "${libraries[0]}" Filters | tee $build/coverage.txt
awk -v least=$least '/^TOTAL/ { percent = $NF + 0 }
  END { if (percent < least) { print "under " least " percent of lines"; exit 1 } }' $build/coverage.txt
