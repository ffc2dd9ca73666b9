// SPDX-License-Identifier: BSD-3-Clause
#include "Core/LinearAlgebra/FrontalKernels.h"

#include "Core/LinearAlgebra/SimdRow.h"

#include <algorithm>
#include <cmath>

namespace spectralwatermark
{

namespace
{

#define ALWAYS_INLINE inline __attribute__((always_inline))

// Multiplies a few rows of L, each `depth` long, by `depth` rows of eight. The rows are few enough
// for the sums to stay in registers, provided that the loops are unrolled.
template <int Count>
ALWAYS_INLINE void MultiplyFewRows(const double* l, Index stride, Index depth, const double* eights,
  SimdRow* products)
{
  SimdRow sum[Count] = {};
  for (Index k = 0; k < depth; ++k)
  {
    const SimdRow right = SimdRows(eights)[k];
#pragma GCC unroll 8
    for (int i = 0; i < Count; ++i)
    {
      sum[i] += l[i * stride + k] * right;
    }
  }
#pragma GCC unroll 8
  for (int i = 0; i < Count; ++i)
  {
    products[i] = sum[i];
  }
}

template <int Count>
ALWAYS_INLINE void SubtractRows(double* rows, Index stride, const double* l, Index depth,
  const double* packed)
{
  SimdRow products[Count];
  MultiplyFewRows<Count>(l, stride, depth, packed, products);
#pragma GCC unroll 8
  for (int i = 0; i < Count; ++i)
  {
    *SimdRows(rows + i * stride) -= products[i];
  }
}

} // namespace

MULTIVERSIONED bool FactorizePivots(double* block, Index stride, Index count, double* d,
  double* inverseD, double* upper)
{
  constexpr Index most = PivotsAtOnce;
  std::fill_n(upper, most * most, 0.0);
  double column[most];
  for (Index k = 0; k < count; ++k)
  {
    d[k] = block[k * stride + k];
    inverseD[k] = 1.0 / d[k];
    if (d[k] == 0.0 || !std::isfinite(d[k]) || !std::isfinite(inverseD[k]))
    {
      return false;
    }
    for (Index i = k + 1; i < count; ++i)
    {
      column[i] = block[i * stride + k];
      const double l = column[i] * inverseD[k];
      block[i * stride + k] = l;
      upper[k * most + i] = l;
      for (Index j = k + 1; j <= i; ++j)
      {
        block[i * stride + j] -= l * column[j];
      }
    }
  }
  return true;
}

// The row y of L D follows from the row a of the matrix by y_j = a_j - sum over k < j of y_k L_jk.
MULTIVERSIONED void SolveFrontRows(double* rows, Index stride, Index rowCount, Index count,
  const double* upper, const double* inverseD)
{
  double y[PivotsAtOnce] = {};
  const Index strips = (count + RowWidth - 1) / RowWidth;
  for (Index i = 0; i < rowCount; ++i, rows += stride)
  {
    std::copy_n(rows, count, y);
    for (Index k = 0; k + 1 < count; ++k)
    {
      const double yk = y[k];
      for (Index strip = k / RowWidth; strip < strips; ++strip)
      {
        SimdRows(y)[strip] -= yk * SimdRows(upper + k * PivotsAtOnce)[strip];
      }
    }
    for (Index k = 0; k < count; ++k)
    {
      rows[k] = y[k] * inverseD[k];
    }
  }
}

MULTIVERSIONED void SubtractStrip(double* row, Index stride, Index first, Index column, Index count,
  Index depth, const double* d)
{
  double packed[PivotsAtOnce * RowWidth];
  const Index width = std::min(RowWidth, count);
  for (Index k = 0; k < depth; ++k)
  {
    for (Index j = 0; j < RowWidth; ++j)
    {
      packed[k * RowWidth + j] = j < width ? d[k] * row[j * stride + first + k] : 0.0;
    }
  }
  Index i = 0;
  for (; i + 4 <= count; i += 4)
  {
    double* at = row + i * stride;
    SubtractRows<4>(at + column, stride, at + first, depth, packed);
  }
  for (; i < count; ++i)
  {
    double* at = row + i * stride;
    SubtractRows<1>(at + column, stride, at + first, depth, packed);
  }
}

MULTIVERSIONED void AddFront(const double* b, Index bStride, const int* place, Index count,
  double* a, Index aStride)
{
  for (Index i = 0; i < count; ++i)
  {
    double* row = a + place[i] * aStride;
    const double* from = b + i * bStride;
    for (Index j = 0; j <= i; ++j)
    {
      row[place[j]] += from[j];
    }
  }
}

namespace
{

// Subtracts L times the first `depth` of a supernode's own rows from other rows, own or below.
template <int Count>
ALWAYS_INLINE void Forward(const double* l, Index width, Index depth, const double* own,
  SimdRow* const* to)
{
  SimdRow products[Count];
  MultiplyFewRows<Count>(l, width, depth, own, products);
#pragma GCC unroll 8
  for (int i = 0; i < Count; ++i)
  {
    *to[i] -= products[i];
  }
}

template <int Count>
ALWAYS_INLINE void ForwardOwn(const double* l, Index width, Index begin, double* own)
{
  SimdRow* to[Count];
#pragma GCC unroll 8
  for (int i = 0; i < Count; ++i)
  {
    to[i] = SimdRows(own) + begin + i;
  }
  Forward<Count>(l + begin * width, width, begin, own, to);
#pragma GCC unroll 8
  for (int i = 1; i < Count; ++i)
  {
    for (int k = 0; k < i; ++k)
    {
      *to[i] -= l[(begin + i) * width + begin + k] * *to[k];
    }
  }
}

// Back substitution for rows `begin` to `begin` + Count - 1, once the rows after them are known.
template <int Count>
ALWAYS_INLINE void Backward(const SupernodeFactor& factor, Index begin, double* own,
  const double* x)
{
  const Index width = factor.Width;
  const double* l = factor.L + begin;
  SimdRow sum[Count] = {};
  for (Index i = begin + Count; i < width; ++i)
  {
    const SimdRow right = SimdRows(own)[i];
#pragma GCC unroll 8
    for (int k = 0; k < Count; ++k)
    {
      sum[k] += l[i * width + k] * right;
    }
  }
  for (Index i = 0; i < factor.BelowCount; ++i)
  {
    const SimdRow right = SimdRows(x)[factor.Below[i]];
#pragma GCC unroll 8
    for (int k = 0; k < Count; ++k)
    {
      sum[k] += l[(width + i) * width + k] * right;
    }
  }
#pragma GCC unroll 8
  for (int k = Count - 1; k >= 0; --k)
  {
    SimdRow solution = factor.InverseD[begin + k] * SimdRows(own)[begin + k] - sum[k];
    for (int i = k + 1; i < Count; ++i)
    {
      solution -= l[(begin + i) * width + k] * SimdRows(own)[begin + i];
    }
    SimdRows(own)[begin + k] = solution;
  }
}

} // namespace

MULTIVERSIONED void SubstituteForward(const SupernodeFactor& factor, double* own, double* x,
  const int* topRow, double* top)
{
  const Index width = factor.Width;
  Index i = 0;
  for (; i + 4 <= width; i += 4)
  {
    ForwardOwn<4>(factor.L, width, i, own);
  }
  for (; i < width; ++i)
  {
    ForwardOwn<1>(factor.L, width, i, own);
  }
  const double* l = factor.L + width * width;
  const auto target = [&](Index k)
  {
    const int row = factor.Below[k];
    return k < factor.TopBegin ? SimdRows(x) + row : SimdRows(top) + topRow[row];
  };
  for (i = 0; i + 4 <= factor.BelowCount; i += 4)
  {
    SimdRow* const to[] = { target(i), target(i + 1), target(i + 2), target(i + 3) };
    Forward<4>(l + i * width, width, width, own, to);
  }
  for (; i < factor.BelowCount; ++i)
  {
    SimdRow* const to[] = { target(i) };
    Forward<1>(l + i * width, width, width, own, to);
  }
}

MULTIVERSIONED void SubstituteBack(const SupernodeFactor& factor, double* own, const double* x)
{
  Index end = factor.Width;
  for (; end >= 4; end -= 4)
  {
    Backward<4>(factor, end - 4, own, x);
  }
  switch (end)
  {
    case 3:
      Backward<3>(factor, 0, own, x);
      break;
    case 2:
      Backward<2>(factor, 0, own, x);
      break;
    case 1:
      Backward<1>(factor, 0, own, x);
      break;
    default:
      break;
  }
}

bool PivotBlock::Factorize(double* block, Index stride, Index count, double* inverseD)
{
  this->Count = count;
  const bool sound = FactorizePivots(block, stride, count, this->D, this->InverseD, this->Upper);
  std::copy_n(this->InverseD, count, inverseD);
  return sound;
}

void PivotBlock::SolveRows(double* rows, Index stride, Index count) const
{
  SolveFrontRows(rows, stride, count, this->Count, this->Upper, this->InverseD);
}

void PivotBlock::SubtractProduct(double* row, Index stride, Index first, Index column,
  Index count) const
{
  SubtractStrip(row, stride, first, column, count, this->Count, this->D);
}

} // namespace spectralwatermark
