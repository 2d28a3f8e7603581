// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkDeformedSlicesMapper
 * @brief   draws planes through a volume and the lattice that it carries
 *
 * Draws three planes across the volume's axes, through one position. Each fragment reads its scalar
 * at the rest position that its tissue came from (Filters/Attached/DeformableVolume.h). So nothing
 * is resampled. The planes reach as far as tissue can go. Outside tissue nothing is drawn. Colours
 * and position come from the vtkVolume; there is no light.
 *
 * Opaque planes are drawn together with the surfaces, with their depth. See-through planes are
 * drawn together with the volumes and blended over what is there.
 *
 * Each window keeps its own textures. If the GPU cannot draw the planes, the mapper reports the
 * reason once and draws nothing.
 */
#ifndef vtkDeformedSlicesMapper_h
#define vtkDeformedSlicesMapper_h

#include "vtkBrainShiftRepresentationsModule.h" // for the export macro
#include "vtkVolumeMapper.h"

#include <glm/fwd.hpp>

#include <memory> // for the private part
#include <string> // for messages

class vtkImageData;
class vtkVolumeProperty;
namespace brainshift
{
struct Counters;
struct DrawnPart;
struct DrawnValues;
struct DrawnVolume;
struct GpuTask;
struct Lattice;
struct MemoryNeed;
struct SliceScene;
struct TissueFacts;
struct TissueRequest;
struct ValueLayout;
}

class VTKBRAINSHIFTREPRESENTATIONS_EXPORT vtkDeformedSlicesMapper : public vtkVolumeMapper
{
public:
  static vtkDeformedSlicesMapper* New();
  vtkTypeMacro(vtkDeformedSlicesMapper, vtkVolumeMapper);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Whether a plane is drawn: across the volume's axis nearest to world x (sagittal), y (coronal)
   * or z (axial). Default true.
   */
  vtkSetMacro(ShowSagittal, bool);
  vtkGetMacro(ShowSagittal, bool);
  vtkSetMacro(ShowCoronal, bool);
  vtkGetMacro(ShowCoronal, bool);
  vtkSetMacro(ShowAxial, bool);
  vtkGetMacro(ShowAxial, bool);
  ///@}

  ///@{
  /** All planes go through this position: mm, world axes, before the vtkVolume's transform. Default
   * 0 0 0. */
  vtkSetVector3Macro(SlicePosition, double);
  vtkGetVector3Macro(SlicePosition, double);
  ///@}

  ///@{
  /** Whether each plane shows its intersections with the other two, by lines in their colours
   * (Slices/SliceGeometry.h). Default false. */
  vtkSetMacro(Crosshair, bool);
  vtkGetMacro(Crosshair, bool);
  ///@}

  enum InterpolationType
  {
    Nearest = 0, ///< Numbered as in VTK.
    Linear = 1,
    Cubic = 2, ///< B-spline: smooth, and a little softer.
  };

  ///@{
  /** How scalars are interpolated between voxels. Default linear. */
  vtkSetClampMacro(Interpolation, int, Nearest, Cubic);
  vtkGetMacro(Interpolation, int);
  ///@}

  ///@{
  /** Whether tissue is tinted by the uncertainty of its position, as in vtkDeformedVolumeMapper. In
   * two colours, differences and gradients it is shown by stripes. Default false. */
  vtkSetMacro(ShowEvidence, bool);
  vtkGetMacro(ShowEvidence, bool);
  ///@}

  ///@{
  /** Opacity of all planes, 0 to 1. Default 1. */
  vtkSetClampMacro(Opacity, double, 0.0, 1.0);
  vtkGetMacro(Opacity, double);
  ///@}

  ///@{
  /** Whether the opacity curve makes planes see-through, too. Default false. */
  vtkSetMacro(MapOpacity, bool);
  vtkGetMacro(MapOpacity, bool);
  ///@}

