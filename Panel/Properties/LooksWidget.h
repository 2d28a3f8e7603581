// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// One button with a small picture for each look of a volume: Skin, Brain, Bone and others. A click
/// sets colours, opacities and drawn segments, as one step to undo. The window remembers the last
/// choice for volumes of this kind. It is for a property with panel_widget "BrainShiftLooks".
#ifndef BrainShift_LooksWidget_h
#define BrainShift_LooksWidget_h

#include <pqPropertyWidget.h>

#include <vtkNew.h>

#include <QString>
#include <QStringList>

class pqDataRepresentation;
class QLabel;
class vtkEventQtSlotConnect;

namespace brainshift
{
class LooksWidget : public pqPropertyWidget
{
  Q_OBJECT

public:
  LooksWidget(vtkSMProxy* proxy, vtkSMProperty* property, QWidget* parent = nullptr);
  ~LooksWidget() override;

private Q_SLOTS:
  void offerLooksSoon();

private:
  void offerLooks();
  QString volume() const;
  void addButton(const QString& name);
  void choose(const QString& name);
  pqDataRepresentation* display() const;

  QLabel* Without; ///< says that there is no look
  QString Read;    ///< the volume that the looks were offered for
  QStringList Offered;
  vtkNew<vtkEventQtSlotConnect> Observers;
};
}

#endif
