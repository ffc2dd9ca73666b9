// SPDX-License-Identifier: BSD-3-Clause
/// Messages of bits, stored as strings of the characters 0 and 1.
#ifndef SpectralWatermark_Core_Payload_Bits_h
#define SpectralWatermark_Core_Payload_Bits_h

#include "Core/Support/Types.h"

#include <string>

namespace spectralwatermark
{

/// Throws InvalidInput, about `parameter`, if the message contains a character other than 0 and 1.
/// An empty message passes.
void CheckMessage(const std::string& message, const std::string& parameter = "Message");

/// The number of positions where two messages agree. Positions past the end of the shorter one do
/// not count.
Index CountAgreements(const std::string& a, const std::string& b);

} // namespace spectralwatermark

#endif
