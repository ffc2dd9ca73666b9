// SPDX-License-Identifier: BSD-3-Clause
/// A row of a panel as one value, for the innermost loops.
#ifndef SpectralWatermark_Core_PanelRows_h
#define SpectralWatermark_Core_PanelRows_h

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
#define WIDEST_INSTRUCTIONS                                                                        \
  __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define WIDEST_INSTRUCTIONS
#endif

namespace spectralwatermark
{

/// Eight doubles. Aligned to a double only, as rows of any buffer are.
typedef double Row __attribute__((vector_size(64), aligned(8), may_alias));

inline const Row* Rows(const double* data)
{
  return reinterpret_cast<const Row*>(data);
}
inline Row* Rows(double* data)
{
  return reinterpret_cast<Row*>(data);
}

} // namespace spectralwatermark

#endif
