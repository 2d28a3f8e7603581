// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkDeformedVolumeMapper
 * @brief   ray casts a volume through the lattice that it carries
 *
 * Draws a vtkImageData with the deformation that Free-Form Deformation attached to it (see
 * Filters/Attached/DeformableVolume.h). No voxel is resampled. A volume without a lattice is drawn
 * as it is. Colours, opacity, light and position come from the vtkVolume, as for any volume mapper.
 *
 * All blend modes, clipping planes, cropping regions and dependent components of VTK's volumes work
 * with the deformation. A warning, given once, names what is not drawn (unsupportedChoices in
 * Representations/Scene/VolumeChoices.h).
 *
 * Each window that shows the volume keeps its own textures. Two windows that are drawn in turn
 * upload nothing.
 *
 * If the GPU cannot draw the volume, the mapper reports the reason once and VTK's software mapper
 * draws the volume undeformed.
 *
 * Method: van der Steen et al., SPIE 7169 (2009), section 2; ARCHITECTURE.md lists the differences.
 */
#ifndef vtkDeformedVolumeMapper_h
#define vtkDeformedVolumeMapper_h

#include "Representations/Scene/HitSource.h"    // for the tissue that hides points
#include "vtkBrainShiftRepresentationsModule.h" // for the export macro
#include "vtkVolumeMapper.h"

#include <memory> // for the private part
#include <string> // for messages
#include <vector> // for labels

class vtkImageData;
class vtkVolumeProperty;
namespace brainshift
{
struct Counters;
struct DrawnPart;
struct DrawnValues;
struct Lattice;
struct SceneReference;
struct TissueFacts;
struct TissueRequest;
struct VolumeRequest;
enum class Blend;
}

