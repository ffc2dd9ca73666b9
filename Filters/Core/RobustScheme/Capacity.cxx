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

// The part of the budget that a message may use that is not known yet: the cost depends on its bits by some
// percent.
constexpr double SafePart = 0.9;

// Finds which messages fit a mesh and a budget, by embedding one with the smallest step.
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

  // Each trial takes longer than all with fewer words together: so the number doubles every time, and is
  // bisected only below what was too many.
  Index MostWords(Index tooMany, const Progress& progress) const
  {
    Index most = WordsOf(1) - 1;
    double begin = 0.0;
    while (tooMany - most > 1)
    {
      const Index words = std::min(2 * most, (most + tooMany) / 2);
      const double end = begin + (1.0 - begin) / 4.0; // the number of trials is not known
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
      const std::string code(carriers, '0'); // any will do: it is whitened
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
      return false; // waves that cannot be told apart
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
