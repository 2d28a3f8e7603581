// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkDeformedSlicesMapper
 * @brief   draws planes through a volume and the lattice it carries
 *
 * Three planes across the volume's axes, through one position: each fragment of them looks its
 * scalar up at the rest position its tissue came from (Filters/Attached/DeformableVolume.h), so that nothing
 * is resampled. The planes reach as far as tissue may go; outside tissue nothing is drawn. Colours
 * and place come from the vtkVolume, light does not matter.
 *
 * Opaque planes are drawn among surfaces, with their depth; others where volumes are, blended over
 * what is there.
 *
 * What lies on the GPU is kept for each window; where the GPU cannot draw, the reason is reported
 * once and nothing is drawn.
 */
#ifndef vtkDeformedSlicesMapper_h
#define vtkDeformedSlicesMapper_h

#include "vtkBrainShiftRepresentationsModule.h" // for the export macro
#include "vtkVolumeMapper.h"

#include <glm/fwd.hpp>

#include <memory> // for the private part
#include <string> // for messages

class vtkImageData;
class vtkOpenGLRenderWindow;
namespace brainshift
{
struct Counters;
struct Grid;
struct SliceScene;
struct TissueRequest;
}

class VTKBRAINSHIFTREPRESENTATIONS_EXPORT vtkDeformedSlicesMapper : public vtkVolumeMapper
{
public:
  static vtkDeformedSlicesMapper* New();
  vtkTypeMacro(vtkDeformedSlicesMapper, vtkVolumeMapper);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /** Whether a plane is drawn: the one across the volume's axis nearest to world x (sagittal), y
   * (coronal), z (axial). Default true. */
  vtkSetMacro(ShowSagittal, bool);
  vtkGetMacro(ShowSagittal, bool);
  vtkSetMacro(ShowCoronal, bool);
  vtkGetMacro(ShowCoronal, bool);
  vtkSetMacro(ShowAxial, bool);
  vtkGetMacro(ShowAxial, bool);
  ///@}

  ///@{
  /** All planes go through it: mm, world axes, before the vtkVolume's transform. Default 0 0 0. */
  vtkSetVector3Macro(SlicePosition, double);
  vtkGetVector3Macro(SlicePosition, double);
  ///@}

  enum InterpolationType
  {
    Nearest = 0, // as VTK numbers them
    Linear = 1,
    Cubic = 2, // B-spline: smooth, and a little softer
  };

  ///@{
  /** How scalars are found between voxels. Default linear. */
  vtkSetClampMacro(Interpolation, int, Nearest, Cubic);
  vtkGetMacro(Interpolation, int);
  ///@}

  ///@{
  /** Opacity of all, 0 to 1. Default 1. */
  vtkSetClampMacro(Opacity, double, 0.0, 1.0);
  vtkGetMacro(Opacity, double);
  ///@}

  ///@{
  /** Times the opacity map's. Default false. */
  vtkSetMacro(MapOpacity, bool);
  vtkGetMacro(MapOpacity, bool);
  ///@}

  enum ComparisonType
  {
    NoComparison = 0,
    RedGreen = 1,     // volume red, reference green, agreement yellow
    Checkerboard = 2, // in turn, both by the colour map
    Difference = 3,   // volume minus reference; agreement is grey
    Gradient = 4,     // the reference's gradient, green, over the volume in grey
    Wipe = 5,         // the volume on one side of a line, the reference on the other
  };

  ///@{
  /** How the reference that Compare Volumes attached is shown. Default not at all. Colours and
   * difference leave its cavity out. Where it attached that one of the two is shown alone, that one
   * is drawn by the colour map, whatever the comparison. */
  vtkSetClampMacro(Comparison, int, NoComparison, Wipe);
  vtkGetMacro(Comparison, int);
  ///@}

  ///@{
  /** Side of a field of the checkerboard, mm. Default 20. */
  vtkSetClampMacro(CheckerSize, double, 0.01, VTK_DOUBLE_MAX);
  vtkGetMacro(CheckerSize, double);
  ///@}

