// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Everything that one picture of a volume depends on, in groups.
///
/// Each group is filled by one function, which is named beside it. Texture coordinates are those of
/// the texture of scalars. A mapping "bFromA" with a "bOfAZero" is a scale and a shift: b = a *
/// bFromA + bOfAZero.
#ifndef BrainShift_RayCastScene_h
#define BrainShift_RayCastScene_h

#include "Filters/Deformation/FieldChange.h"
#include "Representations/Gpu/ShaderSource.h"
#include "Representations/Scene/ImageArea.h"
#include "Representations/Scene/PlacedReference.h"

class vtkTextureObject;

namespace brainshift
{
class DeformedPresence;
class Program;
struct RayCastScene;

/// The lights of a renderer, as the shaders take them.
struct SceneLights
{
  bool headlight = false;      ///< The only light is at the eye.
  std::vector<float> position; ///< 4 numbers each: world, mm; w = 0: direction towards the light.
  std::vector<float> color;    ///< Diffuse colour times intensity, 3 numbers each.
  std::vector<float> specular; ///< Specular colour times intensity, 3 numbers each.
};

/// Camera, light and position of the volume. Filled by frameOf (SceneFrame.h).
struct SceneFrame
{
  glm::dmat4 clipFromWorld{ 1.0 };
  glm::dmat4 worldFromTexture{ 1.0 };
  glm::dvec3 mmFromTexture{ 1.0 }; ///< Along the volume's axes, before the actor's scale.
  bool tile = false;               ///< The image is a part of a picture larger than the window.
  SceneLights lights;
};

/// What is added to the offset field where a straight line between its nodes is not exact enough,
/// see Representations/Field/FineCells.h.
struct SceneCorrections
{
  vtkTextureObject* codes = nullptr;  ///< Where a cell's corrections are; null: there are none.
  vtkTextureObject* values = nullptr; ///< Lattice cells.
};

/// Offset field and the space that tissue can reach. Filled by restField or bentField
/// (FieldPlace.h), to which DeviceDeformation::update adds textures and the hull.
struct SceneField
{
  vtkTextureObject* offsets = nullptr; ///< Null: the volume carries no deformation.
  SceneCorrections corrections;
  glm::dvec3 fieldFromTexture{ 1.0 }; ///< Texture coordinates of the offset field.
  glm::dvec3 fieldOfTextureZero{ 0.0 };
  glm::dvec3 texel{ 1.0 };              ///< Step for derivatives, offset field's coordinates.
  glm::dvec3 latticeFromTexture{ 1.0 }; ///< Lattice coordinates: cells.
  glm::dvec3 latticeOfTextureZero{ 0.0 };
  SlabHull moved;             ///< Where tissue may have moved, lattice coordinates.
  glm::dvec3 spaceLow{ 0.0 }; ///< The box that tissue can reach, texture coordinates.
  glm::dvec3 spaceHigh{ 1.0 };
};

/// Where the colour of a sample comes from.
struct SceneColoring
{
  Coloring source = Coloring::Mapped;
  vtkTextureObject* colors = nullptr;        ///< For Coloring::Direct.
  vtkTextureObject* scalars = nullptr;       ///< For Coloring::OtherScalar.
  glm::dvec2 transferFromScalar{ 1.0, 0.0 }; ///< Stored `scalars` to map coordinate: scale, shift.
};

/// The only segment that is drawn, if not all tissue is.
struct SceneSegment
{
  vtkTextureObject* fractions = nullptr; ///< Null: all tissue is drawn.
  glm::dvec3 voxel{ 1.0 };               ///< One voxel of `fractions`, texture coordinates.
  glm::dvec2 cutGradient{ 1.0, 0.0 };    ///< Stored scalar to the weight of the edge in light.
};

/// What makes opacity depend on gradients. Steepness: see Tissue/SteepnessTexture.h.
struct SceneSteepness
{
  Opacity opacity = Opacity::Scalar;
  vtkTextureObject* entries = nullptr;       ///< Null for Opacity::Scalar.
  glm::dvec3 step{ 1.0 };                    ///< One voxel as VTK counts it, texture coordinates.
  glm::dvec3 fromGradient{ 1.0 };            ///< Factors on a gradient of stored scalars.
  glm::dvec2 entryFromScalar{ 1.0, 0.0 };    ///< Stored scalar to column: scale, shift.
  glm::dvec2 entryFromSteepness{ 1.0, 0.0 }; ///< Steepness to row: scale, shift.
  double stepMm = 1.0;                       ///< Step that the opacities hold for.
};

constexpr float OpaqueStep = 0.9f; ///< A step of this opacity hides nearly all that is behind.

/// Textures of the volume at rest. Filled by TissueTextures::update.
struct SceneTissue
{
  vtkTextureObject* scalars = nullptr;
  vtkTextureObject* normals = nullptr;       ///< Null: gradients are computed at each sample.
  vtkTextureObject* transfer = nullptr;      ///< Colours and opacities.
  vtkTextureObject* transferSums = nullptr;  ///< Null unless the opacity curve is steep.
  glm::dvec2 transferFromScalar{ 1.0, 0.0 }; ///< Stored scalar to map coordinate: scale, shift.
  glm::dvec2 visibleScalars{ 0.0, 1.0 };     ///< Stored scalars beyond these are invisible.
  glm::dvec3 volumeLow{ 0.0 };               ///< The volume's box, rest frame, texture coordinates.
  glm::dvec3 volumeHigh{ 1.0 };
  glm::dvec3 voxel{ 1.0 }; ///< One voxel, texture coordinates.
  double stepMm = 1.0;     ///< Step along the ray that the user asked for.
  Blend blend = Blend::Composite;
  bool shaded = false;
  double largestOpacity = 0.0;               ///< Of one step at any value.
  glm::dvec4 material{ 0.0, 1.0, 0.0, 1.0 }; ///< Ambient, diffuse, specular, specular power.
  SceneColoring coloring;
  SceneSegment segment;
  SceneSteepness steepness;

