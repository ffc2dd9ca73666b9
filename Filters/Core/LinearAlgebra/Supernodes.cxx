// SPDX-License-Identifier: BSD-3-Clause
#include "Core/LinearAlgebra/Supernodes.h"

#include <algorithm>
#include <numeric>
#include <queue>

namespace spectralwatermark
{

namespace
{

// Number of groups of subtrees. It usually exceeds the number of threads, so that they finish at
// about the same time; each group costs a pass over the rows of the top.
constexpr std::size_t NumberOfGroups = 8;

// Largest share of the total work that a subtree may have without being divided further.
constexpr double LargestSubtree = 1.0 / 8.0;

// Width up to which supernodes are merged no matter how many zeros that adds: dense loops over a
// few more columns cost less than another front.
constexpr int AlwaysMerged = 8;

// Largest share of zeros among the entries of a wider supernode that is merged.
constexpr double ZerosAllowed = 0.08;

struct EliminationTree
{
  std::vector<int> Parent; // the parent of each column; -1 at a root
  std::vector<int> Count;  // entries of each column of L, the diagonal included
};

// Builds the tree row by row. Row k of L has an entry in every column on the paths that lead, in
// the tree, from the entries of row k of the matrix up to k.
EliminationTree BuildTree(const SparseMatrix& pattern)
{
  const Index size = pattern.cols();
  EliminationTree tree{ std::vector<int>(size, -1), std::vector<int>(size, 1) };
  std::vector<int> visited(size, -1);
  for (int k = 0; k < size; ++k)
  {
    visited[k] = k;
    for (SparseMatrix::InnerIterator entry(pattern, k); entry && entry.row() < k; ++entry)
    {
      for (Index i = entry.row(); visited[i] != k; i = tree.Parent[i])
      {
        visited[i] = k;
        ++tree.Count[i];
        if (tree.Parent[i] < 0)
        {
          tree.Parent[i] = k;
        }
      }
    }
  }
  return tree;
}

// The children of every column, and the roots in a last list.
std::vector<std::vector<int>> ChildrenOf(const EliminationTree& tree)
{
  const auto size = static_cast<int>(tree.Parent.size());
  std::vector<std::vector<int>> children(size + 1);
  for (int j = 0; j < size; ++j)
  {
    const bool isRoot = tree.Parent[j] < 0;
    children[isRoot ? size : tree.Parent[j]].push_back(j);
  }
  for (std::vector<int>& siblings : children)
  {
    std::stable_sort(siblings.begin(), siblings.end(),
      [&tree](int a, int b) { return tree.Count[a] < tree.Count[b]; });
  }
  return children;
}

// The fundamental supernodes: in each, a column's parent is the next column, which has one row
// fewer.
std::vector<Supernode> FundamentalSupernodes(const EliminationTree& tree)
{
  std::vector<Supernode> nodes;
  const auto size = static_cast<int>(tree.Parent.size());
  for (int j = 0; j < size; ++j)
  {
    const bool continues =
      j > 0 && tree.Parent[j - 1] == j && tree.Count[j - 1] == tree.Count[j] + 1;
    if (!continues)
    {
      nodes.emplace_back();
      nodes.back().First = j;
    }
    ++nodes.back().Width;
  }
  return nodes;
}

// Merges a supernode with its parent where the two are adjacent and that adds few zeros.
std::vector<Supernode> MergeSupernodes(const std::vector<Supernode>& nodes,
  const EliminationTree& tree)
{
  std::vector<Supernode> merged;
  std::vector<double> zeros; // the number of zeros in each of `merged`
  for (Supernode node : nodes)
  {
    const int below = tree.Count[node.First] - node.Width;
    double nodeZeros = 0.0;
    while (!merged.empty())
    {
      const Supernode& child = merged.back();
      const int last = child.First + child.Width - 1;
      const int parent = tree.Parent[last];
      if (parent < node.First || parent >= node.First + node.Width)
      {
        break;
      }
      const int width = child.Width + node.Width;
      const double more =
        static_cast<double>(child.Width) * (node.Width + below + 1 - tree.Count[last]);
      const double entries = static_cast<double>(width) * (below + 0.5 * width);
      const double all = nodeZeros + zeros.back() + more;
      if (width > AlwaysMerged && all > ZerosAllowed * entries)
      {
        break;
      }
      node.First = child.First;
      node.Width = width;
      nodeZeros = all;
      merged.pop_back();
      zeros.pop_back();
    }
    merged.push_back(std::move(node));
    zeros.push_back(nodeZeros);
  }
  return merged;
}

// Finds the rows below each supernode, which are those of its columns in the matrix and those of
// its children, and from them the parents and children.
void FindRows(const SparseMatrix& pattern, std::vector<Supernode>& nodes)
{
  const Index size = pattern.cols();
  const auto count = static_cast<int>(nodes.size());
  std::vector<int> nodeOf(size);
  std::vector<int> marked(size, -1);
  std::vector<int> place(size);
  for (int s = 0; s < count; ++s)
  {
    std::fill_n(nodeOf.begin() + nodes[s].First, nodes[s].Width, s);
  }
  for (int s = 0; s < count; ++s)
  {
    Supernode& node = nodes[s];
    const int end = node.First + node.Width;
    const auto add = [&](int row)
    {
      if (row >= end && marked[row] != s)
      {
        marked[row] = s;
        node.Below.push_back(row);
      }
    };
    for (int j = node.First; j < end; ++j)
    {
      for (SparseMatrix::InnerIterator entry(pattern, j); entry; ++entry)
      {
        add(static_cast<int>(entry.row()));
      }
    }
    for (const int child : node.Children)
    {
      const std::vector<int>& rows = nodes[child].Below;
      std::for_each(rows.begin(), rows.end(), add);
    }
    std::sort(node.Below.begin(), node.Below.end());

    std::iota(place.begin() + node.First, place.begin() + end, 0);
    for (std::size_t k = 0; k < node.Below.size(); ++k)
    {
      place[node.Below[k]] = node.Width + static_cast<int>(k);
    }
    for (const int child : node.Children)
    {
      Supernode& below = nodes[child];
      below.InParent.resize(below.Below.size());
      std::transform(below.Below.begin(), below.Below.end(), below.InParent.begin(),
        [&place](int row) { return place[row]; });
    }
    if (!node.Below.empty())
    {
      node.Parent = nodeOf[node.Below.front()];
      nodes[node.Parent].Children.push_back(s);
    }
  }
}

// The roots of disjoint subtrees, heaviest first. Starts from the whole tree and divides the
// heaviest subtree into its children until it is light enough.
std::vector<int> DivideTree(const std::vector<Supernode>& nodes, const std::vector<double>& weight)
{
  const auto lighter = [&weight](int a, int b)
  {
    const double difference = weight[a] - weight[b];
    return difference < 0.0 || (difference == 0.0 && a > b);
  };
  std::priority_queue<int, std::vector<int>, decltype(lighter)> subtrees(lighter);
  double total = 0.0;
  const auto count = static_cast<int>(nodes.size());
  for (int s = 0; s < count; ++s)
  {
    if (nodes[s].Parent < 0)
    {
      subtrees.push(s);
      total += weight[s];
    }
  }
  while (!subtrees.empty() && weight[subtrees.top()] > LargestSubtree * total)
  {
    const int heaviest = subtrees.top();
    subtrees.pop();
    for (const int child : nodes[heaviest].Children)
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

// The weight of each supernode: the number of entries of L in its subtree.
std::vector<double> SubtreeWeights(const std::vector<Supernode>& nodes)
{
  std::vector<double> weight(nodes.size());
  for (std::size_t s = 0; s < nodes.size(); ++s)
  {
    weight[s] += static_cast<double>(nodes[s].Height()) * nodes[s].Width;
    if (nodes[s].Parent >= 0)
    {
      weight[nodes[s].Parent] += weight[s];
    }
  }
  return weight;
}

// Distributes the supernodes: each belongs to the group of its subtree, or to the top.
void FormGroups(SupernodeTree& tree)
{
  const std::vector<double> weight = SubtreeWeights(tree.Nodes);
  std::vector<int> group(tree.Nodes.size(), -1);
  std::vector<double> load(NumberOfGroups, 0.0);
  for (const int root : DivideTree(tree.Nodes, weight))
  {
    const auto lightest = std::min_element(load.begin(), load.end());
    *lightest += weight[root];
    group[root] = static_cast<int>(lightest - load.begin());
  }
  tree.Groups.resize(NumberOfGroups);
  for (int s = static_cast<int>(tree.Nodes.size()) - 1; s >= 0; --s)
  {
    const int parent = tree.Nodes[s].Parent;
    if (group[s] < 0 && parent >= 0)
    {
      group[s] = group[parent];
    }
    (group[s] < 0 ? tree.Top : tree.Groups[group[s]]).push_back(s);
  }
  std::reverse(tree.Top.begin(), tree.Top.end());
  for (std::vector<int>& members : tree.Groups)
  {
    std::reverse(members.begin(), members.end());
  }
}

// Numbers the rows of the top, and finds where they begin among the rows below each supernode.
void NumberTopRows(SupernodeTree& tree)
{
  for (const int s : tree.Top)
  {
    const Supernode& node = tree.Nodes[s];
    std::iota(tree.TopRow.begin() + node.First, tree.TopRow.begin() + node.First + node.Width,
      tree.TopRows);
    tree.TopRows += node.Width;
  }
  for (Supernode& node : tree.Nodes)
  {
    const auto firstInTop = std::find_if(node.Below.begin(), node.Below.end(),
      [&tree](int row) { return tree.TopRow[row] >= 0; });
    node.TopBegin = firstInTop - node.Below.begin();
  }
}

} // namespace

Eigen::VectorXi Postorder(const SparseMatrix& pattern)
{
  const std::vector<std::vector<int>> children = ChildrenOf(BuildTree(pattern));
  // Filled from the last position backwards: a column, then its children, the last one first.
  Eigen::VectorXi order(pattern.cols());
  Index next = order.size();
  std::vector<int> waiting = children.back();
  while (!waiting.empty())
  {
    const int node = waiting.back();
    waiting.pop_back();
    order[--next] = node;
    const std::vector<int>& own = children[node];
    waiting.insert(waiting.end(), own.begin(), own.end());
  }
  return order;
}

SupernodeTree FindSupernodes(const SparseMatrix& pattern)
{
  const EliminationTree columns = BuildTree(pattern);
  SupernodeTree tree;
  tree.Nodes = MergeSupernodes(FundamentalSupernodes(columns), columns);
  FindRows(pattern, tree.Nodes);
  for (Supernode& node : tree.Nodes)
  {
    node.Offset = tree.Entries;
    tree.Entries += static_cast<std::size_t>(node.Height()) * node.Width;
  }
  FormGroups(tree);
  tree.TopRow.assign(pattern.cols(), -1);
  NumberTopRows(tree);
  return tree;
}

} // namespace spectralwatermark
