// SPDX-License-Identifier: BSD-3-Clause
/// The finite-element Laplace-Beltrami operator of a triangle mesh (paper, 2.1, eqs. 4 and 5).
///
/// The paper is Y. Liu, B. Prabhakaran and X. Guo, "A Robust Spectral Approach for Blind
/// Watermarking of Manifold Surfaces" (2008), here and in all files.
#ifndef SpectralWatermark_Core_Harmonics_LaplaceOperator_h
#define SpectralWatermark_Core_Harmonics_LaplaceOperator_h

#include "Core/Mesh/TriangleMesh.h"

namespace spectralwatermark
{

/// Which inner product makes the harmonics orthonormal.
enum class MassMatrix
{
  Lumped = 0,    ///< D: diagonal, a third of the area of the triangles around each vertex
  Consistent = 1 ///< B: <phi_i, phi_j> of the hat functions, whose row sums are D
};

/// The matrices of the eigenproblem S h = lambda M h of a mesh, and its kernel.
///
/// The boundary condition is the natural (Neumann) one. A non-manifold edge couples all of its
/// triangles. Triangles so thin that their cotangents lose all precision are given a minimal
/// thickness (intrinsic mollification as in Sharp and Crane, "A Laplacian for Nonmanifold
/// Triangle Meshes", 2020, but triangle by triangle, so that sound triangles stay exact).
/// A component without area is left out: its rows are pinned (unit stiffness, no mass), so that
/// every harmonic is 0 there.
struct LaplaceOperator
{
  SparseMatrix Stiffness;     ///< S: symmetric positive semi-definite, S 1 = 0; dimensionless
  SparseMatrix Mass;          ///< M: D or B, in squared units of length
  Eigen::VectorXd VertexMass; ///< the diagonal of D, whose sum is the area
  Eigen::MatrixXd Kernel;     ///< M-orthonormal null space of S, first column constant; n x c
  double Area = 0.0;          ///< the area of the surface
  Index Rank = 0;             ///< number of finite eigenvalues: vertices that have mass
};

/// Throws InvalidInput when the matrices of a mesh of this size exceed Eigen's 32-bit indices,
/// which allow 178,956,970 triangles or vertices. Factors and harmonics use 64-bit indices.
void CheckMatrixSize(Index vertices, Index triangles);

/// Assembles the operator. Throws InvalidInput when the mesh has no area at all, or when
/// CheckMatrixSize() does.
LaplaceOperator AssembleLaplaceOperator(const TriangleMesh& mesh, MassMatrix kind);

} // namespace spectralwatermark

#endif
