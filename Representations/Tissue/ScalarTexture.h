// SPDX-License-Identifier: BSD-3-Clause
// The volume's scalars on the GPU, and how a stored value relates to the scalar.
#ifndef BrainShift_ScalarTexture_h
#define BrainShift_ScalarTexture_h

#include "Representations/Gpu/Counters.h"
#include "Representations/Skipping/RestPresence.h"

#include "vtkSmartPointer.h"
#include "vtkWeakPointer.h"

#include <glm/vec3.hpp>

#include <string>

class vtkDataArray;
class vtkOpenGLRenderWindow;
class vtkTextureObject;
class vtkWindow;

namespace brainshift
{
class ScalarTexture
{
public:
  ScalarTexture();
  ~ScalarTexture();

  // Uploads the array if it changed since the last call. `component`: which one, or -1 for the
  // length of the vector. On failure returns false and says why in `error`.
  bool update(vtkOpenGLRenderWindow* window, vtkDataArray* scalars, const glm::ivec3& dimensions,
    int component, Counters& counters, std::string& error);

  // Bytes that a value takes on the GPU of the current context.
  static int bytesOf(vtkDataArray* scalars, int component);

  // Ranges of the stored values, as the shader reads them, in bricks of the volume.
  const BrickRanges& ranges() const { return this->Ranges; }
  // Greatest minus least stored value.
  float range() const { return this->Range; }
  // usualDifference of the stored values.
  float difference() const { return this->Difference; }
  // scalar = stored * scale + shift
  double scale() const { return this->Scale; }
  double shift() const { return this->Shift; }

  vtkTextureObject* texture() const { return this->Texture; }
  void releaseGraphicsResources(vtkWindow* window);

private:
  bool upload(vtkOpenGLRenderWindow* window, vtkDataArray* scalars, const glm::ivec3& dimensions,
    int component, Counters& counters);
  bool uploadFloats(
    vtkDataArray* scalars, const glm::ivec3& dimensions, int component, Counters& counters);
  bool uploadSixteenBits(
    vtkDataArray* scalars, const glm::ivec3& dimensions, int component, Counters& counters);
  template <typename Stored>
  bool create(Stored* stored, int type, float shaderFromStored, const glm::ivec3& dimensions,
    Counters& counters);

  vtkSmartPointer<vtkTextureObject> Texture;
  vtkWeakPointer<vtkDataArray> Uploaded;
  unsigned long long UploadedTime = 0;
  int UploadedComponent = 0;
  BrickRanges Ranges;
  float Range = 0.0f;
  float Difference = 0.0f;
  double Scale = 1.0;
  double Shift = 0.0;
};
}

#endif
