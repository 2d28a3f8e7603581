// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/Writers/LeftOut.h"

#include "Common/LabelTable.h"
#include "Formats/Files/Text.h"

#include "vtkImageData.h"

namespace brainshift
{
namespace
{
void addSentence(std::string& warning, const std::string& note)
{
  warning += (warning.empty() ? "" : ". ") + note;
}
}

void noteLeftOut(const std::string& fileName, vtkImageData* image, vtkInformation* pipeline,
  const OutgoingVolume& volume, std::string& warning)
{
  std::vector<std::string> notes;
  const std::string times = noteOfTimes(image, pipeline, "file");
  if (!times.empty())
  {
    notes.push_back(times);
  }
  const bool keepsLabels = endsWith(lowerCase(fileName), ".seg.dcm"); // a segmentation
  const std::size_t labels = volume.isLabelMap && !keepsLabels ? attachedLabels(image).size() : 0;
  if (labels > 0)
  {
    notes.push_back(joined(
      "The names and colours of ", labels, labels == 1 ? " label" : " labels", " are left out"));
  }
  const bool saysLabels =
    keepsLabels || endsWith(fileName, ".nii") || endsWith(fileName, ".nii.gz");
  if (volume.isLabelMap && labels == 0 && !saysLabels)
  {
    notes.emplace_back("That its values are labels is left out; .nii and .nii.gz would say it");
  }
  for (const std::string& note : notes)
  {
    addSentence(warning, note);
  }
}

void noteMeaningLeftOut(const OutgoingVolume& volume, bool isSeries, std::string& warning)
{
  if (!volume.unit.empty())
  {
    addSentence(warning, "The unit of its values, " + volume.unit + ", is left out");
  }
  if (volume.smallIsBright && !isSeries)
  {
    addSentence(warning,
      "That small values are bright (MONOCHROME1) is left out; a DICOM series would say it");
  }
}
}
