// SPDX-License-Identifier: BSD-3-Clause
// Greys a property of a representation whose input carries no segmentation to draw from.
#ifndef BrainShift_SegmentationDecorator_h
#define BrainShift_SegmentationDecorator_h

#include <pqPropertyWidgetDecorator.h>

class SegmentationDecorator : public pqPropertyWidgetDecorator
{
  Q_OBJECT

public:
  SegmentationDecorator(vtkPVXMLElement* xml, pqPropertyWidget* parent);

  bool enableWidget() const override;
};

#endif