  /// Whether rays end inside the tissue, soon after its surface.
  bool raysEndSoon() const
  {
    return this->largestOpacity >= OpaqueStep && this->blend == Blend::Composite;
  }
};

/// Bricks of a finer level of the volume. Filled by StreamedBricks::upload.
struct SceneBricks
{
  vtkTextureObject* pages = nullptr; ///< Null: no finer level is drawn.
  vtkTextureObject* atlas = nullptr;
  glm::dvec3 voxels{ 0.0 };           ///< Of the finer level, a side.
  glm::dvec3 voxelFromTexture{ 1.0 }; ///< Its voxels.
  glm::dvec3 voxelOfTextureZero{ 0.0 };
  glm::ivec2 seed{ 0 };     ///< Which bricks rays ask for, of several.
  std::int64_t changes = 0; ///< Counts changes of what is there, but for what `arrived`.
  std::vector<int> arrived; ///< Bricks that came since the last picture, x fastest.
  bool asks = false;        ///< Rays ask for bricks.
};

/// Bricks of the deformed frame in which something can be seen. Filled by
/// DeviceTissue::updateBricks.
struct SceneSkipping
{
  bool allowed = true;                  ///< The user wants it, and the picture stays the same.
  DeformedPresence* presence = nullptr; ///< Which bricks are occupied.
  glm::dvec3 textureFromBrick{ 1.0 };   ///< Bricks are counted from the first voxel.
  glm::dvec3 textureOfBrickZero{ 0.0 };
  glm::dvec3 firstBrick{ 0.0 }; ///< First brick of the presence map.
};

/// Clipping planes and cropping. Filled by cutsOf or cutsOfReference (VolumeChoices.h).
struct SceneCuts
{
  std::vector<float> clipPlanes;  ///< 4 numbers each, texture coordinates; kept: dot + w >= 0.
  std::vector<float> partPlanes;  ///< As clipPlanes: the part that this rank draws; may be empty.
  std::vector<double> partTissue; ///< The box (mm) of all that it draws of the volume, likewise.
  glm::dvec3 spaceLow{ 0.0 };     ///< What cropping leaves of the field's space.
  glm::dvec3 spaceHigh{ 1.0 };
  glm::dvec3 cropLow{ -1e6 }; ///< The only region that cropping leaves, texture coordinates.
  glm::dvec3 cropHigh{ 1e6 };
  bool regions = false;        ///< Other regions than the middle one are kept: `regionFlags`.
  int regionFlags = 0;         ///< Of VTK's 27 regions: bit x + 3 y + 9 z.
  glm::dvec3 regionLow{ 0.0 }; ///< Between the cropping planes, texture coordinates.
  glm::dvec3 regionHigh{ 1.0 };
};

/// What single blend modes need. Filled by blendingOf (VolumeChoices.h).
struct SceneBlending
{
  std::vector<float> isovalues;                ///< Stored scalars, ascending.
  glm::dvec2 fractionFromScalar{ 1.0, 0.0 };   ///< Stored scalar to fraction of the array's range.
  glm::dvec2 averagedScalars{ 0.0, 1.0 };      ///< Stored scalars that the average takes.
  glm::dvec4 slicePlane{ 0.0, 0.0, 1.0, 0.0 }; ///< Texture coordinates.
};

constexpr int FarPixel = 1 << 20; ///< Beyond any picture.

/// The picture that is wanted, and how it is sampled. Filled by Picture.
struct SceneImage
{
  glm::ivec2 size{ 0 }; ///< Pixels.
  /// The pixels that rays are cast for: a box, unless a part of a picture is cast anew.
  PixelPart part{ {}, { glm::ivec2(-FarPixel), glm::ivec2(FarPixel) } };
  bool skips = true;         ///< Rays leap over empty bricks.
  int stepDoublings = 0;     ///< How often the step was doubled while moving.
  bool jitter = false;       ///< Rays start at different fractions of a step.
  bool countSamples = false; ///< Counters learn of samples; Composite only.
  glm::dvec2 hitFromFraction{ 1.0,
    0.0 }; ///< Fraction of the ray to the fraction that hits are kept in.
};

/// The depth of what is drawn already, at which rays stop. Filled by SceneDepth::captureBehind.
struct SceneBehind
{
  vtkTextureObject* depth = nullptr;
  glm::vec2 depthFromFraction{ 1.0f }; ///< Texture coordinates from the fraction of the image.
  glm::vec2 depthOfFractionZero{ 0.0f };
};

/// The reference that is drawn in the same picture. Filled by DeviceReference::compare.
struct SceneComparison
{
  RayCastScene* reference = nullptr; ///< As if drawn alone. Null: there is no comparison.
  double agreementMm = 1.0;          ///< Surfaces half as far apart count as one.
  PlacedCavity cavity;               ///< What the colours ignore.
  ColorPair colors;
};

/// Uncertainty of each position, one standard deviation in mm. Filled by EvidenceTexture::update.
struct SceneEvidence
{
  vtkTextureObject* deviations = nullptr; ///< mm, at control points. Null: it is not shown.
  glm::dvec3 deviationFromTexture{ 1.0 }; ///< Texture coordinates of the deviations.
  glm::dvec3 deviationOfTextureZero{ 0.0 };
  glm::dvec3 stripesFromTexture{ 1.0 }; ///< Stripes for a texture unit.
  double stripesOfTextureZero = 0.0;    ///< From the lattice, also if the texture is a part.
};

/// The fractions of a mask, as SegmentFractions.h has them.
struct PlacedFractions
{
  vtkTextureObject* fractions = nullptr; ///< Null: there is no mask.
  glm::dmat4 ownFromTexture{ 1.0 };      ///< Its texture coordinates from the volume's.
};

/// What a resection removed, and its tumour. Filled by ResectionTextures::update.
struct SceneResection
{
  PlacedFractions removed; ///< In the deformed frame.
  PlacedFractions tumour;  ///< At rest.
};

/// Everything that one picture depends on.
struct RayCastScene
{
  SceneFrame frame;
  SceneField field;
  SceneTissue tissue;
  SceneBricks bricks;
  SceneSkipping skipping;
  SceneCuts cuts;
  SceneBlending blending;
  SceneImage image;
  SceneBehind behind;
  SceneComparison comparison;
  SceneEvidence evidence;
  SceneResection resection;

