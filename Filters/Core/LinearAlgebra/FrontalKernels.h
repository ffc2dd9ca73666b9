// SPDX-License-Identifier: BSD-3-Clause
/// The dense loops of the multifrontal method. Matrices are given by rows: a pointer to the first
/// value, and the distance from one row to the next.
#ifndef SpectralWatermark_Core_LinearAlgebra_FrontalKernels_h
#define SpectralWatermark_Core_LinearAlgebra_FrontalKernels_h

#include "Core/Support/Types.h"

#include <Eigen/Core>

namespace spectralwatermark
{

constexpr Index RowWidth = 8;
constexpr Index PivotsAtOnce = 32;

/// Some pivots that are eliminated together.
class PivotBlock
{
public:
  /// L D L^T of the block on the diagonal, in place (L's ones are not written). False when a pivot
  /// is zero or not a number.
  bool Factorize(double* block, Index stride, Index count, double* inverseD);

  /// What L has in rows under the block.
  void SolveRows(double* rows, Index stride, Index count) const;

  /// Of the rows from `row` on, columns `column` to `column` + 7: minus L D L^T, with L in the
  /// columns from `first` on. The row at `row` is the one whose number is `column`.
  void SubtractProduct(double* row, Index stride, Index first, Index column, Index count) const;

private:
  Index Count = 0;
  double D[PivotsAtOnce];
  double InverseD[PivotsAtOnce];
  double Upper[PivotsAtOnce * PivotsAtOnce]; // L^T without its diagonal
};

/// A(place[i], place[j]) += B(i, j) for the lower triangle of B; `place` ascends.
void AddFront(const double* b, Index bStride, const int* place, Index count, double* a,
  Index aStride);

/// The part of L and D that belongs to one supernode.
struct SupernodeFactor
{
  const double* L; ///< by rows: its own, then those below
  const double* InverseD;
  Index Width;
  const int* Below;
  Index TopBegin; ///< from this one of Below on, rows lie in the top of the tree
  Index BelowCount;
};

/// Eliminates the supernode's rows `own` from the rows below, which are rows Below of x, or topRow
/// of Below of `top` for those in the top.
void SubstituteForward(const SupernodeFactor& factor, double* own, double* x, const int* topRow,
  double* top);

/// The solution's rows `own`, once those below are known.
void SubstituteBack(const SupernodeFactor& factor, double* own, const double* x);

} // namespace spectralwatermark

#endif
