// SPDX-License-Identifier: BSD-3-Clause
/// Progress reports of nested computations, and their abort.
#ifndef SpectralWatermark_Core_Support_Progress_h
#define SpectralWatermark_Core_Support_Progress_h

#include "Core/Support/Errors.h"

#include <algorithm>
#include <functional>
#include <utility>

namespace spectralwatermark
{

/// Reports how far a computation is, and stops it when the listener asks for that.
///
/// A computation reports fractions of its own work, from 0 to 1. Its caller passes it a Part() of
/// the caller's range, so that nested computations add up. The reported fraction never decreases
/// as long as every level reports in order.
class Progress
{
public:
  /// Receives the fraction done, in [0, 1]; returns false to ask for a stop.
  using Callback = std::function<bool(double)>;

  Progress() = default;
  explicit Progress(Callback callback)
    : Listener(std::move(callback))
  {
  }

  /// Passes the fraction to the listener. Throws Aborted when it asks for a stop.
  void Report(double fraction) const
  {
    const double clamped = std::min(1.0, std::max(0.0, fraction));
    if (this->Listener && !this->Listener(this->Begin + clamped * (this->End - this->Begin)))
    {
      throw Aborted();
    }
  }

  /// The part of this range from `begin` to `end` (fractions of it), as a range of its own.
  Progress Part(double begin, double end) const
  {
    Progress part(*this);
    part.Begin = this->Begin + begin * (this->End - this->Begin);
    part.End = this->Begin + end * (this->End - this->Begin);
    return part;
  }

private:
  Callback Listener;
  double Begin = 0.0;
  double End = 1.0;
};

} // namespace spectralwatermark

#endif