  enum ComparisonType
  {
    NoComparison = 0,
    TwoColors = 1,       ///< Each in its colour, agreement in the sum of both.
    Checkerboard = 2,    ///< Fields of volume and reference in turn, with the colour map.
    Difference = 3,      ///< Volume minus reference; agreement is grey.
    Gradient = 4,        ///< The reference's gradient, in its colour, over the volume in grey.
    Wipe = 5,            ///< The volume on one side of a line, the reference on the other.
    LocalSimilarity = 6, ///< The volume in grey, in its colour where the reference disagrees.
  };

  ///@{
  /**
   * How the reference that Compare Volumes attached is shown. Default: it is not shown. Colours and
   * difference ignore its cavity. If Compare Volumes shows one of the two volumes
   * alone, that one is drawn with the colour map, whatever the comparison.
   */
  vtkSetClampMacro(Comparison, int, NoComparison, LocalSimilarity);
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
  /** Side of a field of the checkerboard, mm. Default 20, at least 0.01. */
  vtkSetClampMacro(CheckerSize, double, 0.01, VTK_DOUBLE_MAX);
  vtkGetMacro(CheckerSize, double);
  ///@}

  ///@{
  /** Scalars of the reference that map to the ends of the colour map. Default 0 0: see
   * vtkDeformedVolumeMapper. Any two numbers of which the first is not smaller mean the default. */
  vtkSetVector2Macro(ReferenceRange, double);
  vtkGetVector2Macro(ReferenceRange, double);
  ///@}

  ///@{
  /**
   * Change of the reference per mm at which Gradient has its full colour, as a fraction of the
   * range of the colour map. Default 0.3.
   */
  vtkSetClampMacro(FullGradient, double, 1e-6, VTK_DOUBLE_MAX);
  vtkGetMacro(FullGradient, double);
  ///@}

  ///@{
  /**
   * Diameter of the window within which LocalSimilarity compares both volumes, in the plane of a
   * slice, mm. Weights fall to 0 at its edge. Default 12, at least 0.01.
   */
  vtkSetClampMacro(SimilarityWindow, double, 0.01, VTK_DOUBLE_MAX);
  vtkGetMacro(SimilarityWindow, double);
  ///@}

  ///@{
  /**
   * The line of Wipe goes through this position: mm, world axes, before the vtkVolume's transform.
   * It divides axial and coronal slices across x, sagittal slices across y. The reference is drawn
   * on the side of smaller coordinates. Default 0 0 0.
   */
  vtkSetVector3Macro(WipePosition, double);
  vtkGetVector3Macro(WipePosition, double);
  ///@}

