// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Payload/Bits.h"

#include "Core/Support/Errors.h"

#include <algorithm>

namespace spectralwatermark
{

void CheckMessage(const std::string& message, const std::string& parameter)
{
  const std::size_t wrong = message.find_first_not_of("01");
  if (wrong != std::string::npos)
  {
    throw InvalidInput(parameter,
      "the message \"" + message + "\" has a character other than 0 and 1 at position " +
        std::to_string(wrong + 1),
      "write the bits, such as \"10110\"");
  }
}

Index CountAgreements(const std::string& a, const std::string& b)
{
  Index agreements = 0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
  {
    agreements += a[i] == b[i] ? 1 : 0;
  }
  return agreements;
}

} // namespace spectralwatermark
