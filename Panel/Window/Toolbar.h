// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The toolbar: the tools, Reset All Strokes, Before/After, Flicker and Live Pointer. They act on
/// the active deformation (ActiveDeformation.h), except for Flicker (Flicker.h) and Live Pointer,
/// which opens a dock. A button is disabled while it can do nothing.
#ifndef BrainShift_Toolbar_h
#define BrainShift_Toolbar_h

#include <QList>
#include <QPointer>
#include <QTimer>
#include <QToolBar>

namespace brainshift
{
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
  void addLooks();
  void addPointer();
  void addCase();
  void followPipeline();
  void follow(StrokeEditor* editor);
  void refresh();

  QList<QAction*> Tools; ///< In the order of toolTable().
  QAction* Reset = nullptr;
  QAction* Compare = nullptr;
  QAction* Flickering = nullptr;
  QPointer<StrokeEditor> Editor; ///< Of the active deformation.
  QTimer RefreshSoon;            ///< Merges the many signals of a pipeline that changes.
};
}

#endif
