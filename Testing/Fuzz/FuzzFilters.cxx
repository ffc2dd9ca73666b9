// SPDX-License-Identifier: BSD-3-Clause
// A filter on any mesh with any properties: the one that the environment variable FUZZED_FILTER names.
#include "Fuzz/Require.h"
#include "Support/FilterCase.h"

#include <vtkOutputWindow.h>

#include <algorithm>
#include <cstdlib>
#include <string>

namespace
{

std::string FuzzedFilter()
{
  const char* name = std::getenv("FUZZED_FILTER");
  const auto& all = fuzzing::FilterNames;
  fuzzing::Require(name != nullptr &&
      std::any_of(all.begin(), all.end(),
        [name](const char* known) { return std::string(known) == name; }),
    "set FUZZED_FILTER to the name of a filter, without vtk");
  return name;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  static const std::string filter = FuzzedFilter();
  vtkOutputWindow::GetInstance()->SetDisplayModeToNever();
  fuzzing::Bytes bytes(data, size);
  const fuzzing::Outcome outcome = fuzzing::RunFilterCase(filter, bytes);
  fuzzing::Require(outcome.Wrong.empty(), outcome.Wrong.c_str());
  return 0;
}
