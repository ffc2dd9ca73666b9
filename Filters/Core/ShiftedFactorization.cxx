// SPDX-License-Identifier: BSD-3-Clause
#include <iostream> // before Eigen's METIS support, which needs it and does not include it

#include "ShiftedFactorization.h"

#include "Errors.h"
#include "Noise.h"
#include "Parallel.h"

#include <Eigen/MetisSupport>

namespace spectralwatermark
{

using Eigen::Index;

namespace
{

Eigen::VectorXi NestedDissection(const Eigen::SparseMatrix<double>& pattern)
{
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> toOriginal;
  Eigen::MetisOrdering<int>()(pattern, toOriginal);
  return toOriginal.indices();
}

} // namespace

ShiftedFactorization::ShiftedFactorization(const SparseMatrix& stiffness, const SparseMatrix& mass,
  const Eigen::VectorXi& order)
  : OriginalRow(order.size() == stiffness.rows() ? order : NestedDissection(stiffness + mass))
{
  const Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> toPermuted =
    Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int>(this->OriginalRow).inverse();
  this->PermutedStiffness = stiffness.twistedBy(toPermuted);
  this->PermutedMass = mass.twistedBy(toPermuted);
  this->Factors.analyzePattern(this->PermutedStiffness + this->PermutedMass);
}

Index ShiftedFactorization::Factorize(double shift)
{
  this->Shifted = this->PermutedStiffness - shift * this->PermutedMass;
  this->Factors.factorize(this->Shifted);
  if (this->Factors.info() != Eigen::Success)
  {
    throw SolverFailure("the factorisation of the shifted Laplacian broke down");
  }
  if (this->InverseD.size() == 0)
  {
    this->Substitute = Substitution(this->L());
  }
  const Eigen::VectorXd d = this->Factors.vectorD();
  this->InverseD = d.cwiseInverse();
  return (d.array() < 0.0).count();
}

double ShiftedFactorization::SolveError(int threads) const
{
  Panel random(this->Size(), PanelWidth);
  for (Index i = 0; i < random.size(); ++i)
  {
    random.data()[i] = NormalRandom(0, static_cast<std::uint64_t>(i));
  }
  Panel right;
  MultiplyPanel(this->PermutedMass, random, right, threads);
  Panel solution = right;
  this->Solve(solution, threads);
  Panel product;
  MultiplyPanel(this->Shifted, solution, product, threads);
  return (right - product).norm() / right.norm();
}

void ShiftedFactorization::Solve(Panel& x, int threads) const
{
  this->Substitute.Solve(this->L(), this->InverseD, x, threads);
}

void ShiftedFactorization::SolveWithMass(Panels& x, bool refine, int threads) const
{
  ForEachTask(threads, static_cast<Index>(x.size()),
    [&](Index k)
    {
      Panel right;
      MultiplyPanel(this->PermutedMass, x[static_cast<std::size_t>(k)], right, 1);
      Panel solution = right;
      this->Solve(solution, 1);
      if (refine)
      {
        Panel product;
        MultiplyPanel(this->Shifted, solution, product, 1);
        right -= product;
        this->Solve(right, 1);
        solution += right;
      }
      x[static_cast<std::size_t>(k)] = std::move(solution);
    });
}

} // namespace spectralwatermark
