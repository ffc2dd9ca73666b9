// SPDX-License-Identifier: BSD-3-Clause
/// What the tests of refused input share.
#ifndef SpectralWatermark_Testing_ExpectError_h
#define SpectralWatermark_Testing_ExpectError_h

#include "Support/FilterTesting.h"

#include <vtkErrorCode.h>
#include <vtkPolyData.h>
#include <vtkTable.h>
#include <vtkTriangleMeshAlgorithm.h>

#include <gtest/gtest.h>

#include <string>

namespace filtertesting
{

inline void ExpectEmptyOutputs(vtkPolyDataAlgorithm* filter)
{
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0) << filter->GetClassName();
  EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), 0) << filter->GetClassName();
  if (filter->GetNumberOfOutputPorts() == 2)
  {
    auto* table = vtkTable::SafeDownCast(filter->GetOutputDataObject(1));
    EXPECT_EQ(table->GetNumberOfColumns(), 0) << filter->GetClassName();
  }
}

/// Expects that the filter's update fails: with this error code and parameter ("" for the mesh), a text that
/// is made of the error's parts and has this piece, and empty outputs.
inline void ExpectError(vtkPolyDataAlgorithm* filter, const std::string& parameter,
  const std::string& piece, unsigned long code = vtkErrorCode::UserError)
{
  Listener listener(filter);
  filter->Update();
  auto* own = vtkTriangleMeshAlgorithm::SafeDownCast(filter);
  ASSERT_NE(own, nullptr);
  EXPECT_EQ(own->GetErrorCode(), code) << filter->GetClassName();
  EXPECT_EQ(own->GetErrorParameter(), parameter) << filter->GetClassName();
  const std::string reason = own->GetErrorReason();
  const std::string advice = own->GetErrorAdvice();
  const std::string text =
    (parameter.empty() ? "" : parameter + ": ") + reason + (advice.empty() ? "" : "; " + advice);
  EXPECT_NE(text.find(piece), std::string::npos) << filter->GetClassName() << " said: " << text;
  EXPECT_NE(listener.Errors.find(text), std::string::npos) << listener.Errors;
  ExpectEmptyOutputs(filter);
}

} // namespace filtertesting

#endif
