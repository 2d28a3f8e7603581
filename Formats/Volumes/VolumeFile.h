// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What a format of volumes has to implement: where its voxels lie, and their numbers as the file
/// orders them. PlacedVolume does the rest for all formats alike.
#ifndef BrainShift_VolumeFile_h
#define BrainShift_VolumeFile_h

#include "Common/LabelTable.h"
#include "Common/Problem.h"
#include "Common/WorldAxes.h"
#include "vtkBrainShiftFormatsModule.h" // for the export macro
#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <functional>
#include <memory>

class vtkAbstractArray;
class vtkDataArray;
class vtkImageData;

namespace brainshift
{
/** value = slope * stored + intercept */
struct Rescaling
{
  double slope = 1.0;
  double intercept = 0.0;

  bool isNeeded() const { return this->slope != 1.0 || this->intercept != 0.0; }
};

/** Name of the point array that readers of volumes make. */
constexpr const char* ScalarsOfVolumes = "Intensity";

/** What the header of a file says. */
struct VolumeHeader
{
  glm::dmat4 worldFromVoxel{ 1.0 }; ///< mm, RAS, from a voxel's index in the file's order
  glm::ivec3 dimensions{ 0 };       ///< voxels along each axis, in the file's order
  int storedType = VTK_VOID;        ///< VTK's number of the type of a stored number
  int components = 1;               ///< numbers at each voxel of one volume
  /// Where it is needed, numbers become float32; of 4 bytes and more, other than float, double.
  Rescaling rescaling;
  std::vector<double> times{ 0.0 }; ///< of the volumes, s; at least one
  /// Whether the file says where the sides of the patient are. Otherwise the axes of the voxels
  /// stand for right, anterior and superior, which may be wrong.
  bool knowsSides = true;
  Template space = Template::None;   ///< where the file says that its RAS is that of a template
  std::vector<std::string> warnings; ///< ends of sentences, after the name of the file
  std::string unit;                  ///< of the numbers, such as mm2/s; empty: not said
  bool smallIsBright = false;        ///< whether stations show small numbers bright
  std::vector<Label> labels;         ///< names of values, where the file names them
  bool isLabelMap = false;           ///< whether the file says that its values are labels
  std::vector<std::string> componentNames; ///< as many as there are components, or none
  std::string note; ///< what was chosen of the file, and why: a sentence. Empty: nothing to say
  std::vector<vtkSmartPointer<vtkAbstractArray>> attached; ///< more field data of each volume
};

/** What a reader says of a file that does not know the sides, after the name of the file. */
constexpr const char* UnknownSidesWarning =
  "does not say where the sides of the patient are: left and right may be exchanged";

/** Voxels in the file's order: the extent of the image says which of the file's they are. */
struct StoredVoxels
{
  std::array<int, 6> wanted{};         ///< the extent that is needed; there may be more
  vtkSmartPointer<vtkImageData> image; ///< null: reading was stopped
  vtkSmartPointer<vtkDataArray> kept;  ///< what the image's numbers are a partOf; may be null
  int firstComponent = 0;              ///< of the volume that was asked for
  bool mayBeShown = false;             ///< whether nobody else keeps the numbers or changes them
  std::string warning; ///< on these voxels, as the header's: the end of a sentence. Empty: none

  /** Makes the image of all voxels from these numbers. */
  void show(const glm::ivec3& dimensions, vtkDataArray* numbers);

