// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Eigensolver/SpectrumSlicing.h"
#include "Core/LinearAlgebra/MultiVector.h"
#include "Core/Support/Progress.h"
#include "Support/EigenProblems.h"
#include "Support/Shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

using namespace spectralwatermark;
using namespace eigenproblems;

namespace
{

// Counts what it is asked, and finds the same values every time, none of them an eigenvalue.
class FindsNonsense : public ShiftInvertSolver
{
public:
  FindsNonsense(const OwnedProblem& problem, std::vector<double> values)
    : Problem(problem)
    , Values(std::move(values))
    , SameOrder(Eigen::VectorXi::LinSpaced(problem.Mass.rows(), 0,
        static_cast<int>(problem.Mass.rows()) - 1))
  {
  }

  Index DefaultBandSize(Index /*wanted*/) const override { return 20; }
  bool FirstShiftInside() const override { return false; }
  Index Factorize(double /*shift*/, const Progress& /*progress*/) override { return 0; }
  Band FindNearest(BandRequest /*request*/, const Progress& /*progress*/) override
  {
    ++this->Searches;
    Band band;
    band.Values = this->Values;
    band.Vectors.assign((this->Values.size() + BlockWidth - 1) / BlockWidth,
      BlockVector::Zero(this->Problem.Mass.rows(), BlockWidth));
    return band;
  }
  const SparseMatrix& Stiffness() const override { return this->Problem.Stiffness; }
  const SparseMatrix& Mass() const override { return this->Problem.Mass; }
  const Eigen::VectorXi& Order() const override { return this->SameOrder; }

  int Searches = 0;

private:
  const OwnedProblem& Problem;
  std::vector<double> Values;
  Eigen::VectorXi SameOrder;
};

int SearchesThatFind(std::vector<double> values)
{
  const OwnedProblem problem(shapes::Icosphere(1)); // of 42 vertices
  FindsNonsense solver(problem, std::move(values));
  EigensolverOptions options;
  options.Count = 20;
  EXPECT_FALSE(SolveBySlicing(problem.View(), options, solver, Progress()).Complete);
  return solver.Searches;
}

// Finds the pairs of a diagonal problem, whose vectors are multiples of unit vectors, without an error. May
// leave one pair out of each band's first search.
class DiagonalSearch : public ShiftInvertSolver
{
public:
  DiagonalSearch(const OwnedProblem& problem, bool isForgetful)
    : Problem(problem)
    , IsForgetful(isForgetful)
    , Values(problem.Stiffness.diagonal().cwiseQuotient(problem.Mass.diagonal()))
    , SameOrder(Eigen::VectorXi::LinSpaced(this->Values.size(), 0,
        static_cast<int>(this->Values.size()) - 1))
  {
  }

  Index DefaultBandSize(Index /*wanted*/) const override { return 10; }
  bool FirstShiftInside() const override { return false; }
  Index Factorize(double shift, const Progress& /*progress*/) override
  {
    this->Shift = shift;
    return (this->Values.array() < shift).count();
  }
  Band FindNearest(BandRequest request, const Progress& /*progress*/) override
  {
    ++this->Searches;
    request.Above += request.Window;
    std::vector<Index> found;
    for (const Index k : this->ByDistance(request.Locked))
    {
      const bool isBelow = this->Values[k] < this->Shift;
      Index& wanted = request.AnySide || !isBelow ? request.Above : request.Below;
      if (wanted > 0)
      {
        --wanted;
        found.push_back(k);
      }
    }
    if (this->IsForgetful && request.Attempt == 0)
    {
      found.erase(found.begin());
    }
    return this->BandOf(found);
  }
  const SparseMatrix& Stiffness() const override { return this->Problem.Stiffness; }
  const SparseMatrix& Mass() const override { return this->Problem.Mass; }
  const Eigen::VectorXi& Order() const override { return this->SameOrder; }

