// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Disables a property of a representation while its input carries no field data of the name that
/// the XML gives as `array`, for example no segmentation.
#ifndef BrainShift_AttachedDecorator_h
#define BrainShift_AttachedDecorator_h

#include <pqPropertyWidgetDecorator.h>

#include <string>

namespace brainshift
{
class AttachedDecorator : public pqPropertyWidgetDecorator
{
  Q_OBJECT

public:
  AttachedDecorator(vtkPVXMLElement* xml, pqPropertyWidget* parent);

  bool enableWidget() const override;

private:
  const std::string Array;
};
}

#endif
