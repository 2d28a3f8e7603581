// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// ITK's form of a transform: a type and two lists of numbers. Its text files, its HDF5 files and
/// ANTs' MATLAB files store it, and elastix' parameter files can be brought into it.
#ifndef BrainShift_TransformRecord_h
#define BrainShift_TransformRecord_h

#include "Formats/Transforms/PointTransform.h"

#include <functional>

namespace brainshift
{
/** As ITK writes it. */
struct TransformRecord
{
  std::string type; ///< such as AffineTransform_double_3_3
  std::vector<double> parameters;
  std::vector<double> fixed; ///< a centre (mm), or a grid
};

/**
 * Adds the links of records, in LPS, or throws the end of a sentence, after the name of the file.
 * ITK's composite applies its last record first. Of several records without a composite, only a
 * BSplineDeformableTransform with its bulk after it says what they are together.
 */
void addRecords(const std::vector<TransformRecord>& records, PointTransform& transform);

/** Adds a 4 x 4 matrix in rows that maps LPS to LPS (mm), as addRecords does. */
void addMatrix(const std::vector<double>& rows, PointTransform& transform);

///@{
/** Read ITK's records in the bytes of a MATLAB file, or throw as addRecords does. */
std::vector<TransformRecord> readMatlabRecords(const std::string& bytes);

/** Likewise in an HDF5 file. */
std::vector<TransformRecord> readHDF5Records(const std::string& fileName);
///@}

/** Whether a file is an HDF5 file. */
bool isHDF5(const std::string& fileName);

/** A rotation about x, y or z (radians), in ITK's sense. */
glm::dmat3 turnedAbout(int axis, double angle);

/** How an ITK transform file begins. */
constexpr const char* ITKTextBegin = "#Insight Transform File";

/** Reads the records in ITK's text, or throws as addRecords does. */
std::vector<TransformRecord> readITKText(const std::string& text);

/** The 16 numbers of a text that holds nothing else; none for any other text. */
std::optional<std::vector<double>> matrixText(const std::string& text);

/** Adds the links of another file, or throws the end of a sentence. */
using AddFile = std::function<void(const std::string& fileName, PointTransform& transform)>;

/** Whether a text is an elastix parameter file of a transform. */
bool isElastixText(const std::string& text);

/**
 * Adds the links of an elastix parameter file, or throws as addRecords does.
 *
 * @param fileName   the file itself: names in it may be relative to its folder
 * @param addFile    adds the initial transform, or a displacement field
 */
void addElastixText(const std::string& text, const std::string& fileName, const AddFile& addFile,
  PointTransform& transform);
}

#endif
