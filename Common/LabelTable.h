// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Names and colours of the values of a label map.
///
/// Field arrays: LabelValues (int32, 1 component), LabelNames (string) and LabelColors (uint8, 3
/// components: red, green, blue), one tuple for each label; and LabelTerms (string) where a label
/// has coded terms. A reader attaches them where the file
/// names its labels. Free-Form Deformation passes them on, and so do most of ParaView's filters.
/// For the labels of another image that travels with the volume the arrays have another first word
/// (Segmentation.h).
#ifndef BrainShift_LabelTable_h
#define BrainShift_LabelTable_h

#include "vtkBrainShiftCommonModule.h" // for the export macro

#include <array>
#include <string>
#include <vector>

class vtkDataObject;

namespace brainshift
{
/** One label. */
struct Label
{
  int value = 0; ///< of the voxels
  std::string name;
  std::array<unsigned char, 3> color{ 255, 255, 255 }; ///< red, green, blue
  /// What it is in coded terms, "category~type~modifier", each "scheme^code^meaning" as 3D Slicer
  /// writes them; "~region~modifier of the region" follow where an anatomic region is named. Empty:
  /// not said.
  std::string terms;
};

/** First word of the arrays' names: they are about the values of the volume itself. */
constexpr const char* OwnLabels = "Label";

/** Attaches the arrays, or removes them if there are no labels. */
VTKBRAINSHIFTCOMMON_EXPORT void attachLabels(
  vtkDataObject* volume, const std::vector<Label>& labels, const std::string& word = OwnLabels);

/** The labels that are attached. None if an array is missing or has another length, or for null. */
VTKBRAINSHIFTCOMMON_EXPORT std::vector<Label> attachedLabels(
  vtkDataObject* volume, const std::string& word = OwnLabels);

/**
 * Whether the values of a volume are labels: it has a table of its own, or markLabelMap was called.
 * Labels are never blended. False for null.
 */
VTKBRAINSHIFTCOMMON_EXPORT bool isLabelMap(vtkDataObject* volume);

/** Notes that the values of a volume are labels (field array IsLabelMap, one byte), or not. */
VTKBRAINSHIFTCOMMON_EXPORT void markLabelMap(vtkDataObject* volume, bool isLabelMap);

/** The name of a value, where one is attached. Empty: none. */
VTKBRAINSHIFTCOMMON_EXPORT std::string labelName(
  vtkDataObject* volume, double value, const std::string& word = OwnLabels);
}

#endif
