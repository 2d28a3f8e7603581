// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkDeformedVolumeMapper
 * @brief   ray casts a volume through the lattice it carries
 *
 * Draws a vtkImageData with the deformation that Free-Form Deformation attached to it (see
 * Filters/Attached/DeformableVolume.h), never resampling a voxel; a volume without a lattice is drawn as it
 * is. Colours, opacity, light and position come from the vtkVolume, as for any volume mapper.
 *
 * All blend modes, clipping planes, cropping regions and dependent components of VTK's volumes are
 * drawn under the deformation; what is not drawn is told once (RayCastOptions.h).
 *
 * What lies on the GPU is kept for each window that shows the volume: two of them, drawn in turn,
 * upload nothing.
 *
 * Where the GPU cannot draw it, the reason is reported once and VTK's software mapper draws the
 * volume undeformed.
 *
 * Method: van der Steen et al., SPIE 7169 (2009), section 2; ARCHITECTURE.md says what differs.
 */
#ifndef vtkDeformedVolumeMapper_h
#define vtkDeformedVolumeMapper_h

#include "vtkBrainShiftRepresentationsModule.h" // for the export macro
#include "vtkVolumeMapper.h"

#include <glm/vec2.hpp> // for sizes in pixels

#include <memory> // for the private part
#include <string> // for messages
#include <vector> // for labels

class vtkDataArray;
class vtkImageData;
class vtkOpenGLRenderWindow;
class vtkVolumeProperty;
namespace brainshift
{
struct Counters;
struct FirstHits;
struct Grid;
struct RayCastScene;
struct SceneReference;
struct SegmentRequest;
struct TissueRequest;
class Tissue;
struct ValueLayout;
}

class VTKBRAINSHIFTREPRESENTATIONS_EXPORT vtkDeformedVolumeMapper : public vtkVolumeMapper
{
public:
  static vtkDeformedVolumeMapper* New();
  vtkTypeMacro(vtkDeformedVolumeMapper, vtkVolumeMapper);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  using Superclass::SetInputConnection;
  void SetInputConnection(int port, vtkAlgorithmOutput* input) override;
  void Modified() override;

