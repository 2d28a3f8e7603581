// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Finds the Free-Form Deformation that the tools and the toolbar act on.
#ifndef BrainShift_ActiveDeformation_h
#define BrainShift_ActiveDeformation_h

#include <QSet>

class pqDataRepresentation;
class pqPipelineSource;
class pqView;
class vtkSMProxy;

namespace brainshift
{
// Finds the views that a change of a source is seen in.

/// The views that show the source or something made of it.
QSet<pqView*> viewsShowing(pqPipelineSource* source);

/// Whether a source is a Free-Form Deformation.
bool isDeformation(pqPipelineSource* source);

/// Whether a property of a proxy is a setting of its lattice: LatticeSettings.xml marks them. A
/// lattice must have the same ones as the deformation that takes it.
bool isLatticeSetting(vtkSMProxy* proxy, const char* property);
/// Copies the input and the settings of the lattice from a deformation to a filter that makes a
/// lattice for it, as far as that filter has them.
void shareLattice(vtkSMProxy* deformation, vtkSMProxy* lattice);

/// The active source, if it is a Free-Form Deformation. Otherwise the nearest one upstream or
/// downstream that the view shows. Otherwise the only one there is. Null if there is none.
pqPipelineSource* activeDeformation(pqView* view);
/// activeDeformation of the active view.
pqPipelineSource* activeDeformation();

/// The nearest Free-Form Deformation among what a source is made of. Null if there is none.
pqPipelineSource* deformationUpstream(pqPipelineSource* source);

/// Whether a source is a volume as a Free-Form Deformation bends it, or is made of that.
bool isBentFrom(pqPipelineSource* source, vtkSMProxy* volume);

/// The representation (Deformed Volume or Deformed Slices) with which a view shows a Free-Form
/// Deformation, or shows what a filter like Compare Volumes made of it. Null if there is none.
pqDataRepresentation* bentDisplay(pqPipelineSource* deformation, pqView* view);
/// A Free-Form Deformation that a view shows, if it does not show `deformation`. Otherwise null.
pqPipelineSource* shownInstead(pqPipelineSource* deformation, pqView* view);
/// Whether a representation has a Translation, an Orientation or a Scale. What it draws is
/// elsewhere than its volume then, and tools do not work in it.
bool isMoved(pqDataRepresentation* display);
/// Whether a representation is Deformed Slices.
bool showsSlices(pqDataRepresentation* display);
/// Whether a representation is Deformed Volume.
bool showsVolume(pqDataRepresentation* display);
}

#endif
