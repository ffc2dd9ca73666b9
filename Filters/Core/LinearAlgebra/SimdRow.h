// SPDX-License-Identifier: BSD-3-Clause
/// A row of eight doubles as one value, for the innermost loops.
#ifndef SpectralWatermark_Core_LinearAlgebra_SimdRow_h
#define SpectralWatermark_Core_LinearAlgebra_SimdRow_h

// A function marked MULTIVERSIONED is compiled for several instruction sets. The widest one that
// the machine has is chosen when the library is loaded, which is too early for sanitizers to run.
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

/// Eight doubles, aligned only as a double is, so that a row may lie anywhere in a buffer.
typedef double SimdRow __attribute__((vector_size(64), aligned(8), may_alias));

/// The rows of a buffer of doubles.
inline const SimdRow* SimdRows(const double* data)
{
  return reinterpret_cast<const SimdRow*>(data);
}

/// The rows of a buffer of doubles.
inline SimdRow* SimdRows(double* data)
{
  return reinterpret_cast<SimdRow*>(data);
}

} // namespace spectralwatermark

#endif
