// SPDX-License-Identifier: BSD-3-Clause
#include "Substitution.h"

#include "PanelRows.h"
#include "Parallel.h"

#include <algorithm>
#include <queue>

namespace spectralwatermark
{

using Eigen::Index;

namespace
{

// More than there are threads as a rule, so that they finish together; each costs a pass over the
// rows above.
constexpr std::size_t NumberOfGroups = 8;

// A subtree of at most this part of all work is not divided further.
constexpr double LargestSubtree = 1.0 / 16.0;

struct Factor
{
  const int* Outer;
  const int* Inner;
  const double* Value;
  const double* InverseD;
};

} // namespace

// Updates of rows above the subtree are collected apart.
WIDEST_INSTRUCTIONS void EliminateColumns(const int* columns, Index count, const Factor& l,
  const int* topBegin, const int* topIndex, double* x, double* top)
{
  for (Index k = 0; k < count; ++k)
  {
    const int j = columns[k];
    const Row xj = Rows(x)[j];
    const int end = l.Outer[j + 1];
    int p = l.Outer[j];
    for (; p < topBegin[j]; ++p)
    {
      Rows(x)[l.Inner[p]] -= l.Value[p] * xj;
    }
    for (; p < end; ++p)
    {
      Rows(top)[topIndex[l.Inner[p]]] -= l.Value[p] * xj;
    }
  }
}

WIDEST_INSTRUCTIONS void SubstituteBack(const int* columns, Index count, const Factor& l, double* x)
{
  for (Index k = count - 1; k >= 0; --k)
  {
    const int j = columns[k];
    Row sum = l.InverseD[j] * Rows(x)[j];
    for (int p = l.Outer[j]; p < l.Outer[j + 1]; ++p)
    {
      sum -= l.Value[p] * Rows(x)[l.Inner[p]];
    }
    Rows(x)[j] = sum;
  }
}

namespace
{

// The elimination tree: the first row of a column is its parent. -1 at a root.
std::vector<int> Parents(const Eigen::SparseMatrix<double>& l)
{
  std::vector<int> parent(static_cast<std::size_t>(l.cols()), -1);
  for (Index j = 0; j < l.cols(); ++j)
  {
    if (l.outerIndexPtr()[j] < l.outerIndexPtr()[j + 1])
    {
      parent[static_cast<std::size_t>(j)] = l.innerIndexPtr()[l.outerIndexPtr()[j]];
    }
  }
  return parent;
}

// Entries of L in each subtree. Parents come after their children.
std::vector<double> SubtreeWeights(const Eigen::SparseMatrix<double>& l,
  const std::vector<int>& parent)
{
  std::vector<double> weight(parent.size());
  for (std::size_t j = 0; j < parent.size(); ++j)
  {
    weight[j] += 1.0 + l.outerIndexPtr()[j + 1] - l.outerIndexPtr()[j];
    if (parent[j] >= 0)
    {
      weight[static_cast<std::size_t>(parent[j])] += weight[j];
    }
  }
  return weight;
}

// Roots of disjoint subtrees, the heaviest first: from the whole tree down, the heaviest is divided
// into its children until it is light enough.
std::vector<int> DivideTree(const std::vector<int>& parent, const std::vector<double>& weight)
{
  std::vector<std::vector<int>> children(parent.size());
  const auto lighter = [&weight](int a, int b)
  {
    const double difference =
      weight[static_cast<std::size_t>(a)] - weight[static_cast<std::size_t>(b)];
    return difference < 0.0 || (difference == 0.0 && a > b);
  };
  std::priority_queue<int, std::vector<int>, decltype(lighter)> subtrees(lighter);
  double total = 0.0;
  for (std::size_t j = 0; j < parent.size(); ++j)
  {
    if (parent[j] >= 0)
    {
      children[static_cast<std::size_t>(parent[j])].push_back(static_cast<int>(j));
    }
    else
    {
      subtrees.push(static_cast<int>(j));
      total += weight[j];
    }
  }
  while (
    !subtrees.empty() && weight[static_cast<std::size_t>(subtrees.top())] > LargestSubtree * total)
  {
    const auto heaviest = static_cast<std::size_t>(subtrees.top());
    subtrees.pop();
    for (const int child : children[heaviest])
    {
      subtrees.push(child);
    }
  }
  std::vector<int> roots;
  for (; !subtrees.empty(); subtrees.pop())
  {
    roots.push_back(subtrees.top());
  }
  return roots;
}

} // namespace

Substitution::Substitution(const Eigen::SparseMatrix<double>& l)
{
  const std::vector<int> parent = Parents(l);
  const std::vector<double> weight = SubtreeWeights(l, parent);
  std::vector<int> groupOfRoot(parent.size(), -1);
  std::vector<double> load(NumberOfGroups, 0.0);
  for (const int root : DivideTree(parent, weight))
  {
    const auto lightest = std::min_element(load.begin(), load.end());
    *lightest += weight[static_cast<std::size_t>(root)];
    groupOfRoot[static_cast<std::size_t>(root)] = static_cast<int>(lightest - load.begin());
  }
  this->PlaceColumns(parent, groupOfRoot);

  this->TopBegin.resize(parent.size());
  for (std::size_t j = 0; j < parent.size(); ++j)
  {
    int p = l.outerIndexPtr()[j];
    while (p < l.outerIndexPtr()[j + 1] &&
      this->TopIndex[static_cast<std::size_t>(l.innerIndexPtr()[p])] < 0)
    {
      ++p;
    }
    this->TopBegin[j] = p;
  }
}

// A column belongs to the group of the subtree that it is in, or to the top.
void Substitution::PlaceColumns(const std::vector<int>& parent, const std::vector<int>& groupOfRoot)
{
  this->Groups.resize(NumberOfGroups);
  this->TopIndex.assign(parent.size(), -1);
  std::vector<int> group(groupOfRoot);
  for (std::size_t j = parent.size(); j-- > 0;)
  {
    if (group[j] < 0 && parent[j] >= 0)
    {
      group[j] = group[static_cast<std::size_t>(parent[j])];
    }
  }
  for (std::size_t j = 0; j < parent.size(); ++j)
  {
    if (group[j] >= 0)
    {
      this->Groups[static_cast<std::size_t>(group[j])].push_back(static_cast<int>(j));
    }
    else
    {
      this->TopIndex[j] = static_cast<int>(this->Top.size());
      this->Top.push_back(static_cast<int>(j));
    }
  }
}

void Substitution::Solve(const Eigen::SparseMatrix<double>& l, const Eigen::VectorXd& inverseD,
  Panel& x, int threads) const
{
  const Factor factor{ l.outerIndexPtr(), l.innerIndexPtr(), l.valuePtr(), inverseD.data() };
  const auto topCount = static_cast<Index>(this->Top.size());
  const auto groups = static_cast<Index>(this->Groups.size());
  Panels updates(this->Groups.size());
  ForEachTask(threads, groups,
    [&](Index k)
    {
      const Columns& columns = this->Groups[static_cast<std::size_t>(k)];
      Panel& update = updates[static_cast<std::size_t>(k)];
      update.setZero(topCount, PanelWidth);
      EliminateColumns(columns.data(), static_cast<Index>(columns.size()), factor,
        this->TopBegin.data(), this->TopIndex.data(), x.data(), update.data());
    });

  for (Index i = 0; i < topCount; ++i)
  {
    const int row = this->Top[static_cast<std::size_t>(i)];
    for (const Panel& update : updates)
    {
      x.row(row) += update.row(i);
    }
  }
  // Nothing lies above the top: its columns' ends stand for where the rows above begin.
  EliminateColumns(this->Top.data(), topCount, factor, factor.Outer + 1, nullptr, x.data(),
    nullptr);
  SubstituteBack(this->Top.data(), topCount, factor, x.data());
  ForEachTask(threads, groups,
    [&](Index k)
    {
      const Columns& columns = this->Groups[static_cast<std::size_t>(k)];
      SubstituteBack(columns.data(), static_cast<Index>(columns.size()), factor, x.data());
    });
}

} // namespace spectralwatermark
