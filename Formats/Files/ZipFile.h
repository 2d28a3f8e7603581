// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Zip files: reads entries that are stored or deflated, also of files of more than 4 GiB (zip64),
/// and writes stored ones. Faults are thrown as a Problem: the end of a sentence.
#ifndef BrainShift_ZipFile_h
#define BrainShift_ZipFile_h

#include <cstdint>
#include <optional>
#include <ostream>
#include <string>
#include <unordered_map>
#include <vector>

namespace brainshift
{
/** The entries of a zip file by their names, with slashes; folders are none. Several threads may
 * read at once. */
class ZipFile
{
public:
  /** Reads the directory of a file. */
  explicit ZipFile(const std::string& fileName);

  /** The names of all entries, by the alphabet. */
  std::vector<std::string> names() const;

  /** Bytes of an entry, unpacked; none if it is not there. */
  std::optional<std::uint64_t> size(const std::string& name) const;

  /**
   * Bytes of an entry that is there: `count` from `offset` on, all within its size. A part of a
   * packed entry is refused. The checksum of a whole entry is compared.
   */
  std::string part(const std::string& name, std::uint64_t offset, std::uint64_t count) const;

private:
  struct Entry
  {
    std::uint64_t header = 0; // where its local header begins
    std::uint64_t packed = 0; // bytes
    std::uint64_t size = 0;   // bytes, unpacked
    std::uint32_t checksum = 0;
    int method = 0;
    bool isEncrypted = false;
  };

  std::uint64_t addEntry(const std::string& bytes, std::uint64_t at);
  std::uint64_t beginOf(const Entry& entry) const;
  static void takeLargeNumbers(const std::string& extra, Entry& entry);

  std::string FileName;
  std::uint64_t FileSize;
  std::unordered_map<std::string, Entry> Entries;
};

/** A file for writeZip. */
struct NamedBytes
{
  std::string name;
  std::vector<char> bytes;
};

/** Writes files, stored, as a zip file of up to 4 GiB. */
void writeZip(const std::vector<NamedBytes>& files, std::ostream& to);
}

#endif
