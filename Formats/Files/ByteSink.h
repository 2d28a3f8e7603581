// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief A file that takes bytes, plain or packed with gzip, and says whether it took all of them.
 */
#ifndef BrainShift_ByteSink_h
#define BrainShift_ByteSink_h

#include <cstddef>
#include <fstream>
#include <string>

namespace brainshift
{
/** Takes bytes one after the other. After the first failure it takes no more. */
class ByteSink
{
public:
  /** Opens a new file. `pack`: with gzip. */
  ByteSink(const std::string& fileName, bool pack);
  ~ByteSink();
  ByteSink(const ByteSink&) = delete;
  ByteSink& operator=(const ByteSink&) = delete;

  /** Takes bytes. False if the file takes no more. */
  bool write(const void* bytes, std::size_t count);

  /** Closes the file. Returns the reason of the first failure; empty if all bytes were taken. */
  std::string close();

private:
  void keepProblem();

  std::ofstream Plain;
  void* Packed = nullptr; // zlib's gzFile
  bool Packs;
  std::string Problem;
};
}

#endif
