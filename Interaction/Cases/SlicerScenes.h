// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// File > Open of scenes of 3D Slicer.
#ifndef BrainShift_SlicerScenes_h
#define BrainShift_SlicerScenes_h

#include <QObject>

class pqPipelineSource;

namespace brainshift
{
/// Puts what a scene holds into the pipeline, in place of the source that File > Open makes.
class SlicerScenes : public QObject
{
public:
  explicit SlicerScenes(QObject* parent);

private:
  void openSoon(pqPipelineSource* source);
};
}

#endif