  /** Makes the image of the wanted voxels from these numbers. */
  void showWanted(vtkDataArray* numbers);
};

/** Some of the values of an array, which must live as long. */
vtkSmartPointer<vtkDataArray> partOf(vtkDataArray* numbers, vtkIdType first, vtkIdType count);

/** Times that grow by a step. A step that is no positive number counts as 1, a start as 0. */
std::vector<double> evenTimes(std::size_t count, double step, double start = 0.0);

/** When uneven or tilted slices are interpolated on an upright grid. */
enum class SliceResampling
{
  Never = 0,      ///< slices are shown as they are stored, as if they were upright and even
  Always = 1,     ///< wherever they are uneven or tilted
  WhereNeeded = 2 ///< where slices would be shown half a voxel or more from their position
};

/** What is read of a file with several resolutions (levels; 0 is the finest) or channels. */
struct PyramidChoice
{
  int level;       ///< -1: the finest that fits the limit
  double limitMiB; ///< of the numbers of one time step
  int channel;     ///< -1: all of them, as components
};

/** Receives the fraction that is done, 0 to 1. Returns false if the work is to stop. */
using Progress = std::function<bool(double fraction)>;

/** What is loaded of a volume of which a part is wanted. */
enum class Loads
{
  All,    ///< all voxels
  Slices, ///< the slices of the part, along the file's last axis
  Part    ///< the part
};

/** One file, or one series of files, at a time: first its header, then its voxels. */
class VTKBRAINSHIFTFORMATS_EXPORT VolumeFile
{
public:
  VolumeFile() = default;
  virtual ~VolumeFile() = default;
  VolumeFile(const VolumeFile&) = delete;
  VolumeFile& operator=(const VolumeFile&) = delete;

  /** What stands before a name in a sentence, such as "NIfTI file". */
  virtual std::string noun() const = 0;

  /**
   * Reads the header, or throws the end of a sentence, after the name and without a full stop. It
   * may not have been read before, or have changed since.
   */
  virtual void readHeader(const std::string& fileName, VolumeHeader& header) = 0;

  /** Bytes that `load` takes beside the output. 0 if the voxels are in memory already. */
  virtual double storedBytes(const VolumeHeader& header) const;

  /** What `load` takes memory for if a part is wanted. Default: all voxels. */
  virtual Loads loads() const { return Loads::All; }

  /**
   * Whether `load` also reads the part alone. Otherwise it unpacks what lies before, so that all
   * parts one after another take far longer than the whole. Default: unless it loads all voxels.
   */
  virtual bool readsNothingElse() const { return this->loads() != Loads::All; }

  /**
   * Reads the voxels of one of the header's times, or throws the end of a sentence. The voxels get
   * no image if `progress` says stop.
   */
  virtual void load(std::size_t volume, const Progress& progress, StoredVoxels& voxels) = 0;

  ///@{
  /**
   * For files with several volumes, such as the series of a folder or the layers of a segmentation:
   * their names as the last readHeader found them, and which of them the next readHeader takes.
   * Default: empty, the first.
   */
  virtual std::vector<std::string> choices() const { return {}; }
  virtual void choose(const std::string& /*name*/) {}
  ///@}

  /** For uneven or tilted slices. Default: WhereNeeded. */
  virtual void setResampling(SliceResampling /*resampling*/) {}

  /** Whether colours become one number, their brightness. Default: false. */
  virtual void setLuminance(bool /*luminance*/) {}

  /** For files with several levels or channels. Default: there are none. */
  virtual void setPyramid(const PyramidChoice& /*pyramid*/) {}

  /** Receives the fraction of the headers that readHeader has read. Default: no progress. */
  virtual void setScanProgress(const Progress& /*progress*/) {}

  /** Path of the first file of what the last readHeader took; empty if it is the file itself. */
  virtual std::string firstFile() const { return {}; }
};

/** A format of volumes, for the readers. CONTRIBUTING.md has the recipe for a new one. */
struct VolumeFormat
{
  const char* name;                           ///< such as "NRRD"
  bool (*isOne)(const std::string& fileName); ///< whether a file is there and begins like one
  std::unique_ptr<VolumeFile> (*make)();
};

/** For VolumeFormat::make. */
template <typename File>
std::unique_ptr<VolumeFile> makeVolumeFile()
{
  return std::make_unique<File>();
}

/** All formats of volumes. brainshift_add_format writes this list. */
VTKBRAINSHIFTFORMATS_EXPORT const std::vector<const VolumeFormat*>& volumeFormats();
}

#endif
