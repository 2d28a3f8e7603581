// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkLatticeAlgorithm
 * @brief   a filter that makes a lattice over a volume: the lattice's settings and its mask
 *
 * This is the one place that has the settings of a lattice. Free-Form Deformation, Fit Deformation
 * and Refined Lattice are such filters; Proxies/LatticeSettings.xml describes the settings.
 *
 * - Input 0: the volume at rest, vtkImageData. The lattice covers its box.
 * - Input 1 (optional): the base, a forward displacement field on any grid (mm, world axes).
 * - Input 2 (optional): the mask, vtkImageData on any grid with labels or scalars. Only tissue
 *   inside it moves (MaskWeights.h).
 */
#ifndef vtkLatticeAlgorithm_h
#define vtkLatticeAlgorithm_h

#include "vtkBrainShiftFiltersModule.h" // for the export macro
#include "vtkPassInputTypeAlgorithm.h"

#include <memory> // for the private part
#include <vector> // for labels

class vtkImageData;
namespace brainshift
{
class MaskSource;
struct Grid;
struct Lattice;
}

class VTKBRAINSHIFTFILTERS_EXPORT vtkLatticeAlgorithm : public vtkPassInputTypeAlgorithm
{
public:
  vtkTypeMacro(vtkLatticeAlgorithm, vtkPassInputTypeAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /** Control points along each axis of the volume, 4 to 257. Default 19 19 19. */
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
  vtkSetClampMacro(Kernel, int, 0, 1);
  vtkGetMacro(Kernel, int);
  ///@}

  /** The mask (input 2). */
  void SetMaskConnection(vtkAlgorithmOutput* mask);

  ///@{
  /** The labels of the mask that are inside. Default: none, which means every value above 0. */
  void AddMaskLabel(int label) { this->Append(this->MaskLabels, label); }
  void ClearMaskLabels() { this->Clear(this->MaskLabels); }
  ///@}

  ///@{
  /**
   * Distance (mm) from the mask's edge over which the displacement rises from 0 to its full size; 0
   * or more. Default 10. The edge is moved inwards to nodes of the refined field, by two of them at
   * most.
   */
  vtkSetMacro(Feather, double);
  vtkGetMacro(Feather, double);
  ///@}

  static constexpr double ByFeather = -1.0; ///< MaskGrowth: as Feather needs

  ///@{
  /**
   * Distance (mm) by which the mask grows before anything else is done with it; 0 or more, or
   * ByFeather (the default): as far as the feather is wide, and the diagonals of two cells of the
   * refined field and of a voxel of the mask, 12 mm at most. Then the feather is outside the mask,
   * and all tissue in it moves by the whole displacement, such as the cortex under a mask of the
   * brain. The mask's image limits the growth.
   */
  vtkSetMacro(MaskGrowth, double);
  vtkGetMacro(MaskGrowth, double);
  ///@}

protected:
  vtkLatticeAlgorithm();
  ~vtkLatticeAlgorithm() override;

  static constexpr int BasePort = 1;
  static constexpr int MaskPort = 2;

  ///@{
  /** Changes a property that is a list. */
  template <typename List, typename Item>
  void Append(List& list, const Item& item)
  {
    list.push_back(item);
    this->Modified();
  }
  template <typename List>
  void Clear(List& list)
  {
    list.clear();
    this->Modified();
  }
  ///@}

  /** Input 0 is required, all others are optional. All are vtkImageData. */
  int FillInputPortInformation(int port, vtkInformation* info) override;

  /** Control points over the box of a volume. Sides beyond their limits are clamped. */
  brainshift::Grid LatticeGrid(const brainshift::Grid& volume) const;

  /** Announces the control points as the output: the answer to RequestInformation. */
  int AnnounceLattice(vtkInformationVector** inputs, vtkInformationVector* outputs) const;

  /**
   * Makes the lattice by the settings, with displacements of 0. The weights of the mask are kept
   * until something that they depend on changes.
   *
   * @param mask   null or empty: no mask
   *
   * Throws a Problem on a setting or a mask that is wrong.
   */
  brainshift::Lattice MakeLattice(const brainshift::Grid& volume, vtkImageData* mask);

  const std::vector<int>& ChosenLabels() const { return this->MaskLabels; }

private:
  vtkLatticeAlgorithm(const vtkLatticeAlgorithm&) = delete;
  void operator=(const vtkLatticeAlgorithm&) = delete;

  void RequireSettings() const;

  int LatticeDimensions[3] = { 19, 19, 19 };
  int Samples = 4;
  int Kernel = 0;
  double Feather = 10.0;
  double MaskGrowth = ByFeather;
  std::vector<int> MaskLabels;
  const std::unique_ptr<brainshift::MaskSource> Masks;
};

#endif
