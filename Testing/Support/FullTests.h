// SPDX-License-Identifier: BSD-3-Clause
/// The division of the tests into a quick set and all of them.
#ifndef SpectralWatermark_Testing_FullTests_h
#define SpectralWatermark_Testing_FullTests_h

#include <cstdlib>

/// Whether every test runs in its long form, as under ./test.sh --full.
inline bool RunsFullTests()
{
  return std::getenv("SPECTRALWATERMARK_FULL_TESTS") != nullptr;
}

/// How many of something a test tries: fewer in the quick set.
inline int QuickOrFull(int quick, int full)
{
  return RunsFullTests() ? full : quick;
}

/// Skips the rest of a test in the quick set.
#define SPECTRALWATERMARK_SKIP_UNLESS_FULL()                                                       \
  if (!RunsFullTests())                                                                            \
  {                                                                                                \
    GTEST_SKIP() << "long: set SPECTRALWATERMARK_FULL_TESTS (./test.sh --full does)";              \
  }

#endif
