// SPDX-License-Identifier: BSD-3-Clause
#include "Core/LinearAlgebra/MultifrontalLdlt.h"

#include "Core/LinearAlgebra/FrontalKernels.h"
#include "Core/Support/Parallel.h"

#include <algorithm>
#include <atomic>
#include <cmath>

namespace spectralwatermark
{

namespace
{

// Number of rows of a front that are processed as one task.
constexpr Index RowsPerTask = 64;

// Height from which a front is large enough for several threads.
constexpr Index LargeFront = 256;

} // namespace

MultifrontalLdlt::MultifrontalLdlt(const SparseMatrix& pattern)
  : Tree(FindSupernodes(pattern))
  , Place(pattern.nonZeros(), -1)
{
  std::vector<int> rowInFront(pattern.cols());
  for (const Supernode& node : this->Tree.Nodes)
  {
    const auto place = [&rowInFront](int row, int at) { rowInFront[row] = at; };
    for (int k = 0; k < node.Width; ++k)
    {
      place(node.First + k, k);
    }
    for (std::size_t k = 0; k < node.Below.size(); ++k)
    {
      place(node.Below[k], node.Width + static_cast<int>(k));
    }
    for (int j = node.First; j < node.First + node.Width; ++j)
    {
      for (int p = pattern.outerIndexPtr()[j]; p < pattern.outerIndexPtr()[j + 1]; ++p)
      {
        const int row = pattern.innerIndexPtr()[p];
        if (row >= j)
        {
          this->Place[p] = rowInFront[row];
        }
      }
    }
  }
}

bool MultifrontalLdlt::Factorize(const SparseMatrix& matrix, int threads)
{
  this->L.resize(static_cast<Index>(this->Tree.Entries));
  this->InverseD.resize(matrix.cols());
  std::vector<Front> fronts(this->Tree.Nodes.size());
  std::atomic<bool> sound{ true };
  ForEachTask(threads, static_cast<Index>(this->Tree.Groups.size()),
    [&](Index group)
    {
      for (const int s : this->Tree.Groups[group])
      {
        if (!sound || !this->Eliminate(s, matrix, fronts, 1))
        {
          sound = false;
          return;
        }
      }
    });
  for (const int s : this->Tree.Top)
  {
    sound = sound && this->Eliminate(s, matrix, fronts, threads);
  }
  return sound;
}

void MultifrontalLdlt::Assemble(const Supernode& node, const SparseMatrix& matrix,
  std::vector<Front>& fronts, Front& front) const
{
  const Index height = node.Height();
  // Each row is followed by seven more values, so that eight can be read from anywhere in it.
  front.Stride = height + 7;
  front.Values.assign(height * front.Stride, 0.0);
  double* values = front.Values.data();
  for (Index k = 0; k < node.Width; ++k)
  {
    const Index j = node.First + k;
    for (int p = matrix.outerIndexPtr()[j]; p < matrix.outerIndexPtr()[j + 1]; ++p)
    {
      if (const int row = this->Place[p]; row >= 0)
      {
        values[row * front.Stride + k] = matrix.valuePtr()[p];
      }
    }
  }
  for (const int c : node.Children)
  {
    const Supernode& child = this->Tree.Nodes[c];
    Front& update = fronts[c];
    AddFront(update.Values.data() + child.Width * (update.Stride + 1), update.Stride,
      child.InParent.data(), static_cast<Index>(child.InParent.size()), values, front.Stride);
    update = Front();
  }
}

bool MultifrontalLdlt::Eliminate(int s, const SparseMatrix& matrix, std::vector<Front>& fronts,
  int threads)
{
  const Supernode& node = this->Tree.Nodes[s];
  Front& front = fronts[s];
  this->Assemble(node, matrix, fronts, front);
  const Index height = node.Height();
  double* values = front.Values.data();
  double* inverseD = this->InverseD.data() + node.First;
  const int useful = height < LargeFront ? 1 : threads;
  for (Index first = 0; first < node.Width; first += PivotsAtOnce)
  {
    const Index count = std::min<Index>(PivotsAtOnce, node.Width - first);
    const Index next = first + count;
    PivotBlock pivots;
    if (!pivots.Factorize(values + first * (front.Stride + 1), front.Stride, count,
          inverseD + first))
    {
      return false;
    }
    ForEachTask(useful, (height - next + RowsPerTask - 1) / RowsPerTask,
      [&](Index task)
      {
        const Index begin = next + task * RowsPerTask;
        pivots.SolveRows(values + begin * front.Stride + first, front.Stride,
          std::min(RowsPerTask, height - begin));
      });
    ForEachTask(useful, (height - next + RowWidth - 1) / RowWidth,
      [&](Index task)
      {
        const Index column = next + task * RowWidth;
        pivots.SubtractProduct(values + column * front.Stride, front.Stride, first, column,
          height - column);
      });
  }
  double* l = this->L.data() + node.Offset;
  for (Index i = 0; i < height; ++i)
  {
    std::copy_n(values + i * front.Stride, node.Width, l + i * node.Width);
  }
  return true;
}

void MultifrontalLdlt::Solve(BlockVector& x, int threads) const
{
  const auto groups = static_cast<Index>(this->Tree.Groups.size());
  const auto factorOf = [this](const Supernode& node)
  {
    return SupernodeFactor{ this->L.data() + node.Offset, this->InverseD.data() + node.First,
      node.Width, node.Below.data(), static_cast<Index>(node.TopBegin),
      static_cast<Index>(node.Below.size()) };
  };
  MultiVector updates(this->Tree.Groups.size());
  ForEachTask(threads, groups,
    [&](Index k)
    {
      BlockVector& update = updates[k];
      update.setZero(this->Tree.TopRows, BlockWidth);
      for (const int s : this->Tree.Groups[k])
      {
        const Supernode& node = this->Tree.Nodes[s];
        SubstituteForward(factorOf(node), x.data() + BlockWidth * node.First, x.data(),
          this->Tree.TopRow.data(), update.data());
      }
    });

  for (const int s : this->Tree.Top)
  {
    const Supernode& node = this->Tree.Nodes[s];
    for (const BlockVector& update : updates)
    {
      x.middleRows(node.First, node.Width) +=
        update.middleRows(this->Tree.TopRow[node.First], node.Width);
    }
    // Nothing lies above the top, so all rows below are rows of x.
    SupernodeFactor factor = factorOf(node);
    factor.TopBegin = factor.BelowCount;
    SubstituteForward(factor, x.data() + BlockWidth * node.First, x.data(), nullptr, nullptr);
  }
  for (auto s = this->Tree.Top.rbegin(); s != this->Tree.Top.rend(); ++s)
  {
    const Supernode& node = this->Tree.Nodes[*s];
    SubstituteBack(factorOf(node), x.data() + BlockWidth * node.First, x.data());
  }
  ForEachTask(threads, groups,
    [&](Index k)
    {
      const std::vector<int>& members = this->Tree.Groups[k];
      for (auto s = members.rbegin(); s != members.rend(); ++s)
      {
        const Supernode& node = this->Tree.Nodes[*s];
        SubstituteBack(factorOf(node), x.data() + BlockWidth * node.First, x.data());
      }
    });
}

} // namespace spectralwatermark
