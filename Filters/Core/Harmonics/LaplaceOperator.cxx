// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Harmonics/LaplaceOperator.h"

#include "Core/Support/Errors.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <vector>

namespace spectralwatermark
{

namespace
{

using Triplets = std::vector<Eigen::Triplet<double>>;

// Smallest slack b + c - a that a triangle may have, relative to its longest edge a. It bounds the
// cotangents by about 1e8, so that the assembled matrix keeps the precision of its sound part.
constexpr double MinimalSlack = 1e-8;

// Share of the whole area below which a component's area is rounding noise: it has collapsed.
constexpr double MinimalComponentShare = 1e-14;

struct TriangleElement
{
  double Area = 0.0;
  // The cotangent of the angle at each corner.
  Eigen::Vector3d Cotangents = Eigen::Vector3d::Zero();
};

// Heron's formula in a form that is stable for needles (Kahan, "Miscalculating Area and Angles",
// 2014).
double AreaFromLengths(std::array<double, 3> length)
{
  std::sort(length.begin(), length.end(), std::greater<double>());
  const auto [a, b, c] = length;
  return 0.25 * std::sqrt((a + (b + c)) * (c - (a - b)) * (c + (a - b)) * (a + (b - c)));
}

// The cotangents of the triangle after all its edges were lengthened by `missing`, which restores
// the minimal slack.
Eigen::Vector3d MollifiedCotangents(std::array<double, 3> length, double missing)
{
  for (double& edge : length)
  {
    edge += missing;
  }
  const double area = AreaFromLengths(length);
  Eigen::Vector3d cotangents;
  for (int i = 0; i < 3; ++i)
  {
    const double a = length[i];
    const double b = length[(i + 1) % 3];
    const double c = length[(i + 2) % 3];
    cotangents[i] = (b * b + c * c - a * a) / (4.0 * area);
  }
  return cotangents;
}

TriangleElement MakeElement(const TriangleMesh& mesh, Index t)
{
  std::array<Eigen::Vector3d, 3> point;
  for (int i = 0; i < 3; ++i)
  {
    point[i] = mesh.Points.row(mesh.Triangles(t, i)).transpose();
  }
  std::array<Eigen::Vector3d, 3> edge; // the edge opposite to each corner
  std::array<double, 3> length;
  for (int i = 0; i < 3; ++i)
  {
    edge[i] = point[(i + 2) % 3] - point[(i + 1) % 3];
    length[i] = edge[i].norm();
  }
  const double longest = *std::max_element(length.begin(), length.end());
  const double slack = length[0] + length[1] + length[2] - 2.0 * longest;

  TriangleElement element;
  const double doubleArea = edge[0].cross(edge[1]).norm();
  element.Area = 0.5 * doubleArea;
  if (slack >= MinimalSlack * longest && doubleArea > 0.0)
  {
    for (int i = 0; i < 3; ++i)
    {
      element.Cotangents[i] = -edge[(i + 1) % 3].dot(edge[(i + 2) % 3]) / doubleArea;
    }
  }
  else if (longest > 0.0)
  {
    element.Cotangents = MollifiedCotangents(length, MinimalSlack * longest - slack);
  }
  return element;
}

// The connected component of each vertex, named by its lowest vertex.
std::vector<Index> ComponentOfVertices(const TriangleMesh& mesh)
{
  std::vector<Index> parent(mesh.NumberOfVertices());
  std::iota(parent.begin(), parent.end(), Index{ 0 });
  const auto find = [&parent](Index v)
  {
    while (parent[v] != v)
    {
      Index& up = parent[v];
      up = parent[up];
      v = up;
    }
    return v;
  };
  for (Index t = 0; t < mesh.NumberOfTriangles(); ++t)
  {
    for (int corner = 1; corner < 3; ++corner)
    {
      const Index a = find(mesh.Triangles(t, 0));
      const Index b = find(mesh.Triangles(t, corner));
      parent[std::max(a, b)] = std::min(a, b);
    }
  }
  std::vector<Index> component(parent.size());
  for (Index v = 0; v < mesh.NumberOfVertices(); ++v)
  {
    component[v] = find(v);
  }
  return component;
}

// The components that have area, largest first, and by lowest vertex where areas are equal.
std::vector<Index> LiveComponents(const std::vector<Index>& componentOf,
  const Eigen::VectorXd& componentArea, double totalArea)
{
  std::vector<Index> live;
  for (Index v = 0; v < componentArea.size(); ++v)
  {
    if (componentOf[v] == v && componentArea[v] > MinimalComponentShare * totalArea)
    {
      live.push_back(v);
    }
  }
  std::stable_sort(live.begin(), live.end(),
    [&componentArea](Index a, Index b) { return componentArea[a] > componentArea[b]; });
  return live;
}

// A basis of the kernel of S in closed form, free of cancellation. Column 0 is constant. Column k
// is constant on component k - 1 and on the union of the components after it, is 0 on those before
// it, and is orthogonal to the columns before it, as if by Gram-Schmidt.
Eigen::MatrixXd KernelBasis(const std::vector<Index>& componentOf, const std::vector<Index>& live,
  const Eigen::VectorXd& componentArea)
{
  const Index n = static_cast<Index>(componentOf.size());
  const Index count = static_cast<Index>(live.size());
  std::vector<Index> rankOf(componentOf.size(), -1);
  for (Index k = 0; k < count; ++k)
  {
    rankOf[live[k]] = k;
  }
  // rest[k] is the area of components k, k + 1, ...
  std::vector<double> rest(live.size() + 1, 0.0);
  for (std::size_t k = live.size(); k-- > 0;)
  {
    rest[k] = rest[k + 1] + componentArea[live[k]];
  }
  Eigen::MatrixXd kernel = Eigen::MatrixXd::Zero(n, count);
  for (Index v = 0; v < n; ++v)
  {
    const Index rank = rankOf[componentOf[v]];
    if (rank < 0)
    {
      continue;
    }
    kernel(v, 0) = 1.0 / std::sqrt(rest[0]);
    for (Index k = 1; k < count && k <= rank + 1; ++k)
    {
      // Column k separates component k - 1 from those after it.
      const double own = componentArea[live[k - 1]];
      const double others = rest[k];
      const double scale = 1.0 / std::sqrt(own * others * (own + others));
      kernel(v, k) = (rank == k - 1) ? others * scale : -own * scale;
    }
  }
  return kernel;
}

void AddStiffness(const TriangleMesh& mesh, Index t, const Eigen::Vector3d& cotangents,
  Triplets& out)
{
  for (int corner = 0; corner < 3; ++corner)
  {
    const Index a = mesh.Triangles(t, (corner + 1) % 3);
    const Index b = mesh.Triangles(t, (corner + 2) % 3);
    const double weight = 0.5 * cotangents[corner];
    out.emplace_back(a, a, weight);
    out.emplace_back(b, b, weight);
    out.emplace_back(a, b, -weight);
    out.emplace_back(b, a, -weight);
  }
}

void AddConsistentMass(const TriangleMesh& mesh, Index t, double area, Triplets& out)
{
  for (int i = 0; i < 3; ++i)
  {
    for (int j = 0; j < 3; ++j)
    {
      out.emplace_back(mesh.Triangles(t, i), mesh.Triangles(t, j),
        area * (i == j ? 2.0 : 1.0) / 12.0);
    }
  }
}

SparseMatrix FromTriplets(Index n, const Triplets& triplets)
{
  SparseMatrix matrix(n, n);
  matrix.setFromTriplets(triplets.begin(), triplets.end());
  return matrix;
}

SparseMatrix Diagonal(const Eigen::VectorXd& diagonal)
{
  SparseMatrix matrix(diagonal.size(), diagonal.size());
  matrix = diagonal.asDiagonal();
  return matrix;
}

} // namespace

void CheckMatrixSize(Index vertices, Index triangles)
{
  // Each triangle adds 12 triplets, which Eigen indexes by int.
  constexpr Index most = std::numeric_limits<int>::max() / 12;
  if (std::max(vertices, triangles) > most)
  {
    throw InvalidInput("",
      "the mesh has over " + std::to_string(most) +
        " triangles or points, more than the matrices can index",
      "simplify it first");
  }
}

LaplaceOperator AssembleLaplaceOperator(const TriangleMesh& mesh, MassMatrix kind)
{
  const Index n = mesh.NumberOfVertices();
  const Index triangleCount = mesh.NumberOfTriangles();
  CheckMatrixSize(n, triangleCount);

  std::vector<TriangleElement> elements;
  elements.reserve(triangleCount);
  const std::vector<Index> componentOf = ComponentOfVertices(mesh);
  Eigen::VectorXd componentArea = Eigen::VectorXd::Zero(n);
  for (Index t = 0; t < triangleCount; ++t)
  {
    elements.push_back(MakeElement(mesh, t));
    componentArea[componentOf[mesh.Triangles(t, 0)]] += elements.back().Area;
  }
  const double totalArea = componentArea.sum();
  if (!(totalArea > 0.0) || !std::isfinite(totalArea))
  {
    throw InvalidInput("",
      "every triangle has zero area (or an area beyond double precision), and harmonics need a "
      "surface",
      "check the mesh's scale and cells");
  }
  const std::vector<Index> live = LiveComponents(componentOf, componentArea, totalArea);
  std::vector<char> isLive(n, 0);
  for (const Index root : live)
  {
    isLive[root] = 1;
  }
  const auto lives = [&](Index v) { return isLive[componentOf[v]] != 0; };

  LaplaceOperator op;
  op.VertexMass = Eigen::VectorXd::Zero(n);
  Triplets stiffness;
  Triplets mass;
  stiffness.reserve(12 * triangleCount);
  for (Index t = 0; t < triangleCount; ++t)
  {
    if (!lives(mesh.Triangles(t, 0)))
    {
      continue;
    }
    const TriangleElement& element = elements[t];
    op.Area += element.Area;
    for (int corner = 0; corner < 3; ++corner)
    {
      op.VertexMass[mesh.Triangles(t, corner)] += element.Area / 3.0;
    }
    AddStiffness(mesh, t, element.Cotangents, stiffness);
    if (kind == MassMatrix::Consistent)
    {
      AddConsistentMass(mesh, t, element.Area, mass);
    }
  }
  for (Index v = 0; v < n; ++v)
  {
    if (!lives(v))
    {
      stiffness.emplace_back(v, v, 1.0);
    }
  }
  op.Stiffness = FromTriplets(n, stiffness);
  op.Mass = kind == MassMatrix::Consistent ? FromTriplets(n, mass) : Diagonal(op.VertexMass);
  op.Kernel = KernelBasis(componentOf, live, componentArea);
  op.Rank = (op.VertexMass.array() > 0.0).count();
  return op;
}

} // namespace spectralwatermark
