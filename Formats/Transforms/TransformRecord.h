// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief ITK's form of a transform: a type and two lists of numbers. Its text files, its HDF5 files
 *        and ANTs' MATLAB files store it, and elastix' parameter files can be brought into it.
 */
#ifndef BrainShift_TransformRecord_h
#define BrainShift_TransformRecord_h

#include "Formats/Transforms/PointTransform.h"

#include <string>
#include <vector>

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
 * Adds the links of records, in LPS. ITK's composite applies its last record first, and so does
 * this for several records.
 *
 * @return the end of a sentence, after the name of the file and without a full stop, on what cannot
 *         be used; empty if nothing
 */
std::string addRecords(const std::vector<TransformRecord>& records, PointTransform& transform);

/** Adds a 4 x 4 matrix in rows that maps LPS to LPS (mm). Returns as addRecords does. */
std::string addMatrix(const std::vector<double>& rows, PointTransform& transform);

/** A rotation about x, y or z (radians), in ITK's sense. */
glm::dmat3 turnedAbout(int axis, double angle);
}

#endif
