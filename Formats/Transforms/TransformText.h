// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Reads transforms that are text: ITK's, elastix' parameter files, and 4 x 4 matrices.
 */
#ifndef BrainShift_TransformText_h
#define BrainShift_TransformText_h

#include "Formats/Transforms/TransformRecord.h"

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace brainshift
{
/** How an ITK transform file begins. */
constexpr const char* ITKTextBegin = "#Insight Transform File";

/** Reads ITK's text. Returns the end of a sentence, after the name of the file. */
std::string readITKText(const std::string& text, std::vector<TransformRecord>& records);

/** The 16 numbers of a text that holds nothing else; none for any other text. */
std::optional<std::vector<double>> matrixText(const std::string& text);

/** Adds the links of another file. Returns the end of a sentence, after the name of that file. */
using AddFile = std::function<std::string(const std::string& fileName, PointTransform& transform)>;

/** Whether a text is an elastix parameter file of a transform. */
bool isElastixText(const std::string& text);

/**
 * Adds the links of an elastix parameter file.
 *
 * @param fileName   the file itself: names in it may be relative to its folder
 * @param addFile    adds the initial transform, or a displacement field
 */
std::string addElastixText(const std::string& text, const std::string& fileName,
  const AddFile& addFile, PointTransform& transform);
}

#endif
