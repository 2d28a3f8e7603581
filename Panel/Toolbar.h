// SPDX-License-Identifier: BSD-3-Clause
// Toolbar of the tools, Reset All, the comparison with the volume as loaded and the flicker with a
// reference (Flicker.h). The others act on the active deformation (ActiveDeformation.h). It offers
// only what can be done.
#ifndef BrainShift_Toolbar_h
#define BrainShift_Toolbar_h

#include <QList>
#include <QPointer>
#include <QTimer>
#include <QToolBar>

class StrokeEditor;

class Toolbar : public QToolBar
{
  Q_OBJECT

public:
  Toolbar(QWidget* mainWindow);

private:
  void addTools();
  void addReset();
  void addCompare();
  void addFlicker();
  void followPipeline();
  void follow(StrokeEditor* editor);
  void refresh();

  QList<QAction*> Tools; // in the order of toolChoices()
  QAction* Reset = nullptr;
  QAction* Compare = nullptr;
  QAction* Flickering = nullptr;
  QPointer<StrokeEditor> Editor; // of the active deformation
  QTimer RefreshSoon;            // merges the many signals of a pipeline that changes
};

#endif
