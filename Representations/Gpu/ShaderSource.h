// SPDX-License-Identifier: BSD-3-Clause
// Assembles the files of Shaders/ into programs. From C++ come only #define lines.
#ifndef BrainShift_ShaderSource_h
#define BrainShift_ShaderSource_h

#include "vtkBrainShiftRepresentationsModule.h" // for the export macro

#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace brainshift
{
struct ShaderSource
{
  std::string vertex;
  std::string geometry; // empty: none
  std::string fragment;
};

constexpr int MaxLights = 8;
constexpr int BricksInBlock = 4; // a side; blocks of the presence map's bricks
constexpr int MaxClipPlanes = 16;
constexpr int MaxIsovalues = 32;
// Of the colour map: as many as a 12-bit CT has values; so many that none need blending, which
// would cost four reads.
constexpr int TransferEntries = 4096;
constexpr int MaxCorners = 8; // of a part of a picture
constexpr int MaxTissues = 4; // volumes that hide traced points

// How the samples of a ray become one colour; numbers as in vtkVolumeMapper::BlendModes.
enum class Blend
{
  Composite = 0,
  Maximum = 1,
  Minimum = 2,
  Average = 3,
  Additive = 4,
  Isosurface = 5,
  Slice = 6,
};
constexpr int BlendCount = 7;

// Where a sample's colour comes from.
enum class Coloring
{
  Mapped = 0,      // the colour map at the scalar
  Direct = 1,      // three numbers of the voxel
  OtherScalar = 2, // the colour map at another number of the voxel
};

// Variants of the ray caster; each combination is a program of its own.
struct RayCastVariant
{
  bool deformed = false; // the volume carries a lattice
  enum Light
  {
    Unshaded = 0,
    GradientsOnTheFly = 1,
    GradientTexture = 2,
    LightCount = 3,
  } light = Unshaded;
  Blend blend = Blend::Composite;
  Coloring coloring = Coloring::Mapped;
  bool regions = false;     // VTK's cropping regions, other than the middle one alone
  bool segmented = false;   // a segment is drawn alone
  bool counted = false;     // a third target tells the samples taken and skipped; Composite only
  bool sharedLight = false; // two samples share their light; Composite only, where there is light
  bool averaged = false;    // samples take averages of the colour map; Composite only
  bool compared = false;    // with a reference, red and green; Composite only
  bool cavity = false;      // part of which is ignored

  bool operator<(const RayCastVariant& other) const
  {
    const auto key = [](const RayCastVariant& variant) {
      return std::make_tuple(variant.deformed, variant.light, variant.blend, variant.coloring,
        variant.regions, variant.segmented, variant.counted, variant.sharedLight, variant.averaged,
        variant.compared, variant.cavity);
    };
    return key(*this) < key(other);
  }
};

// Variants of the slices' program.
struct SlicesVariant
{
  bool deformed = false; // the volume carries a lattice
  Coloring coloring = Coloring::Mapped;
  bool compared = false; // with a reference
  bool cavity = false;   // part of which is ignored

  bool operator<(const SlicesVariant& other) const
  {
    return std::tie(this->deformed, this->coloring, this->compared, this->cavity) <
      std::tie(other.deformed, other.coloring, other.compared, other.cavity);
  }
};

VTKBRAINSHIFTREPRESENTATIONS_EXPORT ShaderSource refineSource(bool masked);
VTKBRAINSHIFTREPRESENTATIONS_EXPORT ShaderSource invertSource();
VTKBRAINSHIFTREPRESENTATIONS_EXPORT ShaderSource rayCastSource(const RayCastVariant& variant);
VTKBRAINSHIFTREPRESENTATIONS_EXPORT ShaderSource compositeSource();
VTKBRAINSHIFTREPRESENTATIONS_EXPORT ShaderSource enlargeSource();
VTKBRAINSHIFTREPRESENTATIONS_EXPORT ShaderSource coverSource();
VTKBRAINSHIFTREPRESENTATIONS_EXPORT ShaderSource normalsSource();
VTKBRAINSHIFTREPRESENTATIONS_EXPORT ShaderSource blocksSource();
VTKBRAINSHIFTREPRESENTATIONS_EXPORT ShaderSource presenceSource(bool deformed);
VTKBRAINSHIFTREPRESENTATIONS_EXPORT ShaderSource proxySource();
VTKBRAINSHIFTREPRESENTATIONS_EXPORT ShaderSource slicesSource(const SlicesVariant& variant);
// `tissues`: volumes that hide points, 0 to MaxTissues.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT ShaderSource tracesSource(int tissues);
VTKBRAINSHIFTREPRESENTATIONS_EXPORT ShaderSource tracesOverSource();

// Every program the product can draw with, by name, for an offline compiler: of the ray caster's
// variants each with every file and every #define in use.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT std::vector<std::pair<std::string, ShaderSource>> allSources();
}

#endif
