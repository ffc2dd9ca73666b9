// SPDX-License-Identifier: BSD-3-Clause
#include "Private/PerceptualDistance.h"

#include "Core/Distortion/BallNeighbourhood.h"
#include "Core/Distortion/StructuralDistortion.h"
#include "Core/Mesh/Measures.h"

namespace spectralwatermark
{

namespace
{

// A mesh, and where its vertices lie on the other one.
struct Side
{
  Side(const TriangleMesh& mesh, const ClosestPoints& other, int threads, const Progress& progress)
    : Balls(mesh)
    , Matches(other.To(mesh.Points, threads, progress))
    , Local(Eigen::VectorXd::Zero(mesh.NumberOfVertices()))
  {
  }

  BallNeighbourhood Balls;
  std::vector<SurfacePoint> Matches;
  Eigen::VectorXd Local;
};

} // namespace

PerceptualDistance Msdm2(const ClosestPoints& reference, const ClosestPoints& distorted,
  int threads, const Progress& progress)
{
  Side before(reference.Mesh(), distorted, threads, progress.Part(0.0, 0.1));
  Side after(distorted.Mesh(), reference, threads, progress.Part(0.1, 0.2));
  const double side = LongestSide(reference.Mesh().Points);
  const double part = 1.0 / static_cast<double>(Msdm2Radii.size());
  double done = 0.2;
  for (const double radius : Msdm2Radii)
  {
    const double ball = radius * side;
    const StructuralWindow window{ 5.0 * ball, true, 1 };
    const Eigen::VectorXd old = side * NormalCycleCurvature(before.Balls, ball, threads);
    const Eigen::VectorXd now = side * NormalCycleCurvature(after.Balls, ball, threads);
    progress.Report(done + 0.3 * 0.8 * part);
    before.Local += part *
      LocalStructuralDistortion(before.Balls, old, distorted.Interpolate(now, before.Matches),
        window, threads);
    progress.Report(done + 0.6 * 0.8 * part);
    after.Local += part *
      LocalStructuralDistortion(after.Balls, now, reference.Interpolate(old, after.Matches), window,
        threads);
    done += 0.8 * part;
    progress.Report(done);
  }
  return { 0.5 * (CubicMean(before.Local) + CubicMean(after.Local)), after.Local };
}

} // namespace spectralwatermark