  ///@{
  /** Step along the ray, mm. 0 (default): half the smallest voxel side. */
  vtkSetClampMacro(SampleDistance, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(SampleDistance, double);
  ///@}

  ///@{
  /** Leap over what cannot be seen. The picture is the same bit for bit. Default true. */
  vtkSetMacro(EmptySpaceSkipping, bool);
  vtkGetMacro(EmptySpaceSkipping, bool);
  ///@}

  enum NormalTextureType
  {
    HalfResolution = 0, // the paper's choice: an eighth of the memory, softer light
    FullResolution = 1,
    OnTheFly = 2, // no texture: six more reads for each lit sample
  };

  ///@{
  /** Where the gradients that light needs come from. Default full resolution. */
  vtkSetClampMacro(NormalTexture, int, HalfResolution, OnTheFly);
  vtkGetMacro(NormalTexture, int);
  ///@}

  ///@{
  /**
   * Draw fewer pixels while the window asks for interactive rates, as many as hold the rate; the
   * still picture has them all. Default true.
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
   * Count the samples that composite blending takes and skips (GetCounters), by a third target that
   * is read back after each picture. Default false.
   */
  vtkSetMacro(CountSamples, bool);
  vtkGetMacro(CountSamples, bool);
  ///@}

  ///@{
  /**
   * Cast no rays for a picture that would come out as the last one: what changes while a tool
   * hovers lies over it. Default false; Trace Points in the view turn it on.
   */
  vtkSetMacro(KeepPicture, bool);
  vtkGetMacro(KeepPicture, bool);
  ///@}

  ///@{
  /**
   * Draw only tissue whose place at rest lies in the chosen labels of the segmentation that the
   * volume carries (Filters/Attached/Segmentation.h). Default false.
   */
  vtkSetMacro(DrawSegment, bool);
  vtkGetMacro(DrawSegment, bool);
  ///@}

  ///@{
  /** Labels to draw. None, the default: those the segmentation means, or else all above 0. */
  void AddDrawnLabel(int label);
  void ClearDrawnLabels();
  enum ComparisonType
  {
    NoComparison = 0,
    RedGreen = 1, // volume red, reference green, agreement yellow
  };

  ///@{
  /** How the reference that Compare Volumes attached is shown. Default red and green. */
  vtkSetClampMacro(Comparison, int, NoComparison, RedGreen);
  vtkGetMacro(Comparison, int);
  ///@}

  ///@{
  /**
   * The reference's scalars that stand for the ends of the volume's colour map. Default 0 0: equal
   * numbers where the volumes' ranges have at least half in common, else from the whole range of
   * the one to that of the other.
   */
  vtkSetVector2Macro(ReferenceRange, double);
  vtkGetVector2Macro(ReferenceRange, double);
  ///@}

  ///@{
  /**
   * Distance (mm) between two surfaces at which half of the one behind is seen through the other:
   * all of it at half the distance, nothing at one and a half. 0 (default): two voxels.
   */
  vtkSetClampMacro(AgreementDistance, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(AgreementDistance, double);
  ///@}

  /**
   * Tissue position (mm, world, deformed frame) that the last whole picture in the renderer's
   * window shows at a pixel counted from the renderer's lower left corner, without drawing again:
   * where the opacity along the ray reaches one half. False where it does not.
   */
  bool Pick(vtkRenderer* renderer, int x, int y, double position[3]);

  /**
   * First hits of the last picture in a window, whole or a tile. Null if there is none.
   */
  const brainshift::FirstHits* GetHits(vtkWindow* window);

  void Render(vtkRenderer* renderer, vtkVolume* volume) override;
  void ReleaseGraphicsResources(vtkWindow* window) override;

  ///@{
  /** Box that the deformed volume can reach, mm. */
  using vtkVolumeMapper::GetBounds;
  double* GetBounds() VTK_SIZEHINT(6) override;
  ///@}

  /**
   * Hides from a selection what lies behind the tissue of the last picture; the volume itself
   * cannot be selected. Selections of surfaces' cells do so when volumes are drawn. Points are
   * drawn without a depth of their own: there it must be called before anything is.
   */
  void CoverSelection(vtkRenderer* renderer);

  /** What was done since the mapper was made, and what it holds on the GPU now. */
  const brainshift::Counters& GetCounters();

protected:
  vtkDeformedVolumeMapper();
  ~vtkDeformedVolumeMapper() override;

private:
  vtkDeformedVolumeMapper(const vtkDeformedVolumeMapper&) = delete;
  void operator=(const vtkDeformedVolumeMapper&) = delete;

  struct Device; // textures and programs of one window
  struct State;  // what all windows share, and their devices

  // Draws deformed. False, with one sentence in `problem`, if this GPU cannot.
  bool Draw(vtkRenderer* renderer, vtkVolume* volume, std::string& problem);
  bool DrawTissue(vtkRenderer* renderer, Device& device, vtkVolume* volume,
    const brainshift::TissueRequest& tissue, const brainshift::Grid& grid,
    const brainshift::SceneReference& reference, std::string& problem);
  void DrawUndeformed(vtkRenderer* renderer, vtkVolume* volume, const std::string& problem);

  brainshift::SegmentRequest SegmentOf(
    vtkImageData* image, const brainshift::Grid& grid, const brainshift::ValueLayout& layout);
  void TellUnsupported(vtkVolumeProperty* property, vtkDataArray* scalars);
  void TellOnce(const std::string& sentence);
  brainshift::SceneReference FindReference(
    vtkImageData* image, const brainshift::TissueRequest& tissue);
  bool AskForMemory(vtkRenderer* renderer, Device& device, const brainshift::TissueRequest& tissue,
    brainshift::SceneReference& reference, std::string& problem);
  void AskTheGpu();
  void UpdateDeformation(vtkImageData* image);
  bool DescribeTissue(vtkRenderer* renderer, Device& device, vtkVolume* volume,
    const brainshift::TissueRequest& tissue, const brainshift::Grid& grid,
    brainshift::RayCastScene& scene, std::string& problem);
  bool DescribeReference(vtkRenderer* renderer, Device& device, vtkVolume* volume,
    const brainshift::TissueRequest& tissue, const brainshift::Grid& grid,
    const brainshift::SceneReference& reference, brainshift::RayCastScene& scene,
    std::string& problem);
  void DescribeOptions(vtkRenderer* renderer, vtkVolume* volume, const brainshift::Tissue& drawn,
    const brainshift::TissueRequest& tissue, const brainshift::Grid& grid,
    brainshift::RayCastScene& scene);
  void Compare(vtkRenderer* renderer, Device& device, vtkVolume* volume,
    const brainshift::Grid& grid, const brainshift::SceneReference& reference,
    brainshift::RayCastScene& scene, brainshift::RayCastScene& alone);
  void DescribeCropping(const brainshift::Grid& grid, const brainshift::ValueLayout& layout,
    brainshift::RayCastScene& scene);

  double SampleDistance = 0.0;
  bool EmptySpaceSkipping = true;
  int NormalTexture = FullResolution;
  bool AdaptiveQuality = true;
  bool CountSamples = false;
  bool KeepPicture = false;
  double MemoryLimit = 0.0;
  bool DrawSegment = false;
  std::vector<int> DrawnLabels;
  int Comparison = RedGreen;
  double ReferenceRange[2] = { 0.0, 0.0 };
  double AgreementDistance = 0.0;

  std::unique_ptr<State> Internal;
};

#endif
