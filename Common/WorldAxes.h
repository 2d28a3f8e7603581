// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What the world axes of a volume mean for the patient.
///
/// The field array WorldAxes holds one string, "RAS" or "LPS". A reader attaches it where the file
/// gives the orientation. Free-Form Deformation passes it on, and so do most of ParaView's filters.
/// Letters for the patient's sides are drawn only where the axes are known.
#ifndef BrainShift_WorldAxes_h
#define BrainShift_WorldAxes_h

#include "vtkBrainShiftCommonModule.h" // for the export macro

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
}

#endif
