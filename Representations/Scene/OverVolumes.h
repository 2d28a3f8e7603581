// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Props that are drawn over the volumes.
#ifndef BrainShift_OverVolumes_h
#define BrainShift_OverVolumes_h

#include "vtkOpenGLActor.h"

class vtkRenderer;

namespace brainshift
{
/**
 * @class   OverVolumes
 * @brief   a prop that is drawn over the volumes, so that it changes no volume's own picture
 */
class OverVolumes : public vtkOpenGLActor
{
public:
  vtkAbstractTypeMacro(OverVolumes, vtkOpenGLActor);

  /// Whether a renderer draws any.
  static bool areVisibleIn(vtkRenderer* renderer);

protected:
  OverVolumes() = default;
  ~OverVolumes() override = default;
};
}

#endif
