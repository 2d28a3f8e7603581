// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What a refinement was made of, as annotations that state files keep. lineage.py in Python reads
/// and writes the same.
#ifndef BrainShift_Lineage_h
#define BrainShift_Lineage_h

#include <QJsonArray>
#include <QJsonObject>

class vtkSMProxy;

namespace brainshift
{
/// The landmarks at rest that a lattice, or the fits that it began from, used: pairs of the
/// identity of a source and its file. Null has none.
QJsonArray landmarksFittedBy(vtkSMProxy* lattice);

/// Keeps the landmarks at a lattice that has no fit any more.
void keepFitted(vtkSMProxy* lattice, const QJsonArray& landmarks);

/// Volume, reference and cavity of a Compare Volumes of a deformation, and the position of the
/// reference: mm, then degrees.
QJsonObject comparedBy(vtkSMProxy* deformation, vtkSMProxy* comparison);
}

#endif
