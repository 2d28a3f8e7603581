// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Assembles the files of Shaders/ into programs. Only #define lines come from C++.
#ifndef BrainShift_ShaderSource_h
#define BrainShift_ShaderSource_h

#include "vtkBrainShiftRepresentationsModule.h" // for the export macro

#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace brainshift
{
/// The stages of a program.
struct ShaderSource
{
  std::string vertex;
  std::string geometry; ///< Empty: there is none.
  std::string fragment;
};

constexpr int MaxLights = 8;
constexpr int BricksInBlock = 4; ///< A side: bricks of the presence map in one block.

///@{
/// Where field.glsl finds corrections, see Representations/Field/FineCells.h.
constexpr int SlotSide = 3;     ///< Fine nodes of a slot, a side.
constexpr int SlotsInRow = 64;  ///< Slots along x in the texture of corrections.
constexpr int RowsInLayer = 64; ///< Rows of slots along y.
constexpr int CodeOfSlot = 16;  ///< A cell's code: this times its first slot, plus slots a side.
/// Of one layer of slots: four half floats each.
constexpr int CorrectionLayerBytes = SlotsInRow * RowsInLayer * SlotSide * SlotSide * SlotSide * 8;
///@}

constexpr int StreamedSide = 32; ///< Voxels of a brick of a finer level, a side.
constexpr int SlotBorder = 2;    ///< Voxels of its neighbours around it: light looks one further.

constexpr int MaxClipPlanes = 16;
constexpr int MaxIsovalues = 32;

/// Colours of the colour map: as many as a 12-bit CT has values. With so many, neighbours need no
/// blending, which would cost four reads.
constexpr int TransferEntries = 4096;

constexpr int MostStepDoublings = 2;                ///< Of the step along rays, while moving.
constexpr int TransferRows = MostStepDoublings + 1; ///< Of the colour map: one for each step.
constexpr int MaxCorners = 8;                       ///< Of a part of a picture.

/// Pixels from a first hit within which tissue hides light from it.
constexpr int MostOcclusionPixels = 96;
constexpr int MaxTissues = 4; ///< Volumes that hide traced points.

/// How the samples of a ray become one colour; numbers as in vtkVolumeMapper::BlendModes.
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

/// Where a sample's colour comes from.
enum class Coloring
{
  Mapped = 0,      ///< The colour map at the scalar.
  Direct = 1,      ///< Three numbers of the voxel.
  OtherScalar = 2, ///< The colour map at another number of the voxel.
};

/// What the opacity of a sample depends on.
enum class Opacity
{
  Scalar = 0,   ///< The opacity curve at the scalar.
  Gradient = 1, ///< That, times gradient opacity.
  Table = 2,    ///< A 2D transfer function of scalar and gradient, which gives the colour, too.
};

/// Variants of the ray caster. Each combination is a program of its own.
struct RayCastVariant
{
  bool deformed = false; ///< The volume carries a lattice.
  enum Light
  {
    Unshaded = 0,
    GradientsOnTheFly = 1,
    GradientTexture = 2,
    LightCount = 3,
  } light = Unshaded;
  Blend blend = Blend::Composite;
  Coloring coloring = Coloring::Mapped;
  bool regions = false;              ///< Cropping keeps other regions than the middle one.
  bool segmented = false;            ///< A segment is drawn alone.
  bool counted = false;              ///< A third target counts samples; Composite only.
  bool sharedLight = false;          ///< Two samples share their light; Composite and shaded only.
  bool averaged = false;             ///< Samples take averages of the colour map; Composite only.
  bool compared = false;             ///< Drawn with a reference, in two colours; Composite only.
  bool cavity = false;               ///< The comparison ignores a cavity.
  Opacity opacity = Opacity::Scalar; ///< Others: Composite only, not compared, no GradientTexture.
  bool evidence = false;             ///< Evidence is shown; Composite, Isosurface and Slice only.
  bool removed = false;              ///< Tissue of a resection is left out.
  bool tumour = false;               ///< The tumour of a resection is marked.
  bool streamed = false; ///< Bricks of a finer level; Composite, Mapped, no other opacity, alone.
  bool asks = false;     ///< Rays ask for bricks; streamed and not counted only.

  bool operator<(const RayCastVariant& other) const
  {
    const auto key = [](const RayCastVariant& variant) {
      return std::make_tuple(variant.deformed, variant.light, variant.blend, variant.coloring,
        variant.regions, variant.segmented, variant.counted, variant.sharedLight, variant.averaged,
        variant.compared, variant.cavity, variant.opacity, variant.evidence, variant.removed,
        variant.tumour, variant.streamed, variant.asks);
    };
    return key(*this) < key(other);
  }
};

/// Variants of the program for slices.
struct SlicesVariant
{
  bool deformed = false; ///< The volume carries a lattice.
  Coloring coloring = Coloring::Mapped;
  bool compared = false; ///< Drawn with a reference.
  bool cavity = false;   ///< The comparison ignores a cavity.
  bool evidence = false; ///< Evidence is shown.
  bool removed = false;  ///< Tissue of a resection is dark.
  bool tumour = false;   ///< The tumour of a resection is marked.
  bool streamed = false; ///< Bricks of a finer level; Mapped, not compared.

  bool operator<(const SlicesVariant& other) const
  {
    const auto key = [](const SlicesVariant& variant) {
      return std::make_tuple(variant.deformed, variant.coloring, variant.compared, variant.cavity,
        variant.evidence, variant.removed, variant.tumour, variant.streamed);
    };
    return key(*this) < key(other);
  }
};

///@{
/// The program of that name in Shaders/README.md. `masked`: the strokes have a mask. `deformed`:
/// the volume carries a lattice. `occluded`: grooves are darker. `tissues`: volumes that hide
/// points, 0 to MaxTissues.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT ShaderSource refineSource(bool masked);
VTKBRAINSHIFTREPRESENTATIONS_EXPORT ShaderSource invertSource();
VTKBRAINSHIFTREPRESENTATIONS_EXPORT ShaderSource rayCastSource(const RayCastVariant& variant);
VTKBRAINSHIFTREPRESENTATIONS_EXPORT ShaderSource compositeSource(bool occluded);
VTKBRAINSHIFTREPRESENTATIONS_EXPORT ShaderSource enlargeSource();
VTKBRAINSHIFTREPRESENTATIONS_EXPORT ShaderSource coverSource();
VTKBRAINSHIFTREPRESENTATIONS_EXPORT ShaderSource occlusionSource();
VTKBRAINSHIFTREPRESENTATIONS_EXPORT ShaderSource smoothOcclusionSource();
VTKBRAINSHIFTREPRESENTATIONS_EXPORT ShaderSource normalsSource();
VTKBRAINSHIFTREPRESENTATIONS_EXPORT ShaderSource blocksSource();
VTKBRAINSHIFTREPRESENTATIONS_EXPORT ShaderSource presenceSource(bool deformed);
VTKBRAINSHIFTREPRESENTATIONS_EXPORT ShaderSource proxySource();
VTKBRAINSHIFTREPRESENTATIONS_EXPORT ShaderSource slicesSource(const SlicesVariant& variant);
VTKBRAINSHIFTREPRESENTATIONS_EXPORT ShaderSource sliceBricksSource(bool deformed);
VTKBRAINSHIFTREPRESENTATIONS_EXPORT ShaderSource tracesSource(int tissues);
VTKBRAINSHIFTREPRESENTATIONS_EXPORT ShaderSource tracesOverSource();
///@}

/// The #define lines that field.glsl needs.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT std::string fieldDefines();

/// Programs by name, for an offline compiler. Among the ray caster's variants, each file and each
/// #define is used at least once.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT std::vector<std::pair<std::string, ShaderSource>> allSources();
}

#endif
