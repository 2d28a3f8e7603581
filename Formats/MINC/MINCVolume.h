// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Volumes in MINC2 files (.mnc), through libminc.
 *
 * Their world is RAS, in mm. Whole numbers become real values, slice by slice, as the file says;
 * whole numbers of the classes "integer" and "label" stay as they are. MINC1 files are refused.
 */
#ifndef BrainShift_MINCVolume_h
#define BrainShift_MINCVolume_h

#include "Formats/Volumes/VolumeFile.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace brainshift
{
/** Whether a file exists and begins like HDF5 or netCDF, as MINC2 and MINC1 files do. */
bool isMINCFile(const std::string& fileName);

/** See VolumeFile. */
class MINCVolume : public VolumeFile
{
public:
  /** What an axis of the file is for. */
  enum class AxisUse
  {
    Space,
    Time,
    Components,
  };

  /** One axis of the file. */
  struct Axis
  {
    AxisUse use = AxisUse::Space;
    std::uint64_t count = 0;
  };

  std::string noun() const override { return "MINC volume"; }
  std::string readHeader(const std::string& fileName, VolumeHeader& header) override;
  std::string load(std::size_t volume, const Progress& progress, StoredVoxels& voxels) override;

private:
  std::string FileName;
  std::vector<Axis> Axes;    // the slowest first
  bool AreRealValues = true; // stored numbers are scaled
  VolumeHeader Header;
};
}

#endif
