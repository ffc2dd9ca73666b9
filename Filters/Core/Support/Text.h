// SPDX-License-Identifier: BSD-3-Clause
/// Text with numbers in a chosen format, for messages.
#ifndef SpectralWatermark_Core_Support_Text_h
#define SpectralWatermark_Core_Support_Text_h

#include <iomanip>
#include <sstream>
#include <string>

namespace spectralwatermark
{

/// The parts as a stream writes them one after another. Manipulators such as std::setprecision()
/// are parts too.
template <typename... Parts>
std::string TextOf(const Parts&... parts)
{
  std::ostringstream text;
  ((text << parts), ...);
  return text.str();
}

} // namespace spectralwatermark

#endif
