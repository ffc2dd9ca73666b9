// SPDX-License-Identifier: BSD-3-Clause
/// The finite-element Laplace-Beltrami operator of a triangle mesh (paper, 2.1, eqs. 4 and 5).
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

/// The pencil S h = lambda M h of a mesh, and its known kernel.
///
/// The boundary condition is the natural (Neumann) one. A non-manifold edge couples all of its
/// triangles. Triangles so thin that their cotangents lose all precision are given a minimal
/// thickness (intrinsic mollification as in Sharp and Crane, "A Laplacian for Nonmanifold
/// Triangle Meshes", 2020, but triangle by triangle, so that sound triangles stay exact).
/// A component without any area takes no part: its rows are pinned (unit stiffness, no mass), so
/// every harmonic is 0 there.
struct LaplaceOperator
{
  SparseMatrix Stiffness;     ///< S: symmetric positive semi-definite, S 1 = 0; without unit
  SparseMatrix Mass;          ///< M: D or B, in squared units of length
  Eigen::VectorXd VertexMass; ///< diagonal of D; sums to the area
  Eigen::MatrixXd Kernel;     ///< M-orthonormal null space of S, first column constant; n x c
  double Area = 0.0;          ///< of the surface
  Index Rank = 0;             ///< number of finite eigenvalues: vertices that have mass
};

/// Throws InvalidInput when a mesh of that size has larger matrices than Eigen's indices of 32 bits allow:
/// 178,956,970 triangles or vertices. What is made from them, factors and harmonics, is counted in 64.
void CheckMatrixSize(Index vertices, Index triangles);

/// Assembles the operator. Throws InvalidInput when the mesh has no area at all, or CheckMatrixSize()
/// does.
LaplaceOperator AssembleLaplaceOperator(const TriangleMesh& mesh, MassMatrix kind);

} // namespace spectralwatermark

#endif
