// SPDX-License-Identifier: BSD-3-Clause
/// What the tests of the Core share.
#ifndef SpectralWatermark_Testing_CoreTesting_h
#define SpectralWatermark_Testing_CoreTesting_h

#include "Core/Support/Errors.h"

#include <gtest/gtest.h>

#include <string>

namespace coretesting
{

/// What a call says when it throws InvalidInput.
template <typename Call>
std::string RefusalOf(const Call& call)
{
  try
  {
    call();
  }
  catch (const spectralwatermark::InvalidInput& error)
  {
    return error.what();
  }
  return "not refused";
}

/// That a call throws InvalidInput, and that its text has this piece.
template <typename Call>
void ExpectRefusal(const Call& call, const std::string& piece)
{
  const std::string text = RefusalOf(call);
  EXPECT_NE(text.find(piece), std::string::npos) << text;
}

} // namespace coretesting

#endif
