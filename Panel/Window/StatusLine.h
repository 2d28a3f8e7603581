// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The texts of the status bar: mouse gestures, and the tissue under the cursor.
#ifndef BrainShift_StatusLine_h
#define BrainShift_StatusLine_h

#include "Interaction/Views/CursorProbe.h"
#include "Interaction/Views/CursorWatch.h"

#include <QLabel>
#include <QSize>
#include <QWidget>

class QLabel;
class QToolButton;

namespace brainshift
{
class DrawAllVoxels;
class QuietMessages;

// Shows the tissue under the cursor in the status bar, in a view of Deformed Volume or Deformed
// Slices. It is empty where the view shows no tissue.

/// The line for some tissue: position, position before it was bent, intensity, label, distance that
/// it moved, fraction of its volume. Letters for the patient's sides only where they are known.
QString cursorText(const CursorTissue& tissue);

class CursorLine : public QLabel
{
  Q_OBJECT

public:
  CursorLine(QWidget* parent);

  /// A long line must not widen the window.
  QSize minimumSizeHint() const override { return { 0, this->QLabel::minimumSizeHint().height() }; }

private Q_SLOTS:
  void askSoon();

private:
  void follow(pqRenderView* view);
  void ask();
  void fallSilent();

  CursorWatch Cursor;
  CursorProbe Probe;
  QTimer Asking; ///< Merges what happens meanwhile into one question.
  QPointer<pqRenderView> Followed;
  QSize Size;                            ///< Of the view when the cursor moved last, pixels.
  vtkNew<vtkEventQtSlotConnect> Drawing; ///< Hears of each picture in the view.
};

/// Shows the mouse gestures of the view under the cursor in the status bar of the window. If the
/// view shows another volume than the tool works on, a button takes the tool to it. A warning
/// stands beside them for a while, or until its sign is pressed, which opens Output Messages. A
/// button draws all voxels of a volume that is drawn coarser.
class StatusLine : public QWidget
{
  Q_OBJECT

public:
  /// `messages`: where warnings come from.
  StatusLine(QWidget* parent, QuietMessages* messages);

private:
  void refresh();
  void warn(const QString& words);

  QToolButton* Switch;
  QLabel* Line;
  QToolButton* Sign;
  QLabel* Warning;
  QLabel* Coarser;
  QToolButton* DrawAll;
  DrawAllVoxels* Offer;
  QTimer Warned; ///< Takes the warning away.
};
}

#endif
