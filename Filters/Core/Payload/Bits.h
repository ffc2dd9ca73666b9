// SPDX-License-Identifier: BSD-3-Clause
/// Messages: strings of the characters 0 and 1.
#ifndef SpectralWatermark_Core_Payload_Bits_h
#define SpectralWatermark_Core_Payload_Bits_h

#include "Core/Support/Types.h"

#include <string>

namespace spectralwatermark
{

/// Throws InvalidInput, about `parameter`, unless the message is made of 0 and 1 only.
void CheckMessage(const std::string& message, const std::string& parameter = "Message");

/// The number of positions where two messages of the same length agree.
Index CountAgreements(const std::string& a, const std::string& b);

} // namespace spectralwatermark

#endif
