// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Eigensolver/BlockKrylovSpace.h"

#include "Core/Support/Errors.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <utility>

namespace spectralwatermark
{

namespace
{

// Random share of a starting block that comes from an initial guess.
constexpr double RandomShare = 1e-3;

// Ratio of the operator's norm to a block's smallest coupling up to which reorthogonalisation may
// wait for a second block.
constexpr double LargestGrowth = 1e3;

// Share of its length below which a direction of a new block, once orthogonalised, is only
// rounding.
constexpr double Exhausted = 1e-10;

} // namespace

BlockKrylovSpace::BlockKrylovSpace(const ShiftedFactorization& factorization, MultiVector locked,
  BlockVector start, std::uint64_t seed, int threads)
  : Factorization(factorization)
  , Threads(threads)
  , Locked(locked.size())
  , Basis(std::move(locked))
{
  BlockVector random = RandomBlockVector(factorization.Size(), seed, threads);
  if (start.size() > 0)
  {
    // The random part keeps some of every eigenvector, so that none is missed.
    start *= 1.0 / start.norm();
    random = start + RandomShare / random.norm() * random;
  }
  if (!this->Begin(std::move(random)))
  {
    throw SolverFailure("the mesh has too few vertices with area for this solver",
      "let the solver be chosen automatically, ask for fewer harmonics, or remove triangles "
      "without "
      "area");
  }
}

MultiVector BlockKrylovSpace::Combine(const Eigen::MatrixXd& coefficients) const
{
  const MultiVectorView krylov(this->Basis.data() + this->Locked,
    this->Basis.size() - this->Locked);
  return LinearCombination(krylov, coefficients, this->Threads);
}

Eigen::MatrixXd BlockKrylovSpace::Project(const MultiVectorView& q, const BlockVector* w,
  std::size_t count) const
{
  return InnerProducts(q, this->Factorization.Mass(), MultiVectorView(w, count), this->Product,
    this->Threads);
}

Eigen::MatrixXd BlockKrylovSpace::ProjectOut(const MultiVectorView& q, BlockVector* w,
  std::size_t count) const
{
  Eigen::MatrixXd c = this->Project(q, w, count);
  SubtractCombination(q, c, w, this->Threads);
  return c;
}

Eigen::MatrixXd BlockKrylovSpace::Orthonormalize(BlockVector& w, double length) const
{
  const Eigen::MatrixXd gram = this->Project(MultiVectorView(&w, 1), &w, 1);
  const Eigen::LLT<Eigen::MatrixXd> cholesky(0.5 * (gram + gram.transpose()));
  Eigen::MatrixXd r = cholesky.matrixU();
  if (cholesky.info() != Eigen::Success ||
    !(r.diagonal().minCoeff() > Exhausted * std::max(length, r.diagonal().maxCoeff())))
  {
    return {};
  }
  SolveTriangularRight(r, w, this->Threads);
  return r;
}

MultiVectorView BlockKrylovSpace::Last(std::size_t count) const
{
  const std::size_t available = std::min(count, this->Basis.size() - this->Locked);
  return MultiVectorView(this->Basis.data() + this->Basis.size() - available, available);
}

bool BlockKrylovSpace::Begin(BlockVector start)
{
  for (int pass = 0; pass < 2; ++pass)
  {
    this->ProjectOut(this->All(), &start);
    if (this->Orthonormalize(start).size() == 0)
    {
      return false;
    }
  }
  this->Basis.push_back(std::move(start));
  return true;
}

// In exact arithmetic the image is orthogonal to all but the last two blocks. Rounding reintroduces
// the others. They are projected out of two new blocks at a time, so that the basis is streamed
// once for both, unless the error has grown enough to show in the projected operator.
bool BlockKrylovSpace::Extend()
{
  BlockVector w;
  MultiplyBlock(this->Factorization.Mass(), this->Basis.back(), w, this->Threads);
  this->Factorization.Solve(w, this->Threads);
  const Eigen::MatrixXd recent = this->ProjectOut(this->Last(2), &w);
  const Eigen::MatrixXd diagonal = recent.bottomRows(BlockWidth);
  this->Diagonal.push_back(0.5 * (diagonal + diagonal.transpose()));
  this->Largest = std::max(this->Largest, diagonal.diagonal().cwiseAbs().maxCoeff());
  Eigen::MatrixXd coupling = this->Orthonormalize(w);
  if (coupling.size() > 0)
  {
    this->ProjectOut(this->Last(2), &w);
    const Eigen::MatrixXd again = this->Orthonormalize(w, 1.0);
    coupling = again.size() > 0 ? Eigen::MatrixXd(again * coupling) : again;
  }
  this->Coupling.push_back(coupling);
  if (coupling.size() == 0)
  {
    this->Reorthogonalize();
    return false;
  }
  this->Basis.push_back(std::move(w));
  ++this->Pending;
  const double growth = this->Largest / this->Coupling.back().diagonal().minCoeff();
  return (this->Pending < 2 && growth < LargestGrowth) || this->Reorthogonalize();
}

bool BlockKrylovSpace::Reorthogonalize()
{
  const std::size_t count = std::exchange(this->Pending, 0);
  const std::size_t before = this->Basis.size() - count;
  BlockVector* last = this->Basis.data() + before;
  if (count > 0)
  {
    this->ProjectOut(MultiVectorView(this->Basis.data(), before), last, count);
  }
  for (std::size_t k = 0; k < count; ++k)
  {
    this->ProjectOut(MultiVectorView(last, k), last + k);
    const Eigen::MatrixXd r = this->Orthonormalize(last[k], 1.0);
    // Never the first block, so there is a coupling before it.
    const std::size_t block = before + k - this->Locked;
    if (r.size() == 0)
    {
      this->Basis.resize(before + k);
      this->Diagonal.resize(block);
      this->Coupling.resize(block);
      this->Coupling.back().resize(0, 0);
      return false;
    }
    this->Coupling[block - 1] = (r * this->Coupling[block - 1]).eval();
  }
  return true;
}

Eigen::MatrixXd BlockKrylovSpace::Projected() const
{
  const Index size = this->Size();
  Eigen::MatrixXd t = Eigen::MatrixXd::Zero(size, size);
  for (Index j = 0; j < size; j += BlockWidth)
  {
    const Index block = j / BlockWidth;
    t.block(j, j, BlockWidth, BlockWidth) = this->Diagonal[block];
    if (j + BlockWidth < size)
    {
      t.block(j + BlockWidth, j, BlockWidth, BlockWidth) = this->Coupling[block];
      t.block(j, j + BlockWidth, BlockWidth, BlockWidth) = this->Coupling[block].transpose();
    }
  }
  return t;
}

} // namespace spectralwatermark