class VTKBRAINSHIFTREPRESENTATIONS_EXPORT vtkDeformedVolumeMapper
  : public vtkVolumeMapper
  , public brainshift::HitSource
{
public:
  static vtkDeformedVolumeMapper* New();
  vtkTypeMacro(vtkDeformedVolumeMapper, vtkVolumeMapper);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  using Superclass::SetInputConnection;
  void SetInputConnection(int port, vtkAlgorithmOutput* input) override;
  void Modified() override;

  ///@{
  /**
   * Step along the ray, mm. 0 (default): half the smallest voxel side. A step that is shorter than
   * 1/8192 of the volume's diagonal is drawn as that long, and a warning reports it.
   */
  vtkSetClampMacro(SampleDistance, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(SampleDistance, double);
  ///@}

  ///@{
  /** Skip empty space along the rays. The picture stays identical to the bit. Default true. */
  vtkSetMacro(EmptySpaceSkipping, bool);
  vtkGetMacro(EmptySpaceSkipping, bool);
  ///@}

  enum NormalTextureType
  {
    HalfResolution = 0, ///< The paper's choice: an eighth of the memory, softer light.
    FullResolution = 1,
    OnTheFly = 2, ///< No texture: six more reads for each lit sample.
  };

  ///@{
  /** Source of the gradients for light. Default full resolution. */
  vtkSetClampMacro(NormalTexture, int, HalfResolution, OnTheFly);
  vtkGetMacro(NormalTexture, int);
  ///@}

  ///@{
  /**
   * Draw fewer pixels while the window asks for interactive rates: as many as it has time for. The
   * still picture has all pixels. Default true.
   */
  vtkSetMacro(AdaptiveQuality, bool);
  vtkGetMacro(AdaptiveQuality, bool);
  ///@}

  ///@{
  /** Most memory of the GPU to use, MiB. 0 (default): all that the driver gives. */
  vtkSetClampMacro(MemoryLimit, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(MemoryLimit, double);
  ///@}

  ///@{
  /**
   * Count the samples that composite blending takes and skips (GetCounters). A third target is then
   * read back after each picture. Default false.
   */
  vtkSetMacro(CountSamples, bool);
  vtkGetMacro(CountSamples, bool);
  ///@}

  ///@{
  /**
   * Cast no rays for a picture that would be identical to the last one. While a tool hovers, only
   * the props over the picture change. Default false; Trace Points in the view have the same
   * effect.
   */
  vtkSetMacro(KeepPicture, bool);
  vtkGetMacro(KeepPicture, bool);
  ///@}

  ///@{
  /**
   * A still picture waits for the bricks of a finer level that it shows: it is to be saved. Its
   * tiles, eyes and volumes wait a minute in all. The mapper is not modified by it. Default false.
   */
  void SetWaitsForDetail(bool waits) { this->WaitsForDetail = waits; }
  vtkGetMacro(WaitsForDetail, bool);
  ///@}

  ///@{
  /**
   * Draw only tissue whose rest position is in the chosen labels of the segmentation that the
   * volume carries (Filters/Attached/Segmentation.h). Default false.
   */
  vtkSetMacro(DrawSegment, bool);
  vtkGetMacro(DrawSegment, bool);
  ///@}

  ///@{
  /**
   * Whether tissue is tinted by the uncertainty of its position: one standard deviation, mm, at the
   * rest position of each sample (Scene/Tints.h). A comparison in two colours shows stripes. It
   * needs blend mode Composite, Isosurface or Slice, and a volume with deviations
   * (DeformableVolume.h). Default false.
   */
  vtkSetMacro(ShowEvidence, bool);
  vtkGetMacro(ShowEvidence, bool);
  ///@}

  ///@{
  /** Labels to draw. None (default): the labels of the mask, or else all above 0. */
  void AddDrawnLabel(int label);
  void ClearDrawnLabels();
  ///@}

  enum ComparisonType
  {
    NoComparison = 0,
    TwoColors = 1, ///< Each in its colour, agreement in the sum of both.
  };

  ///@{
  /** How the reference that Compare Volumes attached is shown. Default two colours. */
  vtkSetClampMacro(Comparison, int, NoComparison, TwoColors);
  vtkGetMacro(Comparison, int);
  ///@}

  ///@{
  /**
   * Colours of the volume and of the reference, as brainshift::ComparisonColors numbers them: red
   * and green, which add up to yellow, or blue and orange, which add up to grey. Default red and
   * green.
   */
  vtkSetClampMacro(ComparisonColors, int, 0, 1);
  vtkGetMacro(ComparisonColors, int);
  ///@}

  ///@{
  /**
   * Scalars of the reference that map to the ends of the volume's colour map. Default 0 0:
   * scalars keep their numbers if the ranges of both volumes have at least half in common. Else the
   * range of the reference is mapped to the range of the volume.
   */
  vtkSetVector2Macro(ReferenceRange, double);
  vtkGetVector2Macro(ReferenceRange, double);
  ///@}

  ///@{
  /**
   * Distance (mm) between two surfaces at which half of the one behind is seen through the one in
   * front. At half this distance all of it is seen, at one and a half times nothing. 0 (default):
   * two voxels.
   */
  vtkSetClampMacro(AgreementDistance, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(AgreementDistance, double);
  ///@}

  ///@{
  /**
   * Strength of ambient occlusion, 0 to 1: the fraction of light that the most occluded tissue
   * loses. It darkens grooves such as sulci. Translucent tissue loses less: the fraction that
   * tissue as thick as the radius can hide. Still pictures of shaded volumes only, in the blend
   * modes Composite and Isosurface, and not with a reference in view. 0 is off. Default 0.5.
   */
  vtkSetClampMacro(AmbientOcclusion, double, 0.0, 1.0);
  vtkGetMacro(AmbientOcclusion, double);
  ///@}

  ///@{
  /**
   * Radius within which tissue hides light, mm, world; at most 96 pixels. 0 (default): 2 % of the
   * volume's diagonal, 8 mm for a head.
   */
  vtkSetClampMacro(OcclusionRadius, double, 0.0, VTK_FLOAT_MAX);
  vtkGetMacro(OcclusionRadius, double);
  ///@}

  /**
   * Position of the tissue (mm, world, deformed frame) at a pixel of the last whole picture in the
   * renderer's window: where the opacity along the ray reaches one half. False if it never does.
   * `x` and `y` count from the renderer's lower left corner. Nothing is drawn.
   */
  bool Pick(vtkRenderer* renderer, int x, int y, double position[3]);

  /**
   * First hits of the last picture in a window, whole or a tile. Null if there is none.
   */
  const brainshift::FirstHits* GetHits(vtkWindow* window) override;

  void Render(vtkRenderer* renderer, vtkVolume* volume) override;
  void ReleaseGraphicsResources(vtkWindow* window) override;

  ///@{
  /** Box that the deformed volume can reach, mm. */
  using vtkVolumeMapper::GetBounds;
  double* GetBounds() VTK_SIZEHINT(6) override;
  ///@}

  ///@{
  /** For several MPI ranks that draw a part of the deformed frame each. Widens bounds (mm; x, y, z,
   * least and greatest each) by where an image's tissue can go; the deformation of an image, null
   * if it has none; the part to draw, null (default): all of it. The first two throw a Problem if
   * the deformation cannot be read: a rank must not draw its part without it. */
  void WidenByTissue(vtkImageData* image, double bounds[6]);
  const brainshift::Lattice* GetLattice(vtkImageData* image);
  void SetDrawnPart(const brainshift::DrawnPart* part);
  /** Where the tissue of all ranks can be, mm; null: this process draws all of it. */
  const double* GetTissueOfAllRanks() const;
  ///@}

  /**
   * Excludes all behind the tissue of the last picture from a selection. The volume itself
   * cannot be selected. A selection of cells does so when it draws volumes. A selection of points
   * draws no depth of its own: call this before it draws anything.
   */
  void CoverSelection(vtkRenderer* renderer);

  /** Facts about the tissue at a position in the deformed frame (mm, before the transform of the
   * vtkVolume), as `window` drew it last. */
  void DescribeTissue(
    vtkWindow* window, const double deformedMm[3], brainshift::TissueFacts& facts);

  /** Finds the rest position of tissue that is drawn at `place`, or, if `toRest` is false, the
   * drawn position of tissue that rests at `place`. Both mm, before the vtkVolume's transform. */
  void FindSameTissue(const double place[3], bool toRest, double found[3]);

  /** Counts of the mapper's work since it was made, and its memory on the GPU now. */
  const brainshift::Counters& GetCounters();

  /** The same, with what finer levels (Representations/Bricks) give to the picture up to date, and
   * no question to the GPU. */
  const brainshift::Counters& CountDetail();

protected:
  vtkDeformedVolumeMapper();
  ~vtkDeformedVolumeMapper() override;

private:
  vtkDeformedVolumeMapper(const vtkDeformedVolumeMapper&) = delete;
  void operator=(const vtkDeformedVolumeMapper&) = delete;

  struct State; // what all windows share, and what each of them keeps

  // Draws deformed. False, with one sentence in `problem`, if this GPU cannot.
  bool Draw(vtkRenderer* renderer, vtkVolume* volume, std::string& problem);
  void DrawAnyhow(vtkRenderer* renderer, vtkVolume* volume);

  // The content of the picture by the settings.
  brainshift::TissueRequest TissueOf(
    vtkImageData* image, vtkVolumeProperty* property, const brainshift::DrawnValues& values);
  bool DrawsEvidence(brainshift::Blend blend);
  void ComparePlainly(brainshift::VolumeRequest& request);
  brainshift::SceneReference ReferenceOf(
    vtkImageData* image, const brainshift::TissueRequest& tissue);
  double StepOn(const brainshift::TissueRequest& tissue);
  double OcclusionRadiusOn(vtkImageData* image, vtkVolume* volume);
  double OcclusionDarkness();
  void UpdateDeformation(vtkImageData* image);
  void WidenByDeformation(vtkImageData* image, double bounds[6]);
  void TellOnce(const std::string& sentence);

  double SampleDistance = 0.0;
  bool EmptySpaceSkipping = true;
  int NormalTexture = FullResolution;
  bool AdaptiveQuality = true;
  bool CountSamples = false;
  bool KeepPicture = false;
  bool WaitsForDetail = false;
  double MemoryLimit = 0.0;
  bool DrawSegment = false;
  bool ShowEvidence = false;
  std::vector<int> DrawnLabels;
  int Comparison = TwoColors;
  int ComparisonColors = 0;
  double ReferenceRange[2] = { 0.0, 0.0 };
  double AgreementDistance = 0.0;
  double AmbientOcclusion = 0.5;
  double OcclusionRadius = 0.0;

  std::unique_ptr<State> Internal;
};

#endif
