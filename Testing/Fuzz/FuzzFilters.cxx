// SPDX-License-Identifier: BSD-3-Clause
// A filter on any mesh with any properties; which one, the build decides.
#include "Support/FilterCase.h"
#include "Fuzz/Require.h"

#include <vtkOutputWindow.h>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  vtkOutputWindow::GetInstance()->SetDisplayModeToNever();
  fuzzing::Bytes bytes(data, size);
  const fuzzing::Outcome outcome = fuzzing::RunFilterCase(FUZZED_FILTER, bytes);
  fuzzing::Require(outcome.Wrong.empty(), outcome.Wrong.c_str());
  return 0;
}
