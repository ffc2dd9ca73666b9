// SPDX-License-Identifier: BSD-3-Clause
/// A row of a block as one value, for the innermost loops.
#ifndef SpectralWatermark_Core_LinearAlgebra_SimdRow_h
#define SpectralWatermark_Core_LinearAlgebra_SimdRow_h

// The widest instructions that the machine has are chosen when the library is loaded; sanitizers
// cannot run that early.
#ifdef __has_feature
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define CHOSEN_TOO_EARLY
#endif
#endif
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define CHOSEN_TOO_EARLY
#endif
#if defined(__x86_64__) && defined(__GNUC__) && !defined(CHOSEN_TOO_EARLY)
#define MULTIVERSIONED __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define MULTIVERSIONED
#endif

namespace spectralwatermark
{

/// Eight doubles. Aligned to a double only, as rows of any buffer are.
typedef double SimdRow __attribute__((vector_size(64), aligned(8), may_alias));

inline const SimdRow* SimdRows(const double* data)
{
  return reinterpret_cast<const SimdRow*>(data);
}
inline SimdRow* SimdRows(double* data)
{
  return reinterpret_cast<SimdRow*>(data);
}

} // namespace spectralwatermark

#endif
