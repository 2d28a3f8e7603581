// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The DICOM files of a folder, and the series that their images make up.
#ifndef BrainShift_DICOMFolder_h
#define BrainShift_DICOMFolder_h

#include "Formats/DICOM/DICOMFile.h"

namespace brainshift
{
/** Images of one series, orientation, size and type: one volume, or one for each time. */
struct DICOMSeries
{
  /// What the user chooses by: number, description, modality, size and date. No two are alike.
  std::string name;
  std::vector<DICOMFrame> frames;
  /// What parts it from others of the same images, such as "EchoTime 20 ms"; empty if nothing does.
  std::string setting;
  /// The name of all these parts together, by which older states choose.
  std::string wholeName;
};

/** What lies in a folder. */
struct DICOMFolder
{
  std::vector<DICOMFile> files; ///< those that hold images
  std::vector<DICOMSeries> series;
  int damaged = 0;        ///< files whose headers cannot be read
  std::string noImage;    ///< why the file of the path shows nothing: the end of a sentence
  bool isStopped = false; ///< the user did not wait: files and series are not complete
};

/**
 * Whether a name leads to DICOM: a file that begins so, or a folder with such a file in it or in
 * its subfolders, down to the fourth level. It looks at no more than 1000 files.
 */
bool leadsToDICOM(const std::string& path);

/**
 * Reads all headers of a folder, on all cores. `path` names a folder, one of its files, or a
 * DICOMDIR. Of a folder without DICOM the subfolders are read, down to the fourth level.
 *
 * The first series is the one to show if nobody chooses: that of the file, else the one with the
 * most voxels. The others follow by their number.
 */
DICOMFolder readDICOMFolder(const std::string& path, const Progress& progress);

/**
 * Images that the headers count to the same series, but that are another entry of its list and
 * seem to be slices of the same volume: how many they are and which attributes part them. Ends of
 * sentences, one for each such entry.
 *
 * @param chosen one of the folder's series
 */
std::vector<std::string> partedNotes(const DICOMFolder& folder, const DICOMSeries& chosen);
}

#endif
