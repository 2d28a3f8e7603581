// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Adds the unit that the XML gives as `unit` to the label of a property: "Feather (mm)". The XML's
/// label cannot hold it, for Python's name of the property is made of that.
#ifndef BrainShift_UnitDecorator_h
#define BrainShift_UnitDecorator_h

#include <pqPropertyWidgetDecorator.h>

#include <QString>

namespace brainshift
{
class UnitDecorator : public pqPropertyWidgetDecorator
{
  Q_OBJECT

public:
  UnitDecorator(vtkPVXMLElement* xml, pqPropertyWidget* parent);

private:
  void addUnit();

  const QString Unit;
};
}

#endif
