// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Presets of a volume in the window: colours, opacities and a camera that fit its tissue. The
/// process that has the data makes them (vtkVolumeLookReport).
#ifndef BrainShift_VolumeLook_h
#define BrainShift_VolumeLook_h

#include <QString>
#include <QStringList>

#include <vector>

class pqDataRepresentation;
class vtkSMProxy;
class vtkSMRenderViewProxy;

namespace brainshift
{
/// The presets of a volume, and one of them.
struct VolumeLook
{
  QString kind;                  ///< MR, CT, Ultrasound or Labels; empty without a volume
  QStringList names;             ///< of all its presets; the first one is the default
  QString name;                  ///< of this preset; empty if there is none
  std::vector<double> colors;    ///< value, red, green, blue of each colour
  std::vector<double> opacities; ///< value, opacity
  bool drawsSegment = false;     ///< draws the attached segmentation alone
  std::vector<double> tissue;    ///< mm, world: x, y, z of the farthest tissue; see aimAt
};

/// Reads the volume of a display that has colours, and makes a preset for it.
/// @param name   which one; empty: the first of them
VolumeLook makeVolumeLook(pqDataRepresentation* display, const QString& name = {});

/// The two values that bound the tissue of the array that colours a display, as Four Views shows
/// it: from 1 % to 99 %. Empty if there are none.
std::vector<double> tissueWindow(pqDataRepresentation* display);

/// Gives a display these colours and opacities, and shading. It renders nothing.
void applyLook(pqDataRepresentation* display, const VolumeLook& look);

/// Whether a colour map is still as a preset set it. False if the user edited it.
bool isLook(vtkSMProxy* colors);

/// Remembers colours that nobody has chosen: those that ParaView gave to a volume without presets.
void noteUnchosen(vtkSMProxy* colors);
/// Whether a colour map still has them, over any range of values.
bool isUnchosen(vtkSMProxy* colors);

/// The preset that the user chose last for volumes of this kind; empty if none.
QString chosenLook(const QString& kind);
/// Remembers it, also for the next start.
void rememberLook(const QString& kind, const QString& name);

/// Moves the camera to the patient's right, front and above, so that tissue fills the view.
/// @param tissue   mm, world: x, y, z of its farthest points; if there are none, the camera does
/// not move
void aimAt(vtkSMRenderViewProxy* view, const std::vector<double>& tissue);
}

#endif
