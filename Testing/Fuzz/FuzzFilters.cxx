// SPDX-License-Identifier: BSD-3-Clause
// A filter on any mesh with any properties; which one, the build decides.
#include "Fuzz/FilterCase.h"

#include <vtkOutputWindow.h>

#include <cstdio>
#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  vtkOutputWindow::GetInstance()->SetDisplayModeToNever();
  fuzzing::Bytes bytes(data, size);
  const fuzzing::Outcome outcome = fuzzing::RunFilterCase(FUZZED_FILTER, bytes);
  if (!outcome.Wrong.empty())
  {
    std::fprintf(stderr, "%s\n", outcome.Wrong.c_str());
    std::abort();
  }
  return 0;
}
