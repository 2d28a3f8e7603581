// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Attached/Segmentation.h"
#include "Common/SharedArray.h"

#include "Filters/Attached/CarriedGrid.h"
#include "Filters/Attached/MaskImage.h"

#include "vtkDataObject.h"
#include "vtkFieldData.h"
#include "vtkIntArray.h"

namespace brainshift
{
namespace
{
constexpr const char* MaskGridName = "FFDMaskGrid";
constexpr const char* GridName = "FFDSegmentationGrid";
constexpr const char* ChosenName = "FFDSegmentationLabels";
constexpr const char* MovingName = "FFDSegmentationMoving";

vtkSmartPointer<vtkDataArray> arrayOf(const char* name, const std::vector<int>& labels)
{
  auto array = vtkSmartPointer<vtkIntArray>::New();
  array->SetName(name);
  for (const int label : labels)
  {
    array->InsertNextValue(label);
  }
  return array;
}

std::vector<int> labelsIn(vtkDataArray* array)
{
  std::vector<int> labels;
  for (vtkIdType i = 0; array && i < array->GetNumberOfTuples(); ++i)
  {
    labels.push_back(static_cast<int>(array->GetComponent(i, 0)));
  }
  return labels;
}
}

void attachSegmentation(vtkDataObject* volume, const Segmentation& segmentation)
{
  vtkFieldData* fields = volume->GetFieldData();
  for (const char* name :
    { SegmentationName, GridName, ChosenName, MovingName, MaskLabelsName, MaskGridName })
  {
    fields->RemoveArray(name);
  }
  attachLabels(
    volume, segmentation.labels ? segmentation.names : std::vector<Label>(), SegmentationLabels);
  if (!segmentation.labels)
  {
    return;
  }
  fields->AddArray(segmentation.labels);
  attachGrid(fields, GridName, segmentation.grid);
  if (!segmentation.chosen.empty())
  {
    fields->AddArray(arrayOf(ChosenName, segmentation.chosen));
  }
  if (segmentation.moving)
  {
    std::vector<int> counted{ static_cast<int>(segmentation.moving->size()) };
    counted.insert(counted.end(), segmentation.moving->begin(), segmentation.moving->end());
    fields->AddArray(arrayOf(MovingName, counted));
  }
  if (segmentation.mask)
  {
    fields->AddArray(segmentation.mask);
    attachGrid(fields, MaskGridName, segmentation.maskGrid);
  }
}

Segmentation readSegmentation(vtkDataObject* volume)
{
  vtkFieldData* fields = volume->GetFieldData();
  Segmentation segmentation;
  vtkDataArray* labels = fields->GetArray(SegmentationName);
  if (!labels || !readGrid(fields, GridName, segmentation.grid) ||
    labels->GetNumberOfValues() != static_cast<vtkIdType>(segmentation.grid.count()))
  {
    return segmentation;
  }
  segmentation.labels = labels;
  segmentation.chosen = labelsIn(fields->GetArray(ChosenName));
  const std::vector<int> moving = labelsIn(fields->GetArray(MovingName));
  if (!moving.empty() && moving.front() == static_cast<int>(moving.size()) - 1)
  {
    segmentation.moving.emplace(moving.begin() + 1, moving.end());
  }
  segmentation.mask = fields->GetArray(MaskLabelsName);
  if (segmentation.mask &&
    (!readGrid(fields, MaskGridName, segmentation.maskGrid) ||
      segmentation.mask->GetNumberOfValues() !=
        static_cast<vtkIdType>(segmentation.maskGrid.count())))
  {
    segmentation.mask = nullptr;
    segmentation.moving.reset();
  }
  return segmentation;
}

Mask segmentOf(const Segmentation& segmentation, const std::vector<int>& labels)
{
  return { segmentation.grid, insideOf(segmentation.labels, labels) };
}

Mask movingTissue(const Segmentation& segmentation)
{
  if (!segmentation.labels || !segmentation.moving)
  {
    return {};
  }
  const std::vector<int>& labels = *segmentation.moving;
  return segmentation.mask ? Mask{ segmentation.maskGrid, insideOf(segmentation.mask, labels) }
                           : segmentOf(segmentation, labels);
}

Segmentation SegmentationSource::find(vtkImageData* image, const Grid& volume)
{
  Segmentation segmentation;
  if (!image || image->GetNumberOfPoints() == 0)
  {
    return segmentation;
  }
  const LabelImage found = labelsOf(image);
  requireLabels(found, volume, { "segmentation" });
  if (this->Source != found.labels || this->SourceTime != found.labels->GetMTime())
  {
    this->Source = found.labels;
    this->SourceTime = found.labels->GetMTime();
    this->Labels = sharedAs(this->Name, found.labels);
  }
  segmentation.labels = this->Labels;
  segmentation.grid = found.grid;
  segmentation.names = attachedLabels(image);
  return segmentation;
}
}
