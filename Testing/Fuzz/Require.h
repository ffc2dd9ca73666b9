// SPDX-License-Identifier: BSD-3-Clause
#ifndef SpectralWatermark_Testing_Require_h
#define SpectralWatermark_Testing_Require_h

#include <cstdio>
#include <cstdlib>

namespace fuzzing
{

/// Ends the program, as a fuzzer wants it, when something does not hold.
inline void Require(bool holds, const char* what)
{
  if (!holds)
  {
    std::fprintf(stderr, "%s\n", what);
    std::abort();
  }
}

} // namespace fuzzing

#endif
