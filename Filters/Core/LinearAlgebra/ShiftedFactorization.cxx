// SPDX-License-Identifier: BSD-3-Clause
// Eigen's METIS support uses <iostream> without including it, so it must come first.
#include <iostream>

#include "Core/LinearAlgebra/ShiftedFactorization.h"

#include "Core/Support/Errors.h"
#include "Core/Support/Parallel.h"

#include <Eigen/MetisSupport>

#include <mutex>

namespace spectralwatermark
{

namespace
{

Eigen::VectorXi NestedDissection(const SparseMatrix& pattern)
{
  // METIS uses one random generator for the whole process; concurrent calls would change each
  // other's orderings.
  static std::mutex oneAtATime;
  const std::lock_guard<std::mutex> lock(oneAtATime);
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> toOriginal;
  Eigen::MetisOrdering<int>()(pattern, toOriginal);
  if (toOriginal.size() != pattern.rows())
  {
    throw SolverFailure("METIS found no elimination order", "check that there is enough memory");
  }
  return toOriginal.indices();
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

ShiftedFactorization::ShiftedFactorization(const SparseMatrix& stiffness, const SparseMatrix& mass,
  const Eigen::VectorXi& order)
  : OriginalRow(order.size() == stiffness.rows() ? order : NestedDissection(stiffness + mass))
{
  const SparseMatrix pattern = InOrder(stiffness + mass, this->OriginalRow);
  const Eigen::VectorXi postorder = Postorder(pattern);
  this->OriginalRow = this->OriginalRow(postorder).eval();
  this->PermutedStiffness = InOrder(stiffness, this->OriginalRow);
  this->PermutedMass = InOrder(mass, this->OriginalRow);
  this->Factors.emplace(this->PermutedStiffness + this->PermutedMass);
}

Index ShiftedFactorization::Factorize(double shift, int threads)
{
  this->Shifted = this->PermutedStiffness - shift * this->PermutedMass;
  if (!this->Factors->Factorize(this->Shifted, threads))
  {
    throw SolverFailure("the factorisation of the shifted Laplacian broke down");
  }
  return this->Factors->NegativePivots();
}

double ShiftedFactorization::SolveError(int threads) const
{
  const BlockVector random = RandomBlockVector(this->Size(), 0, threads);
  BlockVector right;
  MultiplyBlock(this->PermutedMass, random, right, threads);
  BlockVector solution = right;
  this->Solve(solution, threads);
  BlockVector product;
  MultiplyBlock(this->Shifted, solution, product, threads);
  return (right - product).norm() / right.norm();
}

void ShiftedFactorization::Solve(BlockVector& x, int threads) const
{
  this->Factors->Solve(x, threads);
}

void ShiftedFactorization::SolveWithMass(MultiVector& x, bool refine, int threads) const
{
  ForEachTask(threads, static_cast<Index>(x.size()),
    [&](Index k)
    {
      BlockVector right;
      MultiplyBlock(this->PermutedMass, x[k], right, 1);
      BlockVector solution = right;
      this->Solve(solution, 1);
      if (refine)
      {
        BlockVector product;
        MultiplyBlock(this->Shifted, solution, product, 1);
        right -= product;
        this->Solve(right, 1);
        solution += right;
      }
      x[k] = std::move(solution);
    });
}

} // namespace spectralwatermark