  /// Step along the ray, mm.
  double stepMm() const { return this->tissue.stepMm * (1 << this->image.stepDoublings); }
};

// Sets the uniforms of those groups of a scene that rays and slices share.

/// What Shaders/Tissue/tissue.glsl needs. `stepDoublings`: how often the step was doubled, which
/// chooses the row of opacities.
void setTissueUniforms(Program& program, const SceneTissue& tissue, int stepDoublings);

/// One texel of a 3D texture, texture coordinates.
glm::vec3 texelOf(vtkTextureObject* texture);

/// What Shaders/Tissue/streamed.glsl needs to find voxels. Nothing if no finer level is drawn.
void setBrickUniforms(Program& program, const SceneBricks& bricks);

/// What Shaders/Field/field.glsl needs of a volume with a deformation.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT void setFieldUniforms(
  Program& program, const SceneField& field);

/// Ends the use of the field's textures.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT void deactivateField(const SceneField& field);

/// What Shaders/Tissue/evidence.glsl needs. Nothing if evidence is not shown.
void setEvidenceUniforms(Program& program, const SceneEvidence& evidence);

/// What Shaders/Tissue/resection.glsl needs. Nothing of a mask that is not there.
void setResectionUniforms(Program& program, const SceneResection& resection);

/// The sides of the part that this rank draws, as SceneCuts::partPlanes; may be empty.
void setPartPlanes(Program& program, const std::vector<float>& planes);

/// What Shaders/Tissue/components.glsl needs.
void setColoringUniforms(Program& program, const SceneColoring& coloring);
}

#endif
