// SPDX-License-Identifier: BSD-3-Clause
#include "Core/RobustScheme/RobustEmbedding.h"

#include "Core/Mesh/Measures.h"
#include "Core/Mesh/Orientation.h"
#include "Core/Payload/Bits.h"
#include "Core/Payload/GolayCode.h"
#include "Core/RobustScheme/Capacity.h"
#include "Core/RobustScheme/RobustReader.h"
#include "Core/Support/MemoryBudget.h"
#include "Core/Support/Text.h"

#include <algorithm>
#include <iomanip>
#include <utility>

namespace spectralwatermark
{

namespace
{

// The largest number of attempts to meet the distortion limit.
constexpr int MostAttempts = 4;

// The share of the distortion limit that the first plan may use. The measured distortion differs a
// little from the planned one.
constexpr double PlannedPart = 0.97;

std::string Percent(double part)
{
  return TextOf(std::setprecision(3), 100.0 * part, " %");
}

void RequireMemoryToEmbed(Index vertices, Index bits)
{
  RequireMemory(MemoryOfEmbedding(vertices, GolayCodeBits * WordsOf(bits)),
    std::to_string(bits) + " bits in " + std::to_string(vertices) + " vertices",
    "embed fewer bits, or simplify the mesh first");
}

// Throws the error for a message whose embedding would move the surface by `distortion`, more than
// the limit. It says how many bits would fit.
[[noreturn]] void RefuseDistortion(const TriangleMesh& oriented, const SecretKey& key,
  const RobustEmbeddingOptions& options, double distortion, const Progress& progress)
{
  const auto bits = static_cast<Index>(options.Message.size());
  const Index most = MessageBitsOf(
    MostWords(oriented, key, options.MaximumDistortion, WordsOf(bits), options.Threads, progress));
  throw InvalidInput("MaximumDistortion",
    std::to_string(bits) + " bits would move the surface by " + Percent(distortion) +
      " of its diagonal, and " + Percent(options.MaximumDistortion) + " are allowed",
    most > 0 ? "raise it, or embed fewer bits (" + std::to_string(most) + " would fit)"
             : "raise it: not even one bit fits");
}

} // namespace

RobustEmbeddingResult EmbedRobust(const TriangleMesh& mesh, const SecretKey& key,
  const RobustEmbeddingOptions& options, const Progress& progress)
{
  CheckMessage(options.Message);
  const auto bits = static_cast<Index>(options.Message.size());
  RequireMemoryToEmbed(mesh.NumberOfVertices(), bits);
  const TriangleMesh oriented = Oriented(mesh);
  const SolidView view(oriented);
  const CarrierProblem problem(view, key, bits, options.Threads);
  const CarrierSet& carriers = problem.Carriers;
  const std::string code = CodeOf(DataOf(options.Message, key, carriers.CheckBits));
  const SurfaceMotion motion(oriented, problem, options.Threads);
  const RoundTrip store = options.Store ? options.Store : ExactRoundTrip(mesh);
  progress.Report(0.1);

  const double scale = view.Frame.Scale / BoundingBoxDiagonal(oriented.Points);
  double budget = PlannedPart * options.MaximumDistortion / scale;
  RobustEmbeddingResult result;
  RoundTripResult stored;
  EmbeddingPlan plan;
  for (int attempt = 0; attempt < MostAttempts; ++attempt)
  {
    plan = LargestAffordable(problem, code, budget);
    if (plan.Step < 0)
    {
      RefuseDistortion(oriented, key, options,
        attempt == 0 ? plan.Distortion * scale : result.Distortion, progress.Part(0.55, 1.0));
    }
    const double begin = 0.1 + 0.45 * attempt / MostAttempts;
    SurfaceMotion::Result moved =
      motion.Run(plan, progress.Part(begin, begin + 0.45 / MostAttempts));
    result.Rounds = std::move(moved.Rounds);
    stored = ReadAfterRoundTrip([&]() { return store(moved.Points); });
    result.Distortion = motion.Distortion(stored.Points);
    if (result.Distortion <= options.MaximumDistortion)
    {
      break;
    }
    // The response is not linear, so the next plan makes up for the excess of this one.
    budget *= std::min(0.95, options.MaximumDistortion / result.Distortion);
  }
  result.Points = stored.Points;
  result.Step = StepOfNumber(plan.Step);
  const RobustReading reading = ReadAfterRoundTrip(
    [&]()
    {
      result.Margin = motion.Margin(Oriented(stored.Mesh), plan);
      return ReadRobust(stored.Mesh, key, carriers, options.Threads, progress.Part(0.55, 1.0));
    });
  result.ExtractedMessage = reading.Message;
  result.Converged = reading.IsValid && reading.Message == options.Message &&
    result.Distortion <= options.MaximumDistortion;
  return result;
}

} // namespace spectralwatermark
