// SPDX-License-Identifier: BSD-3-Clause
/// What a reading proves: agreement with an expected message, weighed by how unmarked meshes read.
#ifndef SpectralWatermark_Core_PaperScheme_SlotDetection_h
#define SpectralWatermark_Core_PaperScheme_SlotDetection_h

#include "Core/PaperScheme/Slots.h"
#include "Core/Payload/BitAgreement.h"

namespace spectralwatermark
{

/// How slots of an unmarked mesh read. Without a key the bits are not fair coins: magnitudes are skewed and
/// fall along the spectrum, so that 0 is more likely. The bounds hold for 15 scans and all carrier positions
/// in slots of 10 (measured by Examples/Reproduction).
UnmarkedModel UnmarkedModelOf(const SlotOptions& options);

/// Log densities of a slot's carrier, relative to its references' average, in three cases: a mesh
/// marked with 0 or with 1 and then attacked, and an unmarked one.
///
/// The unmarked density is taken for normal. Embedding (eqs. 10 and 11) leaves the carriers that
/// are beyond a threshold on their bit's side and puts all others at the target; attacks then draw
/// them towards the mean with noise, and erase some altogether, which bounds what one slot can
/// say. All zero where a slot says nothing (an average of 0).
struct SlotLikelihood
{
  double Zero = 0.0;
  double One = 0.0;
  double Unmarked = 0.0;

  double Of(int bit) const { return bit == 1 ? this->One : this->Zero; }
};

SlotLikelihood LikelihoodOf(const SlotReading& reading, const SlotOptions& options);

/// The Neyman-Pearson statistic for "marked with this message" against "unmarked": the sum of
/// log densities' differences. Positive speaks for the mark.
double LogLikelihoodRatio(const std::vector<SlotReading>& readings, const SlotOptions& options,
  const std::string& expected);

/// The same for agreements weighed by their evidence: each counts as the difference between the
/// log densities of the bit that was read and of the other one. Given these weights, the bits of
/// an unmarked mesh are drawn as for AgreementPValue(); exact for weights rounded to 1/20000 of
/// their sum.
double WeightedAgreementPValue(const std::vector<SlotReading>& readings, const SlotOptions& options,
  const std::string& expected);

} // namespace spectralwatermark

#endif
