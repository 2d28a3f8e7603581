// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Edits a list of labels as one line of text: numbers with spaces or commas between them.
#ifndef BrainShift_LabelsWidget_h
#define BrainShift_LabelsWidget_h

#include <pqPropertyWidget.h>

#include <QList>
#include <QVariant>

class QLineEdit;

namespace brainshift
{
class LabelsWidget : public pqPropertyWidget
{
  Q_OBJECT
  Q_PROPERTY(QList<QVariant> labels READ labels WRITE setLabels NOTIFY labelsChanged)

public:
  LabelsWidget(vtkSMProxy* proxy, vtkSMProperty* property, QWidget* parent = nullptr);

  QList<QVariant> labels() const;
  void setLabels(const QList<QVariant>& labels);

Q_SIGNALS:
  void labelsChanged();

private:
  QLineEdit* Line;
};
}

#endif
