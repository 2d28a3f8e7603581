// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The entry of the Tools menu that saves pictures and numbers of the active deformation into a
/// folder. It calls brainshift.figure.
#ifndef BrainShift_FigureActions_h
#define BrainShift_FigureActions_h

#include <QActionGroup>

namespace brainshift
{
class FigureActions : public QActionGroup
{
  Q_OBJECT

public:
  explicit FigureActions(QObject* parent);

private:
  void save();
};
}

#endif
