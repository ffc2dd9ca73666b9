// SPDX-License-Identifier: BSD-3-Clause
/// The dense loops of the multifrontal method. Matrices are stored by rows and given as a pointer
/// to the first value and the distance from one row to the next (`stride`).
#ifndef SpectralWatermark_Core_LinearAlgebra_FrontalKernels_h
#define SpectralWatermark_Core_LinearAlgebra_FrontalKernels_h

#include "Core/Support/Types.h"

#include <Eigen/Core>

namespace spectralwatermark
{

/// The number of columns that a loop processes as one SimdRow.
constexpr Index RowWidth = 8;

/// The largest number of pivots that are eliminated together.
constexpr Index PivotsAtOnce = 32;

/// A few pivots that are eliminated together.
class PivotBlock
{
public:
  /// Factorises the diagonal block into L D L^T, in place (the ones of L are not written). Returns
  /// false when a pivot is zero or not a number.
  bool Factorize(double* block, Index stride, Index count, double* inverseD);

  /// Replaces rows under the block by those of L.
  void SolveRows(double* rows, Index stride, Index count) const;

  /// Subtracts L D L^T from columns `column` to `column` + 7 of `count` rows. L is in the columns
  /// from `first` on. `row` points to the row whose number is `column`.
  void SubtractProduct(double* row, Index stride, Index first, Index column, Index count) const;

private:
  Index Count = 0;
  double D[PivotsAtOnce];
  double InverseD[PivotsAtOnce];
  double Upper[PivotsAtOnce * PivotsAtOnce]; // L^T without its diagonal
};

/// A(place[i], place[j]) += B(i, j) for the lower triangle of B, with `place` ascending.
void AddFront(const double* b, Index bStride, const int* place, Index count, double* a,
  Index aStride);

/// The part of L and D that belongs to one supernode.
struct SupernodeFactor
{
  const double* L;        ///< L by rows: the supernode's own rows, then those below
  const double* InverseD; ///< the inverse of each of its pivots
  Index Width;            ///< number of its columns
  const int* Below;       ///< the rows below it, ascending
  Index TopBegin;         ///< position in Below of the first row that lies in the top of the tree
  Index BelowCount;       ///< number of rows below it
};

/// Forward substitution: eliminates the supernode's rows `own` from the rows below. These are the
/// rows Below[k] of `x`, or the rows topRow[Below[k]] of `top` for those in the top of the tree.
void SubstituteForward(const SupernodeFactor& factor, double* own, double* x, const int* topRow,
  double* top);

/// Back substitution: computes the solution's rows `own` once the rows below are known.
void SubstituteBack(const SupernodeFactor& factor, double* own, const double* x);

} // namespace spectralwatermark

#endif
