// SPDX-License-Identifier: BSD-3-Clause
// ParaView's colour map and opacity curve as one texture, opacity corrected for the step.
#ifndef BrainShift_TransferTexture_h
#define BrainShift_TransferTexture_h

#include "Representations/Gpu/Counters.h"
#include "Representations/Picture/MovingQuality.h"
#include "Representations/Skipping/RestPresence.h"
#include "Representations/Gpu/ShaderSource.h"

#include "vtkSmartPointer.h"

#include <vector>

class vtkOpenGLRenderWindow;
class vtkTextureObject;
class vtkVolumeProperty;
class vtkWindow;

namespace brainshift
{
// The first row's opacities hold for the step as asked for, each further one's for twice as long a
// step as the one before: while moving, steps are doubled.
constexpr int TransferRows = MostStepDoublings + 1;

class TransferTexture
{
public:
  TransferTexture();
  ~TransferTexture();

  // Uploads the maps if they, the unit distance, the step or a mode changed. Opacities are those of
  // a step where samples are blended (composite) or added (additive), else as given. Where colours
  // come from elsewhere (direct), all entries go to the opacity curve.
  // True if they were uploaded.
  bool update(vtkOpenGLRenderWindow* window, vtkVolumeProperty* property, double stepMm,
    Blend blend, Coloring coloring, Counters& counters);

  // Texture coordinate from scalar: scalar * scale + shift. Beyond the ends the end colours hold.
  double scale() const;
  double shift() const;

  // Which values have an opacity above 0, as the shader reads the map; scalar = value * scale +
  // shift.
  VisibleValues visibleValues(double scale, double shift) const;

  // Whether no invisible scalar lies above a visible one; below.
  bool visibleUpwards() const;
  bool visibleDownwards() const;

  // Whether a step somewhere hides nearly all that is behind, so that rays end soon.
  bool isOpaque() const { return this->LargestOpacity >= OpaqueStep; }

  vtkTextureObject* texture() const { return this->Texture; }
  // What Shaders/Tissue/averaged.glsl takes averages from; null unless the map rises to opaque so fast that
  // samples a step apart miss most of the rise.
  vtkTextureObject* sums() const { return this->Sums; }
  void releaseGraphicsResources(vtkWindow* window);

private:
  static constexpr float OpaqueStep = 0.9f;

  void makeSums(
    vtkOpenGLRenderWindow* window, const std::vector<float>& texels, Counters& counters);

  vtkSmartPointer<vtkTextureObject> Texture;
  vtkSmartPointer<vtkTextureObject> Sums;
  unsigned long long ColorTime = 0; // of the maps as uploaded; VTK's times are unique
  unsigned long long OpacityTime = 0;
  double StepMm = 0.0;
  double UnitMm = 0.0;
  Blend Blending = Blend::Composite;
  Coloring ColorSource = Coloring::Mapped;
  std::vector<int> VisibleBefore; // visible entries with lower indices; one more than entries
  float LargestOpacity = 0.0f;
  double Range[2] = { 0.0, 1.0 }; // scalars of the first and the last texel
};
}

#endif