  ///@{
  /** The reference's scalars that stand for the ends of the colour map. Default 0 0, as all that is
   * no range: as vtkDeformedVolumeMapper maps them, equal numbers where both ranges are alike. */
  vtkSetVector2Macro(ReferenceRange, double);
  vtkGetVector2Macro(ReferenceRange, double);
  ///@}

  ///@{
  /** How much the reference changes within a mm where Gradient is fully green, as a share of the
   * colour map's range. Default 0.3. */
  vtkSetClampMacro(FullGradient, double, 1e-6, VTK_DOUBLE_MAX);
  vtkGetMacro(FullGradient, double);
  ///@}

  ///@{
  /** The line of Wipe goes through it: mm, world axes, before the vtkVolume's transform. It divides
   * axial and coronal slices across x, sagittal ones across y; the reference is where these are
   * smaller. Default 0 0 0. */
  vtkSetVector3Macro(WipePosition, double);
  vtkGetVector3Macro(WipePosition, double);
  ///@}

  /** Whether what lies behind may be seen through the planes. */
  bool IsTranslucent() const { return this->MapOpacity || this->Opacity < 1.0; }

  void Render(vtkRenderer* renderer, vtkVolume* volume) override;
  void ReleaseGraphicsResources(vtkWindow* window) override;

  ///@{
  /** Box that the deformed volume can reach, mm. */
  using vtkVolumeMapper::GetBounds;
  double* GetBounds() VTK_SIZEHINT(6) override;
  ///@}

  /** Directions (world) that the sagittal, the coronal and the axial plane lie across, 3 each,
   * pointing towards greater world coordinates. Those of the world without an input. */
  void GetNormals(double normals[9]);

  /** Distances (mm) between voxels along these directions. 1 without an input. */
  void GetVoxelSteps(double steps[3]);

  /**
   * Which tissue the last picture shows at a pixel, counted from the renderer's lower left corner:
   * its position (mm, world, deformed frame), and the unit normal of its plane. False if none.
   * Nothing is drawn.
   */
  bool Pick(vtkRenderer* renderer, int x, int y, double position[3], double normal[3]);

  /** What was done since the mapper was made, and what it holds on the GPU now. */
  const brainshift::Counters& GetCounters();

protected:
  vtkDeformedSlicesMapper();
  ~vtkDeformedSlicesMapper() override;

private:
  vtkDeformedSlicesMapper(const vtkDeformedSlicesMapper&) = delete;
  void operator=(const vtkDeformedSlicesMapper&) = delete;

  struct Device; // textures and programs of one window
  struct State;  // what all windows share, and their devices

  // False, with one sentence in `problem`, if this GPU cannot.
  bool Draw(vtkRenderer* renderer, vtkVolume* volume, std::string& problem);
  bool DrawPlanes(vtkRenderer* renderer, Device& device, vtkVolume* volume,
    const brainshift::TissueRequest& tissue, const brainshift::Grid& grid, std::string& problem);
  bool AskForMemory(vtkOpenGLRenderWindow* window, Device& device,
    const brainshift::TissueRequest& tissue, std::string& problem);
  bool DescribeReference(vtkOpenGLRenderWindow* window, Device& device,
    const brainshift::TissueRequest& tissue, const brainshift::Grid& grid,
    brainshift::SliceScene& scene, std::string& problem);
  void DescribePlanes(const brainshift::TissueRequest& tissue, const brainshift::Grid& grid,
    brainshift::SliceScene& scene);
  void UpdateDeformation(vtkImageData* image);
  bool IsSeenAt(const glm::dvec3& texture); // deformed frame

  bool ShowSagittal = true;
  bool ShowCoronal = true;
  bool ShowAxial = true;
  double SlicePosition[3] = { 0.0, 0.0, 0.0 };
  int Interpolation = Linear;
  double Opacity = 1.0;
  bool MapOpacity = false;
  int Comparison = NoComparison;
  double CheckerSize = 20.0;
  double ReferenceRange[2] = { 0.0, 0.0 };
  double FullGradient = 0.3;
  double WipePosition[3] = { 0.0, 0.0, 0.0 };

  std::unique_ptr<State> Internal;
};

#endif