  int Searches = 0;

private:
  std::vector<Index> ByDistance(const MultiVector& locked) const
  {
    std::vector<Index> order;
    for (Index k = 0; k < this->Values.size(); ++k)
    {
      const bool isLocked = std::any_of(locked.begin(), locked.end(),
        [k](const BlockVector& block) { return block.row(k).norm() > 0.0; });
      if (!isLocked)
      {
        order.push_back(k);
      }
    }
    std::stable_sort(order.begin(), order.end(),
      [this](Index a, Index b) {
        return std::abs(this->Values[a] - this->Shift) < std::abs(this->Values[b] - this->Shift);
      });
    return order;
  }
  Band BandOf(const std::vector<Index>& found) const
  {
    Eigen::MatrixXd vectors =
      Eigen::MatrixXd::Zero(this->Values.size(), static_cast<Index>(found.size()));
    Band band;
    for (Index k = 0; k < vectors.cols(); ++k)
    {
      vectors(found[k], k) = 2.0;
      band.Values.push_back(this->Values[found[k]]);
    }
    band.Vectors = ToMultiVector(vectors, this->SameOrder);
    return band;
  }

  const OwnedProblem& Problem;
  bool IsForgetful;
  Eigen::VectorXd Values;
  Eigen::VectorXi SameOrder;
  double Shift = 0.0;
};

// Twenty eigenvalues, three times each, in any order.
OwnedProblem ThreefoldProblem()
{
  std::vector<double> values;
  for (int k = 0; k < 60; ++k)
  {
    values.push_back(12.0 * Pi * (k * 7 % 20 + 1));
  }
  return DiagonalProblem(values);
}

void ExpectThreefoldSpectrum(const OwnedProblem& problem, const EigenPairs& pairs)
{
  ASSERT_TRUE(pairs.Complete);
  for (Index k = 0; k < pairs.Values.size(); ++k)
  {
    EXPECT_NEAR(pairs.Values[k], 12.0 * Pi * static_cast<double>(k / 3 + 1), 1e-10) << k;
  }
  EXPECT_LT(OrthonormalityError(problem, pairs), 1e-12);
  EXPECT_LT(pairs.Residuals.maxCoeff(), 1e-14);
}

} // namespace

// What is found stays, so that more searches would not mend it.
TEST(SpectrumSlicing, GivesUpASearchThatFindsNoSpectrum)
{
  EXPECT_EQ(SearchesThatFind({ -1.0, 2.0, 3.0 }), 1) << "one far below 0";
  EXPECT_EQ(SearchesThatFind(std::vector<double>(30, 5.0)), 2) << "60 of 42";
  EXPECT_EQ(SearchesThatFind({ -1e-9, 2.0, 3.0 }), 12) << "a rounding under 0";
}

TEST(SpectrumSlicing, CutsNoMultipleEigenvalueInTwo)
{
  const OwnedProblem problem = ThreefoldProblem();
  for (const Index bandSize : { 4, 10, 40 })
  {
    DiagonalSearch solver(problem, false);
    EigensolverOptions options;
    options.Count = 40;
    options.BandSize = bandSize;
    const EigenPairs pairs = SolveBySlicing(problem.View(), options, solver, Progress());
    ASSERT_EQ(pairs.Values.size(), 40);
    ExpectThreefoldSpectrum(problem, pairs);
    EXPECT_EQ(solver.Searches, pairs.Bands);
    EXPECT_EQ(pairs.Bands > 1, bandSize < 40);
  }
}

TEST(SpectrumSlicing, SearchesAgainForWhatABandMissed)
{
  const OwnedProblem problem = ThreefoldProblem();
  DiagonalSearch solver(problem, true);
  EigensolverOptions options;
  options.Count = 60;
  const EigenPairs pairs = SolveBySlicing(problem.View(), options, solver, Progress());
  ASSERT_EQ(pairs.Values.size(), 60);
  ExpectThreefoldSpectrum(problem, pairs);
  EXPECT_GT(solver.Searches, pairs.Bands);
}
