// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Eigensolver/SpectraSolver.h"
#include "Support/EigenProblems.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace spectralwatermark;
using namespace eigenproblems;

// On squares halved by a diagonal the Laplacian is the five-point stencil, whose eigenvalues on a torus of
// n x n cells are 4 n^2 (sin^2(pi i / n) + sin^2(pi j / n)).
TEST(SpectraSolver, FindsTheEigenvaluesOfTheFivePointStencil)
{
  constexpr int cells = 14;
  std::vector<double> expected;
  for (int i = 0; i < cells; ++i)
  {
    for (int j = 0; j < cells; ++j)
    {
      const double x = std::sin(Pi * i / cells);
      const double y = std::sin(Pi * j / cells);
      expected.push_back(4.0 * cells * cells * (x * x + y * y));
    }
  }
  std::sort(expected.begin(), expected.end());
  const EigenPairs pairs = SolveBanded<SpectraSolver>(FlatTorus(cells), 60, 20);
  ASSERT_TRUE(pairs.Complete);
  ASSERT_EQ(pairs.Values.size(), 60);
  ExpectSameSpectrum(pairs.Values, Eigen::Map<const Eigen::VectorXd>(expected.data(), 60));
}
