// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The entries of a zarr store by their keys: a folder, or a zip file.
///
/// A key is a path with slashes below the top of the store, such as "0/zarr.json". None leads out
/// of it. Faults are thrown as a Problem: the end of a sentence about the entry.
#ifndef BrainShift_ZarrStore_h
#define BrainShift_ZarrStore_h

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace brainshift
{
/** Several threads may read at once. */
class ZarrStore
{
public:
  ZarrStore() = default;
  virtual ~ZarrStore() = default;
  ZarrStore(const ZarrStore&) = delete;
  ZarrStore& operator=(const ZarrStore&) = delete;

  /** Bytes of an entry; none if it is not there. */
  virtual std::optional<std::uint64_t> size(const std::string& key) const = 0;

  /** Bytes of an entry that is there: `count` from `offset` on, all within its size. */
  virtual std::string part(
    const std::string& key, std::uint64_t offset, std::uint64_t count) const = 0;

  /**
   * When an entry was written, in ticks of the file system's clock; none if it is not there. An
   * archive gives 0: its checksums tell.
   */
  virtual std::optional<std::int64_t> written(const std::string& key) const = 0;

  /** A whole entry of up to `limit` bytes; none if it is not there. */
  std::optional<std::string> read(const std::string& key, std::uint64_t limit) const;
};

/**
 * The store that a user means by a folder, by a file of metadata in it (zarr.json, .zattrs, .zgroup
 * or .zarray), or by a zip file. Throws the end of a sentence about the name.
 */
std::unique_ptr<ZarrStore> openZarrStore(const std::string& fileName);

/** A folder as a store, whatever is in it. */
std::unique_ptr<ZarrStore> openFolderStore(const std::string& folder);

/** Whether a name is one that openZarrStore takes, and there is metadata of zarr. */
bool isZarrStore(const std::string& fileName);

/** The key of a path in a group, both without slashes at their ends. The group may be empty. */
std::string keyIn(const std::string& group, const std::string& name);

/**
 * Throws the end of a sentence unless a path of the metadata remains in its group: words between
 * slashes that are neither empty nor "." nor "..".
 */
void requireInside(const std::string& path);
}

#endif
