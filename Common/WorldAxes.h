// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What the world axes of a volume mean for the patient, and whose space its world is.
///
/// The field array WorldAxes holds one string, "RAS" or "LPS". A reader attaches it where the file
/// gives the orientation. Free-Form Deformation passes it on, and so do most of ParaView's filters.
/// Letters for the patient's sides are drawn only where the axes are known.
///
/// The field array Template names the template in whose space a file is, such as "MNI 152".
#ifndef BrainShift_WorldAxes_h
#define BrainShift_WorldAxes_h

#include "vtkBrainShiftCommonModule.h" // for the export macro

#include <string>

class vtkDataObject;

namespace brainshift
{
/** Where x, y and z point in the patient. The numbers are those of the property WorldAxes. */
enum class WorldAxes
{
  Unknown = 0,
  RAS = 1, ///< right, anterior, superior
  LPS = 2  ///< left, posterior, superior
};

/** Attaches the array, or removes it if the axes are unknown. */
VTKBRAINSHIFTCOMMON_EXPORT void nameWorldAxes(vtkDataObject* volume, WorldAxes axes);

/** The axes that the array names. Unknown if there is none, for another word, and for null. */
VTKBRAINSHIFTCOMMON_EXPORT WorldAxes worldAxesOf(vtkDataObject* volume);

/** The template in whose space a world is. The numbers are those of NIfTI's xform codes. */
enum class Template
{
  None = 0, ///< the scanner's, or not said
  Talairach = 3,
  MNI152 = 4,
  Other = 5 ///< one that is not named
};

/** Attaches the array, or removes it. */
VTKBRAINSHIFTCOMMON_EXPORT void nameTemplate(vtkDataObject* data, Template space);

/** The template that the array names. None without one, for another word, and for null. */
VTKBRAINSHIFTCOMMON_EXPORT Template templateOf(vtkDataObject* data);

/** A thing with its axes, in a sentence about them. */
struct NamedAxes
{
  std::string noun; ///< with its article, such as "the volume"
  WorldAxes axes = WorldAxes::Unknown;
  Template space = Template::None;
};

/**
 * What a thing says of its axes and of a template. Without WorldAxes, the field array SPACE of
 * models of 3D Slicer counts. It is for words only: whoever turns a model around leaves it there.
 */
VTKBRAINSHIFTCOMMON_EXPORT NamedAxes namedAxesOf(const std::string& noun, vtkDataObject* data);

/**
 * A sentence, without a full stop, if one of two things says where its axes point in the patient,
 * and the other says something else or nothing: left and right may be exchanged then. Or if one is
 * in the space of a template, and the other is not, or in that of another one. Empty if both say
 * the same, and if neither says it, as data that are of no patient.
 */
VTKBRAINSHIFTCOMMON_EXPORT std::string wordsOnSides(const NamedAxes& one, const NamedAxes& other);

/**
 * The same for what is put into a volume, such as points or a lattice. Scripts and many filters
 * make such things without naming their axes, so what says nothing counts as of the volume's. Nor
 * do most formats of such things have a word for a template.
 */
VTKBRAINSHIFTCOMMON_EXPORT std::string wordsOnSidesOf(
  const NamedAxes& guest, vtkDataObject* volume);
}

#endif
