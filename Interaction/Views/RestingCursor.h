// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Says when a cursor that rests has something new under it: after undo, for example.
#ifndef BrainShift_RestingCursor_h
#define BrainShift_RestingCursor_h

#include <QObject>
#include <QPointer>
#include <QTimer>

class pqPipelineSource;
class pqRenderView;

namespace brainshift
{
class RestingCursor : public QObject
{
  Q_OBJECT

public:
  explicit RestingCursor(QObject* parent);

  /// The Free-Form Deformation and the view that matter from now on. Null: none does.
  void follow(pqPipelineSource* deformation, pqRenderView* view);

  void look() { this->Soon.start(); }          ///< Something is new now.
  void lookAtNext() { this->Outdated = true; } ///< The view's next picture shows something new.

Q_SIGNALS:
  /// From the event loop. The view's last picture shows what is new.
  void sees();

private:
  QPointer<pqPipelineSource> Deformation;
  QPointer<pqRenderView> View;
  QTimer Soon;
  bool Outdated = false;
};
}

#endif
