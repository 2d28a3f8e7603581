// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Gradient opacity, or a 2D transfer function, as a texture.
///
/// Steepness is the gradient magnitude that VTK's volume mapper looks opacities up with: the change
/// of the scalar over a mean voxel side, as a fraction of a quarter of the array's range, 0 to 1.
///
/// Gradient opacity: Levoy, IEEE Computer Graphics and Applications 8(3), 1988. 2D transfer
/// functions: Kniss, Kindlmann and Hansen, IEEE Transactions on Visualization and Computer Graphics
/// 8(3), 2002.
#ifndef BrainShift_SteepnessTexture_h
#define BrainShift_SteepnessTexture_h

#include "Representations/Gpu/ShaderSource.h"

#include "vtkSmartPointer.h"

#include <glm/glm.hpp>

class vtkTextureObject;
class vtkVolumeProperty;
class vtkWindow;

namespace brainshift
{
struct GpuTask;

/// Change of the scalar over a mean voxel side at which steepness is 1, as a fraction of the
/// array's range.
constexpr double SteepestFraction = 0.25;

/// Which scalars a 2D transfer function makes visible at any steepness.
struct VisibleColumns
{
  std::vector<bool> visible;    ///< Columns that are evenly spread over `range`.
  glm::dvec2 range{ 0.0, 1.0 }; ///< Values of the first and the last column.
  float largest = 0.0f;         ///< Opacity of all entries.
  unsigned long long time = 0;  ///< Differs whenever one of the others does.
};

/// Factors on opacity over steepness, or colours and opacities over scalar and steepness.
class SteepnessTexture
{
public:
  SteepnessTexture();
  ~SteepnessTexture();

  /// Uploads the curve or the table of the property if it changed. `range`: least and greatest
  /// value of the array. Nothing for Opacity::Scalar. False if the GPU refuses.
  bool update(GpuTask& gpu, vtkVolumeProperty* property, Opacity opacity, const glm::dvec2& range);

  ///@{
  /// Texture coordinate = value * scale (x) + shift (y). The value is a fraction of the array's
  /// range, or steepness.
  glm::dvec2 entryFromFraction() const;
  glm::dvec2 entryFromSteepness() const;
  ///@}

  /// Of a 2D transfer function.
  const VisibleColumns& columns() const { return this->Columns; }

  vtkTextureObject* texture() const { return this->Texture; }
  void releaseGraphicsResources(vtkWindow* window);

private:
  bool uploadCurve(GpuTask& gpu, vtkVolumeProperty* property, const glm::dvec2& range);
  bool uploadTable(GpuTask& gpu, vtkVolumeProperty* property, const glm::dvec2& range);
  bool create(GpuTask& gpu, int components, std::vector<float>& texels);

  vtkSmartPointer<vtkTextureObject> Texture;
  VisibleColumns Columns;
  Opacity Kind = Opacity::Scalar;
  glm::dvec2 Range{ 0.0, 1.0 };
  glm::ivec2 Size{ 1 };              // entries
  unsigned long long SourceTime = 0; // of the property's function; VTK's times are unique
};
}

#endif
