// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Attached/Segmentation.h"

#include "Filters/Attached/CarriedArray.h"
#include "Filters/Attached/MaskImage.h"

#include "vtkDataObject.h"
#include "vtkFieldData.h"
#include "vtkIntArray.h"
#include "vtkNew.h"

namespace brainshift
{
namespace
{
constexpr const char* GridName = "FFDSegmentationGrid";
constexpr const char* ChosenName = "FFDSegmentationLabels";
}

void attachSegmentation(vtkDataObject* volume, const Segmentation& segmentation)
{
  vtkFieldData* fields = volume->GetFieldData();
  for (const char* name : { SegmentationName, GridName, ChosenName })
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
    vtkNew<vtkIntArray> chosen;
    chosen->SetName(ChosenName);
    for (const int label : segmentation.chosen)
    {
      chosen->InsertNextValue(label);
    }
    fields->AddArray(chosen);
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
  if (vtkDataArray* chosen = fields->GetArray(ChosenName))
  {
    for (vtkIdType i = 0; i < chosen->GetNumberOfTuples(); ++i)
    {
      segmentation.chosen.push_back(static_cast<int>(chosen->GetComponent(i, 0)));
    }
  }
  return segmentation;
}

Mask segmentOf(const Segmentation& segmentation, const std::vector<int>& labels)
{
  return { segmentation.grid, insideOf(segmentation.labels, labels) };
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
    this->Labels = sharedAs(SegmentationName, found.labels);
  }
  segmentation.labels = this->Labels;
  segmentation.grid = found.grid;
  segmentation.names = attachedLabels(image);
  return segmentation;
}
}
