// SPDX-License-Identifier: BSD-3-Clause
#include "TransferTexture.h"

#include "OpenGL.h"

#include "vtkColorTransferFunction.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkPiecewiseFunction.h"
#include "vtkTextureObject.h"
#include "vtkVolumeProperty.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace brainshift
{
namespace
{
// As many as a 12-bit CT has values; so many that none need blending, which would cost four reads.
constexpr int Entries = 4096;

// What a sample counts, from the opacity of one unit distance.
float opacityOfSample(float opacity, double unitsInStep, Blend blend)
{
  const double given = std::clamp(static_cast<double>(opacity), 0.0, 1.0);
  switch (blend)
  {
    case Blend::Composite:
      return static_cast<float>(1.0 - std::pow(1.0 - given, unitsInStep));
    case Blend::Additive:
      return static_cast<float>(given * unitsInStep);
    default:
      return static_cast<float>(given);
  }
}
}

TransferTexture::TransferTexture() = default;
TransferTexture::~TransferTexture() = default;

double TransferTexture::scale() const
{
  return (Entries - 1.0) / Entries / (this->Range[1] - this->Range[0]);
}

double TransferTexture::shift() const
{
  return 0.5 / Entries - this->Range[0] * this->scale();
}

bool TransferTexture::update(vtkOpenGLRenderWindow* window, vtkVolumeProperty* property,
  double stepMm, Blend blend, Coloring coloring, Counters& counters)
{
  vtkColorTransferFunction* color = property->GetRGBTransferFunction();
  vtkPiecewiseFunction* opacity = property->GetScalarOpacity();
  const double unitMm = property->GetScalarOpacityUnitDistance();
  if (this->Texture && this->ColorTime == color->GetMTime() &&
    this->OpacityTime == opacity->GetMTime() && this->StepMm == stepMm && this->UnitMm == unitMm &&
    this->Blending == blend && this->ColorSource == coloring)
  {
    return false;
  }
  const double* opacityRange = opacity->GetRange();
  const double* colorRange = coloring == Coloring::Direct ? opacityRange : color->GetRange();
  this->Range[0] = std::min(colorRange[0], opacityRange[0]);
  this->Range[1] = std::max(colorRange[1], opacityRange[1]);
  if (!(this->Range[1] > this->Range[0]))
  {
    this->Range[1] = this->Range[0] + 1.0;
  }
  std::vector<float> colors(3 * Entries);
  std::vector<float> opacities(Entries);
  color->GetTable(this->Range[0], this->Range[1], Entries, colors.data());
  opacity->GetTable(this->Range[0], this->Range[1], Entries, opacities.data());
  std::vector<float> texels(4 * Entries * TransferRows);
  this->VisibleBefore.assign(Entries + 1, 0);
  this->LargestOpacity = 0.0f;
  for (int i = 0; i < Entries; ++i)
  {
    std::copy_n(&colors[3 * i], 3, &texels[4 * i]);
    texels[4 * i + 3] = opacityOfSample(opacities[i], stepMm / unitMm, blend);
    this->LargestOpacity = std::max(this->LargestOpacity, texels[4 * i + 3]);
    this->VisibleBefore[i + 1] = this->VisibleBefore[i] + (texels[4 * i + 3] > 0.0f ? 1 : 0);
  }
  for (std::size_t i = 4 * Entries; i < texels.size(); ++i)
  {
    const float above = texels[i - 4 * Entries];
    texels[i] = i % 4 == 3 ? above * (2.0f - above) : above; // what two such steps hide
  }
  this->Texture = vtkSmartPointer<vtkTextureObject>::New();
  this->Texture->SetContext(window);
  this->Texture->SetMinificationFilter(vtkTextureObject::Nearest);
  this->Texture->SetMagnificationFilter(vtkTextureObject::Nearest);
  this->Texture->SetWrapS(vtkTextureObject::ClampToEdge);
  this->Texture->SetWrapT(vtkTextureObject::ClampToEdge);
  this->Texture->Create2DFromRaw(Entries, TransferRows, 4, VTK_FLOAT, texels.data());
  counters.transferUploads += 1;
  counters.bytesUploaded += static_cast<std::int64_t>(texels.size() * sizeof(float));
  this->ColorTime = color->GetMTime();
  this->OpacityTime = opacity->GetMTime();
  this->StepMm = stepMm;
  this->UnitMm = unitMm;
  this->Blending = blend;
  this->ColorSource = coloring;
  return true;
}

VisibleValues TransferTexture::visibleValues(double scale, double shift) const
{
  VisibleValues visible;
  visible.entries = Entries;
  visible.before = this->VisibleBefore;
  visible.entryFromValue = scale * this->scale() * Entries;
  visible.entryOfValueZero = (shift * this->scale() + this->shift()) * Entries - 0.5;
  return visible;
}

bool TransferTexture::visibleUpwards() const
{
  const int visible = this->VisibleBefore[Entries];
  return this->VisibleBefore[Entries - visible] == 0;
}

bool TransferTexture::visibleDownwards() const
{
  const int visible = this->VisibleBefore[Entries];
  return this->VisibleBefore[visible] == visible;
}

void TransferTexture::releaseGraphicsResources(vtkWindow* window)
{
  if (this->Texture)
  {
    this->Texture->ReleaseGraphicsResources(window);
  }
  this->Texture = nullptr;
}
}