  ///@{
  /** Most memory of the GPU to use, MiB. 0 (default): all that the driver gives. */
  vtkSetClampMacro(MemoryLimit, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(MemoryLimit, double);
  ///@}

  ///@{
  /** A still picture waits for the bricks of a finer level, as in vtkDeformedVolumeMapper. Default
   * false. */
  void SetWaitsForDetail(bool waits) { this->WaitsForDetail = waits; }
  vtkGetMacro(WaitsForDetail, bool);
  ///@}

  /** Whether the planes are see-through. */
  bool IsTranslucent() const { return this->MapOpacity || this->Opacity < 1.0; }

  void Render(vtkRenderer* renderer, vtkVolume* volume) override;
  void ReleaseGraphicsResources(vtkWindow* window) override;

  ///@{
  /** Box that the deformed volume can reach, mm. */
  using vtkVolumeMapper::GetBounds;
  double* GetBounds() VTK_SIZEHINT(6) override;
  ///@}

  ///@{
  /** For several MPI ranks, see vtkDeformedVolumeMapper. */
  void WidenByTissue(vtkImageData* image, double bounds[6]);
  const brainshift::Lattice* GetLattice(vtkImageData* image);
  void SetDrawnPart(const brainshift::DrawnPart* part);
  const double* GetTissueOfAllRanks() const;
  ///@}

  /**
   * Normals (world) of the sagittal, the coronal and the axial plane, 3 numbers each, pointing
   * towards greater world coordinates. Without an input: the axes of the world.
   */
  void GetNormals(double normals[9]);

  /** Distances (mm) between voxels along these normals. Without an input: 1. */
  void GetVoxelSteps(double steps[3]);

  /**
   * Position of the tissue (mm, world, deformed frame) at a pixel of the last picture, and the unit
   * normal of its plane. False if there is no tissue. `x` and `y` count from the renderer's lower
   * left corner. Nothing is drawn.
   */
  bool Pick(vtkRenderer* renderer, int x, int y, double position[3], double normal[3]);

  /** Facts about the tissue at a position in the deformed frame (mm, before the transform of the
   * vtkVolume), as `window` drew it last. */
  void DescribeTissue(
    vtkWindow* window, const double deformedMm[3], brainshift::TissueFacts& facts);

  /** Finds the rest position of tissue that is drawn at `place`, or, if `toRest` is false, the
   * drawn position of tissue that rests at `place`. Both mm, before the vtkVolume's transform. */
  void FindSameTissue(const double place[3], bool toRest, double found[3]);

  /** Counts of the mapper's work since it was made, and its memory on the GPU now. */
  const brainshift::Counters& GetCounters();

  /** The same, of which only what bricks of a finer level tell is up to date. The GPU is not
   * asked. */
  const brainshift::Counters& CountDetail();

protected:
  vtkDeformedSlicesMapper();
  ~vtkDeformedSlicesMapper() override;

private:
  vtkDeformedSlicesMapper(const vtkDeformedSlicesMapper&) = delete;
  void operator=(const vtkDeformedSlicesMapper&) = delete;

  struct Device; // textures and programs of one window
  struct State;  // what all windows share, and their devices

  // False, with a problem, if this GPU cannot.
  bool Draw(vtkRenderer* renderer, vtkVolume* volume, std::string& problem);
  brainshift::TissueRequest TissueOf(
    vtkImageData* image, vtkVolumeProperty* property, const brainshift::DrawnValues& values);
  brainshift::MemoryNeed NeedOf(const brainshift::TissueRequest& tissue);
  bool DrawPlanes(brainshift::GpuTask& gpu, const brainshift::DrawnVolume& seen, Device& device,
    const brainshift::TissueRequest& tissue);
  bool IsCubic(const brainshift::TissueRequest& tissue) const;
  void AddBricks(brainshift::GpuTask& gpu, const brainshift::DrawnVolume& seen, Device& device,
    const brainshift::TissueRequest& tissue, brainshift::SliceScene& scene);
  bool UploadReference(brainshift::GpuTask& gpu, Device& device,
    const brainshift::TissueRequest& tissue, const brainshift::DrawnValues& whole,
    brainshift::SliceScene& scene);
  void Tell(const brainshift::GpuTask& gpu);
  void PlacePlanes(const brainshift::DrawnValues& values, brainshift::SliceScene& scene);
  void UpdateDeformation(vtkImageData* image);
  bool IsSeenAt(const brainshift::ValueLayout& drawn, const glm::dvec3& texture); // deformed frame
  bool IsOfThisRank(const glm::dvec3& world);

  bool ShowSagittal = true;
  bool ShowCoronal = true;
  bool ShowAxial = true;
  double SlicePosition[3] = { 0.0, 0.0, 0.0 };
  bool Crosshair = false;
  bool ShowEvidence = false;
  int Interpolation = Linear;
  double Opacity = 1.0;
  bool MapOpacity = false;
  int Comparison = NoComparison;
  int ComparisonColors = 0;
  double CheckerSize = 20.0;
  double ReferenceRange[2] = { 0.0, 0.0 };
  double FullGradient = 0.3;
  double SimilarityWindow = 12.0;
  double WipePosition[3] = { 0.0, 0.0, 0.0 };
  double MemoryLimit = 0.0;
  bool WaitsForDetail = false;

  std::unique_ptr<State> Internal;
};

#endif
