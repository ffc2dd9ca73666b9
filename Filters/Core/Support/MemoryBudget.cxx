// SPDX-License-Identifier: BSD-3-Clause
#include "Core/Support/MemoryBudget.h"

#include "Core/Support/Errors.h"
#include "Core/Support/Text.h"

#include <algorithm>
#include <iomanip>
#include <limits>
#include <sstream>

#ifdef __linux__
#include <sys/resource.h>
#include <unistd.h>

#include <fstream>
#endif

namespace spectralwatermark
{

namespace
{

constexpr double Unlimited = std::numeric_limits<double>::infinity();

#ifdef __linux__

// The number that a file begins with. Infinite when the file says "max" or does not exist.
double NumberIn(const std::string& path)
{
  std::ifstream file(path);
  double number = 0.0;
  if (!(file >> number))
  {
    return Unlimited;
  }
  return number;
}

// The number after `name` in a file of lines "name number"; `otherwise` if there is no such line.
double NumberNamed(const std::string& path, const std::string& name, double otherwise)
{
  std::ifstream file(path);
  std::string line;
  while (std::getline(file, line))
  {
    std::istringstream words(line);
    std::string first;
    double number = 0.0;
    if (words >> first >> number && first == name)
    {
      return number;
    }
  }
  return otherwise;
}

double FreeOfMachine()
{
  constexpr double kilo = 1024.0;
  const std::string path = "/proc/meminfo";
  return kilo *
    (NumberNamed(path, "MemAvailable:", Unlimited) + NumberNamed(path, "SwapFree:", 0.0));
}

double FreeOfAddresses()
{
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY)
  {
    return Unlimited;
  }
  const double used = NumberIn("/proc/self/statm") * static_cast<double>(sysconf(_SC_PAGESIZE));
  return static_cast<double>(limit.rlim_cur) - used;
}

// The names of the files of one version of control groups.
struct GroupFiles
{
  std::string Root;
  std::string Limit;
  std::string Usage;
  // The name, in memory.stat, of the cache that the system reclaims when memory runs short.
  std::string Cache;
};

// A group's limit also holds for the groups inside it, so every group on the path counts. In a
// container the path may be the one that the host sees: folders that do not exist set no limit, and
// the container's own group is the root.
double FreeOfGroups(std::string path, const GroupFiles& names)
{
  double free = Unlimited;
  for (;; path.erase(path.rfind('/')))
  {
    const std::string folder = names.Root + path + "/";
    const double limit = NumberIn(folder + names.Limit);
    if (limit < Unlimited)
    {
      free = std::min(free,
        limit - NumberIn(folder + names.Usage) +
          NumberNamed(folder + "memory.stat", names.Cache, 0.0));
    }
    if (path.empty())
    {
      return free;
    }
  }
}

#endif

std::string Amount(double bytes)
{
  constexpr double giga = 1e9;
  return TextOf(std::fixed, std::setprecision(bytes < 10.0 * giga ? 1 : 0),
    std::max(0.0, bytes) / giga, " GB");
}

} // namespace

#ifdef __linux__

double AvailableMemoryOfGroups(const std::string& root)
{
  const GroupFiles first{ root + "/sys/fs/cgroup/memory", "memory.limit_in_bytes",
    "memory.usage_in_bytes", "total_inactive_file" };
  const GroupFiles second{ root + "/sys/fs/cgroup", "memory.max", "memory.current",
    "inactive_file" };
  double free = Unlimited;
  std::ifstream groups(root + "/proc/self/cgroup");
  std::string number;
  // Empty for version 2.
  std::string controllers;
  std::string path;
  while (std::getline(groups, number, ':') && std::getline(groups, controllers, ':') &&
    std::getline(groups, path))
  {
    if (controllers.empty())
    {
      free = std::min(free, FreeOfGroups(path, second));
    }
    else if (("," + controllers + ",").find(",memory,") != std::string::npos)
    {
      free = std::min(free, FreeOfGroups(path, first));
    }
  }
  return free;
}

double AvailableMemory()
{
  return std::min({ FreeOfMachine(), FreeOfAddresses(), AvailableMemoryOfGroups() });
}

#else

double AvailableMemoryOfGroups(const std::string&)
{
  return Unlimited;
}

double AvailableMemory()
{
  return Unlimited;
}

#endif

void RequireMemory(double bytes, const std::string& work, const std::string& advice,
  const std::string& parameter)
{
  // Less than this, about what a program starts with, is not worth a check.
  constexpr double always = 50e6;
  if (bytes <= always)
  {
    return;
  }
  const double available = AvailableMemory();
  if (bytes > available)
  {
    throw InvalidInput(parameter,
      work + " need about " + Amount(bytes) + " of memory, and " + Amount(available) + " are free",
      advice);
  }
}

void RequireMemoryForTriangles(Index triangles, double bytesOfTriangle, const std::string& advice,
  const std::string& parameter)
{
  RequireMemory(bytesOfTriangle * static_cast<double>(triangles),
    std::to_string(triangles) + " triangles", advice, parameter);
}

} // namespace spectralwatermark
