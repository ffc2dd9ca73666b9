// SPDX-License-Identifier: BSD-3-Clause
#include "Core/RobustScheme/SurfaceMotion.h"

#include "Core/Mesh/Measures.h"
#include "Core/RobustScheme/SolidSpectrum.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace spectralwatermark
{

namespace
{

using Eigen::VectorXd;

// The largest carrier error, in steps, at which a round counts as converged.
constexpr double GoodError = 0.005;

// The largest number of rounds.
constexpr int MostRounds = 12;

// The share of the previous error above which a round counts as slow. Rounds reuse the response of
// the original mesh until one is slow, because computing a response is most of the work.
constexpr double SlowRound = 0.2;

// The root mean square displacement over the surface, in the model's units.
double RootMeanSquare(const TriangleMesh& mesh, const TriangleMesh::PointMatrix& moved)
{
  const VectorXd areas = VertexAreas(mesh);
  return std::sqrt(areas.dot((moved - mesh.Points).rowwise().squaredNorm()) / areas.sum());
}

} // namespace

SurfaceMotion::SurfaceMotion(const TriangleMesh& oriented, const CarrierProblem& problem,
  int threads)
  : Original(oriented)
  , Problem(problem)
  , Threads(threads)
  , Diagonal(BoundingBoxDiagonal(oriented.Points))
{
}

SurfaceMotion::Result SurfaceMotion::Run(const EmbeddingPlan& plan, const Progress& progress) const
{
  Result result;
  TriangleMesh mesh = this->Original;
  // Replaces the response of the original mesh after a slow round.
  std::optional<SolidResponse> current;
  double lastError = std::numeric_limits<double>::infinity();
  for (int round = 0; round <= MostRounds; ++round)
  {
    const SolidView view(mesh);
    const VectorXd changes =
      plan.Targets - (round == 0 ? this->Problem.Values : this->Spectrum(view));
    const double error = changes.cwiseAbs().maxCoeff() / StepOfNumber(plan.Step);
    result.Rounds.push_back({ this->Distortion(mesh.Points), error });
    progress.Report(static_cast<double>(round + 1) / (MostRounds + 1));
    const bool diverges = !(error <= lastError);
    if (error < GoodError || diverges || round == MostRounds)
    {
      break;
    }
    if (round > 0 && error > SlowRound * lastError)
    {
      // A response is large, so the old one is freed before the new one is made.
      current.reset();
      current.emplace(view, this->Problem.Carriers, this->Threads);
    }
    lastError = error;
    const SolidResponse& response = current ? *current : this->Problem.Response;
    const VectorXd heights = response.Displacements(changes);
    mesh.Points += view.Frame.DifferencesFromFrame(heights.asDiagonal() * VertexNormals(view.Mesh));
  }
  result.Points = std::move(mesh.Points);
  return result;
}

double SurfaceMotion::Distortion(const TriangleMesh::PointMatrix& points) const
{
  return RootMeanSquare(this->Original, points) / this->Diagonal;
}

double SurfaceMotion::Margin(const TriangleMesh& marked, const EmbeddingPlan& plan) const
{
  const VectorXd misses = this->Spectrum(SolidView(marked)) - plan.Targets;
  return std::max(0.0, 1.0 - 4.0 * misses.cwiseAbs().maxCoeff() / StepOfNumber(plan.Step));
}

VectorXd SurfaceMotion::Spectrum(const SolidView& view) const
{
  return SolidSpectrum(view.Mesh, this->Problem.Carriers.Waves, this->Threads);
}

} // namespace spectralwatermark
