// SPDX-License-Identifier: BSD-3-Clause
#include "Support/SparseMatrices.h"

#include "Core/LinearAlgebra/Supernodes.h"

#include <random>

namespace sparsematrices
{

namespace
{

// Nested dissection by hand: the halves of the longer side, then the line between them.
void Dissect(int x0, int x1, int y0, int y1, int width, std::vector<int>& order)
{
  if (x0 >= x1 || y0 >= y1)
  {
    return;
  }
  if (x1 - x0 < y1 - y0)
  {
    const int y = (y0 + y1) / 2;
    Dissect(x0, x1, y0, y, width, order);
    Dissect(x0, x1, y + 1, y1, width, order);
    for (int x = x0; x < x1; ++x)
    {
      order.push_back(y * width + x);
    }
    return;
  }
  const int x = (x0 + x1) / 2;
  Dissect(x0, x, y0, y1, width, order);
  Dissect(x + 1, x1, y0, y1, width, order);
  for (int y = y0; y < y1; ++y)
  {
    order.push_back(y * width + x);
  }
}

SparseMatrix InOrder(const SparseMatrix& matrix, const Eigen::VectorXi& order)
{
  const Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> toNew =
    Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int>(order).inverse();
  SparseMatrix permuted;
  permuted = matrix.twistedBy(toNew);
  return permuted;
}

} // namespace

SparseMatrix RandomMatrix(Index size, double density, unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> value(-1.0, 1.0);
  std::bernoulli_distribution isThere(density);
  std::vector<Eigen::Triplet<double>> entries;
  for (int j = 0; j < size; ++j)
  {
    entries.emplace_back(j, j, 4.0 * value(random));
    for (int i = 0; i < j; ++i)
    {
      if (isThere(random))
      {
        const double entry = value(random);
        entries.emplace_back(i, j, entry);
        entries.emplace_back(j, i, entry);
      }
    }
  }
  SparseMatrix matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

SparseMatrix Grid(int width, double diagonal)
{
  std::vector<Eigen::Triplet<double>> entries;
  const auto connect = [&entries](int a, int b)
  {
    entries.emplace_back(a, b, -1.0);
    entries.emplace_back(b, a, -1.0);
  };
  for (int y = 0; y < width; ++y)
  {
    for (int x = 0; x < width; ++x)
    {
      const int k = y * width + x;
      entries.emplace_back(k, k, diagonal);
      if (x + 1 < width)
      {
        connect(k, k + 1);
      }
      if (y + 1 < width)
      {
        connect(k, k + width);
      }
    }
  }
  SparseMatrix matrix(width * width, width * width);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

SparseMatrix DissectedGrid(int width, double diagonal)
{
  std::vector<int> order;
  Dissect(0, width, 0, width, width, order);
  return InOrder(Grid(width, diagonal),
    Eigen::Map<Eigen::VectorXi>(order.data(), static_cast<Index>(order.size())));
}

SparseMatrix InPostorder(const SparseMatrix& matrix)
{
  return InOrder(matrix, spectralwatermark::Postorder(matrix));
}

std::vector<Shape> Shapes()
{
  SparseMatrix dense = RandomMatrix(150, 1.0, 1); // one supernode, wider than what is done at once
  SparseMatrix diagonal = RandomMatrix(60, 0.0, 2);
  SparseMatrix one = RandomMatrix(1, 0.0, 3);
  return { { "one", one }, { "diagonal", diagonal }, { "dense", dense },
    { "sparse", RandomMatrix(400, 0.004, 4) }, { "fuller", RandomMatrix(300, 0.03, 5) },
    { "grid", Grid(20, 1.7) }, { "dissected grid", DissectedGrid(25, 1.7) } };
}

} // namespace sparsematrices
