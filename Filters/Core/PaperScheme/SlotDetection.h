// SPDX-License-Identifier: BSD-3-Clause
/// The evidence that a reading of the paper's scheme gives for an expected message: likelihoods and
/// p-values.
#ifndef SpectralWatermark_Core_PaperScheme_SlotDetection_h
#define SpectralWatermark_Core_PaperScheme_SlotDetection_h

#include "Core/PaperScheme/Slots.h"
#include "Core/Payload/BitAgreement.h"

namespace spectralwatermark
{

/// How likely each bit is in a slot of an unmarked mesh. Without a secret key the bits are not fair
/// coins: magnitudes are skewed and fall along the spectrum, so that 0 is more likely. The bounds
/// hold for 15 scans and all carrier positions in slots of 10 (measured by Examples/Reproduction).
UnmarkedModel UnmarkedModelOf(const SlotOptions& options);

/// The logarithms of the probability density of a slot's carrier, relative to the average of its
/// references, in three cases: in a mesh marked with 0 or with 1 and then attacked, and in an
/// unmarked mesh.
///
/// The unmarked density is taken for normal. Embedding (eqs. 10 and 11) leaves the carriers that
/// are beyond a threshold on the side of their bit, and moves all others to the target. Attacks
/// then draw the carriers towards the mean and add noise; they erase some altogether, which bounds
/// the evidence of a single slot.
struct SlotLikelihood
{
  double Zero = 0.0;     ///< marked with 0
  double One = 0.0;      ///< marked with 1
  double Unmarked = 0.0; ///< not marked

  /// The logarithm for a mesh marked with `bit`, 0 or 1.
  double Of(int bit) const { return bit == 1 ? this->One : this->Zero; }
};

/// The likelihoods of one slot. All are zero if the average of the references is 0, because the
/// slot then holds no evidence.
SlotLikelihood LikelihoodOf(const SlotReading& reading, const SlotOptions& options);

/// The Neyman-Pearson statistic for "marked with this message" against "unmarked": the natural
/// logarithm of the likelihood ratio, summed over the slots. A positive value speaks for the mark.
/// `expected` has a bit for each reading.
double LogLikelihoodRatio(const std::vector<SlotReading>& readings, const SlotOptions& options,
  const std::string& expected);

/// The p-value of the agreement with `expected`, with each slot weighted by its evidence: the
/// log-likelihood of the bit that was read minus that of the other bit. Conditioned on these
/// weights, the bits of an unmarked mesh are distributed as in AgreementPValue(). The result is
/// exact for the weights rounded to multiples of 1/20000 of their sum.
double WeightedAgreementPValue(const std::vector<SlotReading>& readings, const SlotOptions& options,
  const std::string& expected);

} // namespace spectralwatermark

#endif
