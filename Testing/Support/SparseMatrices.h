// SPDX-License-Identifier: BSD-3-Clause
/// Symmetric sparse matrices, for the tests of factorisations.
#ifndef SpectralWatermark_Testing_SparseMatrices_h
#define SpectralWatermark_Testing_SparseMatrices_h

#include "Core/Support/Types.h"

#include <vector>

namespace sparsematrices
{

using spectralwatermark::Index;
using spectralwatermark::SparseMatrix;

/// Symmetric and indefinite, with about `density` of its entries.
SparseMatrix RandomMatrix(Index size, double density, unsigned seed);

/// A grid, four neighbours each, as surfaces have.
SparseMatrix Grid(int width, double diagonal);

/// The grid in the order of a nested dissection.
SparseMatrix DissectedGrid(int width, double diagonal);

/// The matrix with its rows and columns in a postorder of its elimination tree.
SparseMatrix InPostorder(const SparseMatrix& matrix);

struct Shape
{
  const char* Name;
  SparseMatrix Matrix;
};

/// Matrices of every kind of elimination tree.
std::vector<Shape> Shapes();

} // namespace sparsematrices

#endif
