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
for tests in CoreTests FilterTests; do
  LLVM_PROFILE_FILE=$build/$tests.profraw $build/bin/$tests --gtest_brief=1
done
llvm-profdata merge -sparse -o $build/tests.profdata $build/*.profraw
libraries=("$build"/lib/libvtkFiltersSpectralWatermark*.so)
llvm-cov report -instr-profile=$build/tests.profdata -show-region-summary=false \
  -show-branch-summary=false $build/bin/CoreTests -object $build/bin/FilterTests \
  -object "${libraries[0]}" Filters | tee $build/coverage.txt
awk -v least=$least '/^TOTAL/ { percent = $NF + 0 }
  END { if (percent < least) { print "under " least " percent of lines"; exit 1 } }' $build/coverage.txt
