// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/OMEZarr/ChunkWriter.h"

#include "Common/Problem.h"
#include "Formats/Files/SystemPath.h"
#include "Formats/Files/WholeFile.h"

#include <blosc.h>

#include <cerrno>
#include <filesystem>
#include <fstream>

namespace fs = std::filesystem;

namespace brainshift
{
std::string packedChunk(const std::string& bytes, std::size_t bytesOfNumber)
{
  constexpr std::size_t AnyBlock = 0;
  constexpr int Threads = 1; // chunks are packed beside each other
  std::string packed(bytes.size() + BLOSC_MAX_OVERHEAD, '\0');
  const int made = blosc_compress_ctx(ChunkEffort,
    bytesOfNumber > 1 ? BLOSC_SHUFFLE : BLOSC_NOSHUFFLE, bytesOfNumber, bytes.size(), bytes.data(),
    packed.data(), packed.size(), "zstd", AnyBlock, Threads);
  throwIfAny(made > 0 ? "" : "blosc cannot pack a chunk");
  packed.resize(static_cast<std::size_t>(made));
  return packed;
}

void writeEntry(const std::string& folder, const std::string& key, const std::string& bytes)
{
  const fs::path path = systemPath(folder + "/" + key);
  const fs::path beside = systemPath(folder + "/" + key + ".part");
  std::error_code error;
  fs::create_directories(path.parent_path(), error);
  withBeginning("entry '" + key + "' cannot be written: ", [&] {
    throwIfAny(error ? error.message() : std::string());
    errno = 0;
    std::ofstream file(beside, std::ios::binary);
    file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    file.close();
    const std::string reason = file ? std::string() : lastSystemError();
    if (reason.empty())
    {
      fs::rename(beside, path, error);
    }
    if (!reason.empty() || error)
    {
      const std::string why = reason.empty() ? error.message() : reason;
      fs::remove(beside, error);
      throw Problem(why);
    }
  });
}
}
