// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Small volumes and the two filters around them, for tests of the pipeline.
#ifndef BrainShift_TestPipeline_h
#define BrainShift_TestPipeline_h

#include "Common/ImageGrid.h"
#include "Filters/Attached/DeformableVolume.h"
#include "Filters/Deformation/Stroke.h"
#include "Testing/Cxx/Deformation/TestLattices.h"
#include "vtkBakeDeformation.h"
#include "vtkFreeFormDeformation.h"

#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkDataArray.h>
#include <vtkExecutive.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkSmartPointer.h>

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

namespace brainshift::testing
{
// An image with this geometry and nothing in it.
inline vtkSmartPointer<vtkImageData> imageOn(const Grid& grid)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(grid.dimensions.x, grid.dimensions.y, grid.dimensions.z);
  image->SetOrigin(grid.origin.x, grid.origin.y, grid.origin.z);
  image->SetSpacing(grid.spacing.x, grid.spacing.y, grid.spacing.z);
  const glm::dmat3 rows = glm::transpose(grid.direction);
  image->SetDirectionMatrix(&rows[0][0]);
  return image;
}

// Axes that no rotation has, as other programs may hand them over.
inline void shear(vtkImageData* image)
{
  image->SetDirectionMatrix(1.0, 0.1, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0);
}

// What is said of them.
constexpr const char* NotPerpendicular = "direction has axes that are not perpendicular and 1 long";

inline vtkSmartPointer<vtkDataArray> arrayOf(
  int type, const char* name, vtkIdType count, const std::function<double(vtkIdType)>& value)
{
  auto array = vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(type));
  array->SetName(name);
  array->SetNumberOfTuples(count);
  for (vtkIdType i = 0; i < count; ++i)
  {
    array->SetTuple1(i, value(i));
  }
  return array;
}

// Point scalars "Intensity" on a grid.
inline vtkSmartPointer<vtkImageData> volumeOn(
  const Grid& grid, int type, const std::function<double(vtkIdType)>& value)
{
  auto image = imageOn(grid);
  image->GetPointData()->SetScalars(arrayOf(type, "Intensity", image->GetNumberOfPoints(), value));
  return image;
}

// A displacement field on a grid: what registration programs write.
inline vtkSmartPointer<vtkImageData> fieldOn(
  const Grid& grid, const std::function<glm::dvec3(const glm::dvec3&)>& displacement)
{
  auto image = imageOn(grid);
  const Lattice lattice = latticeOf(grid, 0, displacement);
  auto vectors = vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(VTK_FLOAT));
  vectors->SetName("Displacement");
  vectors->SetNumberOfComponents(3);
  vectors->SetNumberOfTuples(image->GetNumberOfPoints());
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    const glm::vec3& d = lattice.displacements[i];
    vectors->SetTuple3(i, d.x, d.y, d.z);
  }
  image->GetPointData()->AddArray(vectors);
  return image;
}

// Collects what a filter would tell the user: errors and warnings.
class Errors
{
public:
  explicit Errors(vtkAlgorithm* filter)
  {
    this->Collect->SetClientData(this);
    this->Collect->SetCallback([](vtkObject*, unsigned long, void* self, void* text) {
      static_cast<Errors*>(self)->Text += static_cast<const char*>(text);
    });
    filter->AddObserver(vtkCommand::ErrorEvent, this->Collect);
    filter->AddObserver(vtkCommand::WarningEvent, this->Collect);
    filter->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, this->Collect);
  }

  ~Errors() { this->Collect->SetCallback(nullptr); } // a filter that lives on keeps the command
  Errors(const Errors&) = delete;
  Errors& operator=(const Errors&) = delete;

  // What was said since the last call.
  std::string take()
  {
    std::string text;
    text.swap(this->Text);
    return text;
  }

private:
  vtkNew<vtkCallbackCommand> Collect;
  std::string Text;
};

inline void setStrokes(vtkFreeFormDeformation* filter, const std::vector<Stroke>& strokes)
{
  filter->SetStrokeNumbers(numbersFromStrokes(strokes));
}

// The deformation attached to a filter's output.
inline Deformation deformationOf(vtkImageData* output)
{
  return readDeformation(output); // a Problem fails the test
}
}

#endif
