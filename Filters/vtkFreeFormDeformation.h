// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkFreeFormDeformation
 * @brief   attaches a free-form-deformation lattice to a volume
 *
 * The volume passes through by shallow copy. The filter never touches a voxel: it attaches the
 * lattice that its strokes bend (DeformableVolume.h describes the field data). "Deformed Volume"
 * draws the result bent. Other filters see the volume undeformed, unless Bake Deformation stands
 * before them. After an error the last good deformation stays.
 *
 * - Input 0: the volume, vtkImageData with at least two points along each axis. A volume that
 *   carries a deformation already is passed on as it is, with an error.
 * - Input 1 (optional): a base lattice or a dense displacement field, vtkImageData with a point
 *   array of three components (mm, world axes, forward). It is read at the control points, and
 *   strokes add to it. An array Deviation of a lattice with the same control points is attached,
 *   too, and counts how far strokes and Strength put tissue from where that lattice has it.
 * - Input 2 (optional): a mask, as in vtkLatticeAlgorithm, which has the lattice's settings.
 * - Input 3 (optional): a segmentation, vtkImageData on any grid with labels or scalars. It bends
 *   nothing. It is attached, so that "Deformed Volume" can draw chosen labels alone
 *   (Segmentation.h). Without it the mask is attached as the segmentation.
 *
 * Method: van der Steen et al., SPIE 7169 (2009), section 2.
 */
#ifndef vtkFreeFormDeformation_h
#define vtkFreeFormDeformation_h

#include "vtkBrainShiftFiltersModule.h" // for the export macro
#include "vtkLatticeAlgorithm.h"

#include <memory> // for the private part
#include <string> // for messages
#include <vector> // for strokes

class vtkDoubleArray;
namespace brainshift
{
struct Grid;
struct Lattice;
struct Stroke;
}

class VTKBRAINSHIFTFILTERS_EXPORT vtkFreeFormDeformation : public vtkLatticeAlgorithm
{
public:
  static vtkFreeFormDeformation* New();
  vtkTypeMacro(vtkFreeFormDeformation, vtkLatticeAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;
  vtkTypeBool ProcessRequest(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

  ///@{
  /** Factor on all displacements, 0 to 1. Default 1. */
  vtkSetClampMacro(Strength, double, 0.0, 1.0);
  vtkGetMacro(Strength, double);
  ///@}

  ///@{
  /**
   * Whether each stroke is shortened to the largest part of it that keeps the Jacobian determinant
   * of deformedFromRest at 0.1 or above everywhere (FoldGuard.h). Default on. The numbers of the
   * strokes stay as they are; GetStrokeShares returns what was applied. In cells where the base
   * lattice folds by itself strokes are not shortened, and a warning says so.
   */
  vtkSetMacro(GuardFolding, bool);
  vtkGetMacro(GuardFolding, bool);
  vtkBooleanMacro(GuardFolding, bool);
  ///@}

  ///@{
  /**
   * How pictures find tissue. 0: Exact (default): tissue arrives where the control point is put. 1:
   * Negated: the form in the paper, which is right for small displacements only.
   */
  vtkSetMacro(Inverse, int);
  vtkGetMacro(Inverse, int);
  ///@}

  ///@{
  /**
   * The point (mm, world) that the long axis of a stamp goes through. Only the tools read it,
   * because each stroke holds its own axis. Default 0 0 0; ParaView sets it to the centre of the
   * volume.
   */
  vtkSetVector3Macro(PointOfInterest, double);
  vtkGetVector3Macro(PointOfInterest, double);
  ///@}

  /**
   * The strokes, replayed in order: 14 numbers each (Stroke.h). A list of the wrong length is an
   * error. Default: none.
   */
  void SetStrokeNumbers(const std::vector<double>& numbers);

  /** The base lattice (input 1). */
  void SetLatticeConnection(vtkAlgorithmOutput* lattice);

  /** The segmentation (input 3). */
  void SetSegmentationConnection(vtkAlgorithmOutput* segmentation);

  /** Largest displacement (mm) of a control point; Strength is applied. */
  double GetMaximumDisplacement();

  /**
   * Smallest Jacobian determinant of deformedFromRest within the volume; Strength is applied. 1:
   * the volume of tissue is kept; above 1: all tissue grows; 0 or less: tissue folds. The figure is
   * proved: the determinant is nowhere smaller. LatticeExtremes.h says how near it is. It is
   * computed when this is called.
   */
  double GetMinimumJacobian();

  /** How many strokes the fold guard shortened. */
  int GetShortenedStrokes() const;

  /** The fraction of each stroke that was applied, 0 to 1. A disabled stroke has 1. */
  vtkDoubleArray* GetStrokeShares();

  /**
   * How far (mm) each stroke took the tissue at its anchor along its vector, before Strength. The
   * length of the vector was asked for. A coarse lattice, the fold guard and the feather of a mask
   * leave less of it. 0 for a disabled stroke.
   */
  vtkDoubleArray* GetStrokeReaches();

  /** How many strokes the last execution applied: 1 while the last stroke is being changed. */
  int GetAppliedStrokes() const;

protected:
  vtkFreeFormDeformation();
  ~vtkFreeFormDeformation() override;

  int RequestUpdateExtent(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkFreeFormDeformation(const vtkFreeFormDeformation&) = delete;
  void operator=(const vtkFreeFormDeformation&) = delete;

  int Inverse = 0;
  double Strength = 1.0;
  bool GuardFolding = true;
  double PointOfInterest[3] = { 0.0, 0.0, 0.0 };

  // Throws a Problem on a property that is wrong.
  void RequireProperties() const;

  // Bends the lattice by the properties. If it throws, the last good deformation remains.
  void ReplayStrokes(
    const brainshift::Lattice& start, const std::vector<brainshift::Stroke>& strokes);
  void Bend(const brainshift::Grid& volumeGrid, vtkImageData* base, vtkImageData* maskImage,
    vtkImageData* segments);

  // Warns of what the user should know. A warning is repeated only after it was gone.
  void TellWarnings();

  struct State; // strokes, replay and the last good deformation
  std::unique_ptr<State> Internal;
};

#endif
