// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkFreeFormDeformation
 * @brief   attaches a free-form-deformation lattice to a volume
 *
 * Passes the volume through by shallow copy, never touching a voxel, and attaches the lattice that
 * its strokes bend (see DeformableVolume.h for the field data). "Deformed Volume" draws the result
 * bent; other filters see the volume undeformed until Bake Deformation.
 *
 * Input 0: the volume, vtkImageData with at least two points a side. Input 1 (optional): a base
 * lattice or dense displacement field, vtkImageData with a three-component point array (mm, world
 * axes, forward), read at the control points; strokes add to it. Input 2 (optional): a mask,
 * vtkImageData on any grid with labels or scalars; only tissue inside it moves (MaskWeights.h).
 * Input 3 (optional): a segmentation, likewise; it bends nothing but is attached, as is the mask
 * where there is none, for "Deformed Volume" to draw chosen labels alone (Segmentation.h).
 *
 * Method: van der Steen et al., SPIE 7169 (2009), section 2.
 */
#ifndef vtkFreeFormDeformation_h
#define vtkFreeFormDeformation_h

#include "vtkBrainShiftFiltersModule.h" // for the export macro
#include "vtkPassInputTypeAlgorithm.h"

#include <memory> // for the private part
#include <string> // for messages
#include <vector> // for labels

class vtkDoubleArray;
class vtkImageData;
namespace brainshift
{
struct Grid;
}

class VTKBRAINSHIFTFILTERS_EXPORT vtkFreeFormDeformation : public vtkPassInputTypeAlgorithm
{
public:
  static vtkFreeFormDeformation* New();
  vtkTypeMacro(vtkFreeFormDeformation, vtkPassInputTypeAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /** Control points along the volume's axes, 4 to 257 each. Default 19 19 19. */
  vtkSetVector3Macro(LatticeDimensions, int);
  vtkGetVector3Macro(LatticeDimensions, int);
  ///@}

  ///@{
  /** Nodes of the refined field between two control points, 0 to 16. Default 4. */
  vtkSetMacro(Samples, int);
  vtkGetMacro(Samples, int);
  ///@}

  ///@{
  /** 0: Catmull-Rom through the control points (default); 1: uniform cubic B-spline. */
  vtkSetMacro(Kernel, int);
  vtkGetMacro(Kernel, int);
  ///@}

  ///@{
  /** Factor on all displacements, 0 to 1. Default 1. */
  vtkSetClampMacro(Strength, double, 0.0, 1.0);
  vtkGetMacro(Strength, double);
  ///@}

  ///@{
  /**
   * Whether each stroke is shortened to the largest part of it that keeps the Jacobian determinant
   * of deformedFromRest at 0.1 or above everywhere (FoldGuard.h). Default on. The strokes' numbers
   * stay as they are; what was applied is told by GetStrokeShares. Where the base lattice folds by
   * itself a warning says so and strokes are not shortened.
   */
  vtkSetMacro(GuardFolding, bool);
  vtkGetMacro(GuardFolding, bool);
  vtkBooleanMacro(GuardFolding, bool);
  ///@}

  ///@{
  /** 0: Exact, tissue arrives where the handle is put (default); 1: Negated, the paper's form. */
  vtkSetMacro(Inverse, int);
  vtkGetMacro(Inverse, int);
  ///@}

  ///@{
  /**
   * The point (mm, world) that the stamp's long axis goes through, kept here for the tools: strokes
   * hold their own axis. Default 0 0 0; ParaView makes it the centre of the volume.
   */
  vtkSetVector3Macro(PointOfInterest, double);
  vtkGetVector3Macro(PointOfInterest, double);
  ///@}

  ///@{
  /**
   * The strokes, replayed in order: 14 numbers each (Stroke.h). Given number by number, so that a
   * list of the wrong length is noticed and not cut short.
   */
  void AddStrokeNumber(double number);
  void ClearStrokes();
  ///@}

  /** Base lattice: optional second input. */
  void SetLatticeConnection(vtkAlgorithmOutput* lattice);

  /** Mask: optional third input. */
  void SetMaskConnection(vtkAlgorithmOutput* mask);

  /** Segmentation: optional fourth input. */
  void SetSegmentationConnection(vtkAlgorithmOutput* segmentation);

  ///@{
  /** Values of the mask that are inside. None, the default: all above 0. */
  void AddMaskLabel(int label);
  void ClearMaskLabels();
  ///@}

  ///@{
  /**
   * Distance (mm) over which displacements rise from 0 at the mask's edge to what they are further
   * inside; 0 or more. Default 10. The edge is that of the mask, moved inwards to the next nodes of
   * the refined field: at most two of them.
   */
  vtkSetMacro(Feather, double);
  vtkGetMacro(Feather, double);
  ///@}

  /** Largest displacement of a control point as drawn, mm. */
  double GetMaximumDisplacement();

  /**
   * Smallest Jacobian determinant of deformedFromRest as drawn, within the volume: 1 where tissue
   * stays, above 1 only if all of it grows, 0 or less: tissue folds. Sampled on the control points
   * and halfway between them. Computed when asked for.
   */
  double GetMinimumJacobian();

  /** Strokes of which the fold guard lets only a part be applied. */
  int GetShortenedStrokes() const;

  /** How much of each stroke was applied, 0 to 1; 1: all of it, or a disabled stroke. */
  vtkDoubleArray* GetStrokeShares();

  /** Strokes the last execution had to apply: 1 while the last stroke is being changed. */
  int GetAppliedStrokes() const;

protected:
  vtkFreeFormDeformation();
  ~vtkFreeFormDeformation() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkFreeFormDeformation(const vtkFreeFormDeformation&) = delete;
  void operator=(const vtkFreeFormDeformation&) = delete;

  int LatticeDimensions[3] = { 19, 19, 19 };
  int Samples = 4;
  int Kernel = 0;
  int Inverse = 0;
  double Strength = 1.0;
  bool GuardFolding = true;
  double PointOfInterest[3] = { 0.0, 0.0, 0.0 };
  double Feather = 10.0;
  std::vector<int> MaskLabels;

  // What is wrong with a property; empty if nothing is.
  std::string ProblemOfProperties() const;

  // Bends the lattice as the properties say. Returns what keeps it from doing so, in which case the
  // last good deformation stays; empty if nothing does.
  std::string Bend(const brainshift::Grid& volumeGrid, vtkImageData* base, vtkImageData* maskImage,
    vtkImageData* segments);

  // Says what the user should know of the deformation, once for each change of what is said.
  void TellWarnings();

  struct State; // strokes, replay and the last good deformation
  std::unique_ptr<State> Internal;
};

#endif
