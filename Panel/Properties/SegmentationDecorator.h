// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Disables a property of a representation while its input has no segmentation.
#ifndef BrainShift_SegmentationDecorator_h
#define BrainShift_SegmentationDecorator_h

#include <pqPropertyWidgetDecorator.h>

namespace brainshift
{
class SegmentationDecorator : public pqPropertyWidgetDecorator
{
  Q_OBJECT

public:
  SegmentationDecorator(vtkPVXMLElement* xml, pqPropertyWidget* parent);

  bool enableWidget() const override;
};
}

#endif
