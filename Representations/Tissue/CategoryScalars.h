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

  /// Follows the array and the property. False if the array has more distinct values than the
  /// texture of colours has entries.
  bool update(vtkDataArray* scalars, int component, vtkVolumeProperty* property);

  /// For each voxel the number of its value in ascending order, from 0; NaN where the value is NaN.
  vtkDataArray* numbers() const { return this->Numbers; }

  /// The property with colours and opacities of these numbers. A value without annotation has the
  /// colour for NaN, as in ParaView's Slice; the opacity is that of the value.
  vtkVolumeProperty* property() const { return this->Property; }

private:
  void count(vtkDataArray* scalars, int component);
  void color(vtkVolumeProperty* property);

  std::vector<double> Values; // distinct, ascending
  vtkSmartPointer<vtkDataArray> Numbers;
  vtkNew<vtkVolumeProperty> Property;
  vtkWeakPointer<vtkDataArray> Counted;
  unsigned long long CountedTime = 0;
  int CountedComponent = 0;
  unsigned long long ColoredTime = 0;
};
}

#endif
