// SPDX-License-Identifier: BSD-3-Clause
#include "Interaction/Views/OtherVolume.h"

#include "Interaction/Commands/ToolSettings.h"
#include "Interaction/Views/ActiveDeformation.h"

#include <pqActiveObjects.h>
#include <pqPipelineSource.h>
#include <pqRenderView.h>

namespace brainshift
{
namespace
{
constexpr double ClickPixels = 4.0; // a hand that clicks moves less between press and release
}

void OtherVolume::follow(pqPipelineSource* deformation, pqRenderView* view)
{
  this->Deformation = deformation;
  this->View = view;
  this->Pressed.reset();
}

pqPipelineSource* OtherVolume::shown() const
{
  return this->Deformation && this->View ? shownInstead(this->Deformation, this->View) : nullptr;
}

void OtherVolume::report() const
{
  pqPipelineSource* other = this->shown();
  ToolSettings::instance()->setShownInstead(other ? other->getSMName() : QString());
}

void OtherVolume::take() const
{
  if (pqPipelineSource* other = this->shown())
  {
    pqActiveObjects::instance().setActiveSource(other);
  }
}

void OtherVolume::release(const glm::dvec2& pixel)
{
  const bool isClick = this->Pressed && glm::distance(pixel, *this->Pressed) <= ClickPixels;
  this->Pressed.reset();
  if (isClick)
  {
    this->take();
  }
}
}
