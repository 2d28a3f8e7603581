// SPDX-License-Identifier: BSD-3-Clause
#include "Common/HostMemory.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <limits>
#include <memory>
#include <sstream>

#ifdef __GLIBC__
#include <malloc.h>
#endif
#ifdef __linux__
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>
#endif

namespace brainshift
{
namespace
{
constexpr double AlwaysThere = 256e6; // bytes; too few to ask for
constexpr double Unlimited = std::numeric_limits<double>::infinity();

// The number after a word at the beginning of a line.
double numberAfter(const char* fileName, const std::string& word)
{
  std::ifstream file(fileName);
  double number = Unlimited;
  for (std::string line; std::getline(file, line);)
  {
    if (line.compare(0, word.size(), word) == 0)
    {
      std::istringstream(line.substr(word.size())) >> number;
      break;
    }
  }
  return number;
}

#ifdef __linux__
// What the address space of this process may still grow by.
double freeAddresses()
{
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY)
  {
    return Unlimited;
  }
  const double taken =
    numberAfter("/proc/self/statm", "") * static_cast<double>(sysconf(_SC_PAGESIZE));
  return std::max(static_cast<double>(limit.rlim_cur) - taken, 0.0);
}

// What the group of processes may still take: a container, or a job of a cluster.
double freeOfGroup()
{
  const double most = numberAfter("/sys/fs/cgroup/memory.max", "");
  const double taken = numberAfter("/sys/fs/cgroup/memory.current", "");
  const double files = numberAfter("/sys/fs/cgroup/memory.stat", "inactive_file "); // can be freed
  const bool known = std::isfinite(most) && std::isfinite(taken) && most > 0.0;
  return known ? std::max(most - taken + (std::isfinite(files) ? files : 0.0), 0.0) : Unlimited;
}
#endif

// Three digits, but all of those before the point.
std::string gigabytes(double bytes)
{
  std::ostringstream text;
  text.precision(bytes < 1e12 ? 3 : 15);
  text << (bytes < 1e12 ? bytes / 1e9 : std::round(bytes / 1e9)) << " GB";
  return text.str();
}
}

std::string sizeText(const glm::dvec3& sides)
{
  std::ostringstream text;
  text.precision(10);
  text << sides.x << " x " << sides.y << " x " << sides.z;
  return text.str();
}

double freeHostMemory()
{
#ifdef __linux__
  return std::min(freeMachineMemory(), freeAddresses());
#else
  return Unlimited;
#endif
}

double freeMachineMemory()
{
#ifdef __linux__
  constexpr double KiB = 1024.0;
  return std::min(numberAfter("/proc/meminfo", "MemAvailable:") * KiB, freeOfGroup());
#else
  return Unlimited;
#endif
}

std::string hostMemoryProblem(const std::string& what, double bytes)
{
  const double left = bytes <= AlwaysThere ? Unlimited : freeHostMemory();
  return bytes <= left ? std::string()
                       : what + " needs " + gigabytes(bytes) + " of memory, and " +
      gigabytes(left) + " are left; close other data or programs";
}

long long machineNumber()
{
  std::string name; // of the machine's last start
  std::getline(std::ifstream("/proc/sys/kernel/random/boot_id"), name);
  return static_cast<long long>(std::hash<std::string>()(name));
}

std::string sharedMemoryProblem(
  const std::string& what, const std::vector<ProcessNeed>& needs, std::size_t own, double left)
{
  double bytes = 0.0;
  for (const ProcessNeed& need : needs)
  {
    bytes += need.machine == needs[own].machine ? need.bytes : 0.0;
  }
  return bytes <= AlwaysThere || bytes <= left ? std::string()
                                               : what + " needs " + gigabytes(needs[own].bytes) +
      " of memory, together with other ranks of " + "its machine " + gigabytes(bytes) + ", and " +
      gigabytes(left) + " are left; close other data or programs";
}

void requireHostMemory(const std::string& what, double bytes)
{
  throwIfAny(hostMemoryProblem(what, bytes));
}

namespace
{
std::atomic<int> keeping = 0; // so many times

#ifdef __GLIBC__
// Memory of the process that is to come in pages of 2 MiB, if the system has any: a registration
// of two heads takes a third of a GB, page by page, and reads it everywhere at once.
void askForLargePages()
{
  constexpr std::size_t bytes = std::size_t(512) << 20;
  constexpr std::size_t page = std::size_t(2) << 20;
  void* place = std::malloc(bytes); // no page of it is taken before it is written
  void* from = place;
  std::size_t left = bytes;
  if (place && std::align(page, bytes - page, from, left))
  {
    madvise(from, left, MADV_HUGEPAGE);
  }
  std::free(place);
}
#endif

void keep([[maybe_unused]] bool kept)
{
#ifdef __GLIBC__
  // What glibc itself comes to after large pieces were given back; from a call on it stays so.
  constexpr int usualPiece = 32 << 20;
  constexpr int usualMappings = 65536;
  mallopt(M_MMAP_MAX, kept ? 0 : usualMappings);
  mallopt(M_MMAP_THRESHOLD, usualPiece);
  mallopt(M_TRIM_THRESHOLD, kept ? std::numeric_limits<int>::max() : 2 * usualPiece);
  if (kept)
  {
    askForLargePages();
  }
  else
  {
    malloc_trim(0);
  }
#endif
}
}

KeptMemory::KeptMemory()
{
  if (keeping++ == 0)
  {
    keep(true);
  }
}

KeptMemory::~KeptMemory()
{
  if (--keeping == 0)
  {
    keep(false);
  }
}
}
