// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Lets the panel be narrower than the longest text of a list: the list shows the beginning of the
/// chosen text, its tooltip the whole, and it opens as wide as its texts.
#ifndef BrainShift_ShortListDecorator_h
#define BrainShift_ShortListDecorator_h

#include <pqPropertyWidgetDecorator.h>

namespace brainshift
{
class ShortListDecorator : public pqPropertyWidgetDecorator
{
  Q_OBJECT

public:
  ShortListDecorator(vtkPVXMLElement* xml, pqPropertyWidget* parent);
};
}

#endif
