// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Values that a colour map interprets as categories (InterpretValuesAsCategories), as numbers of a
/// table: neither voxels nor colours are blended, and labels of any size stay apart.
#ifndef BrainShift_CategoryScalars_h
#define BrainShift_CategoryScalars_h

#include "vtkNew.h"
#include "vtkSmartPointer.h"
#include "vtkWeakPointer.h"

#include <vector>

class vtkColorTransferFunction;
class vtkDataArray;
class vtkVolumeProperty;

namespace brainshift
{
/// The categories of one array, each distinct value being one.
class CategoryScalars
{
public:
  CategoryScalars();
  ~CategoryScalars();

  /// Whether a property's colour map interprets values as categories.
  static bool areWanted(vtkVolumeProperty* property);

  /// Follows the array and the property. If the array has more distinct values than the texture of
  /// colours has entries, only annotated values are categories, and all others share one that is
  /// transparent in 3D. False if these are too many, too.
  bool update(vtkDataArray* scalars, int component, vtkVolumeProperty* property);

  /// For each voxel the number of its category in ascending order of values, from 0; the number of
  /// categories for all other values; NaN where the value is NaN.
  vtkDataArray* numbers() const { return this->Numbers; }

  /// The property with colours and opacities of these numbers. A value without annotation has the
  /// colour for NaN, as in ParaView's Slice; the opacity is that of the value.
  vtkVolumeProperty* property() const { return this->Property; }

private:
  void count(vtkDataArray* scalars, int component, vtkColorTransferFunction* map);
  void color(vtkVolumeProperty* property);

  std::vector<double> Values; // distinct, ascending
  vtkSmartPointer<vtkDataArray> Numbers;
  vtkNew<vtkVolumeProperty> Property;
  vtkWeakPointer<vtkDataArray> Counted;
  unsigned long long CountedTime = 0;
  int CountedComponent = 0;
  unsigned long long CountedMapTime = 0;
  bool IsOfAnnotations = false; // there are too many values
  unsigned long long ColoredTime = 0;
};
}

#endif
