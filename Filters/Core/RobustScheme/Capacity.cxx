// SPDX-License-Identifier: BSD-3-Clause
#include "Core/RobustScheme/Capacity.h"

#include "Core/Mesh/Measures.h"
#include "Core/Mesh/Orientation.h"
#include "Core/Payload/GolayCode.h"
#include "Core/RobustScheme/CarrierSet.h"
#include "Core/RobustScheme/EmbeddingPlan.h"
#include "Core/RobustScheme/SolidResponse.h"
#include "Core/RobustScheme/SurfaceMotion.h"
#include "Core/Support/MemoryBudget.h"

#include <algorithm>
#include <string>

namespace spectralwatermark
{

namespace
{

// The share of the distortion limit that a trial message may use. The cost depends on the bits of
// the message by a few percent, and the bits to be embedded are not known yet.
constexpr double SafePart = 0.9;

// Finds how many code words fit a mesh and a distortion limit, by embedding trial messages with the
// smallest step.
class CapacitySearch
{
public:
  CapacitySearch(const TriangleMesh& oriented, const SecretKey& key, double maximumDistortion,
    int threads)
    : Mesh(oriented)
    , Key(key)
    , MaximumDistortion(maximumDistortion)
    , Threads(threads)
    , View(oriented)
  {
  }

  // A trial takes longer than all trials with fewer words together. The number of words is
  // therefore doubled each time, and bisected only below a number that was too large.
  Index MostWords(Index tooMany, const Progress& progress) const
  {
    Index most = WordsOf(1) - 1;
    double begin = 0.0;
    while (tooMany - most > 1)
    {
      const Index words = std::min(2 * most, (most + tooMany) / 2);
      // The number of trials is unknown, so each gets a quarter of the remaining progress.
      const double end = begin + (1.0 - begin) / 4.0;
      (this->Fits(words, progress.Part(begin, end)) ? most : tooMany) = words;
      begin = end;
    }
    return most;
  }

private:
  bool Fits(Index words, const Progress& progress) const
  {
    const Index carriers = words * GolayCodeBits;
    const Index vertices = this->Mesh.NumberOfVertices();
    if (carriers + FrameMoments >= vertices ||
      MemoryOfEmbedding(vertices, carriers) > AvailableMemory())
    {
      return false;
    }
    try
    {
      const CarrierProblem problem(this->View, this->Key, MessageBitsOf(words), this->Threads);
      progress.Report(0.3);
      // Any code will do, because it is whitened.
      const std::string code(carriers, '0');
      const EmbeddingPlan plan = PlanWithStep(0, problem, code);
      const double scale = this->View.Frame.Scale / BoundingBoxDiagonal(this->Mesh.Points);
      return plan.Distortion * scale <= this->MaximumDistortion &&
        SurfaceMotion(this->Mesh, problem, this->Threads)
          .Run(plan, progress.Part(0.3, 1.0))
          .Rounds.back()
          .Distortion <= SafePart * this->MaximumDistortion;
    }
    catch (const InvalidInput&)
    {
      // The waves cannot be told apart on this surface.
      return false;
    }
  }

  const TriangleMesh& Mesh;
  const SecretKey& Key;
  double MaximumDistortion;
  int Threads;
  SolidView View;
};

} // namespace

Index MostWords(const TriangleMesh& oriented, const SecretKey& key, double maximumDistortion,
  Index tooMany, int threads, const Progress& progress)
{
  return CapacitySearch(oriented, key, maximumDistortion, threads).MostWords(tooMany, progress);
}

Index CapacityOf(const TriangleMesh& mesh, const SecretKey& key, double maximumDistortion,
  int threads, const Progress& progress)
{
  const Index words = MostWords(Oriented(mesh), key, maximumDistortion, WordsOf(LargestMessage) + 1,
    threads, progress);
  progress.Report(1.0);
  return MessageBitsOf(words);
}

} // namespace spectralwatermark
