// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The list of pulls and pins of a Free-Form Deformation, with its heading and buttons. It is
/// hidden while there is no fit. Each edit is one undo step and acts at once.
#ifndef BrainShift_PullsPane_h
#define BrainShift_PullsPane_h

#include <QPointer>
#include <QTimer>
#include <QWidget>

class QToolButton;
class pqPipelineSource;

namespace brainshift
{
class FitEditor;
class ListTree;
class PullModel;

class PullsPane : public QWidget
{
  Q_OBJECT

public:
  PullsPane(pqPipelineSource* deformation, QWidget* parent = nullptr);

private:
  void followPulls();  ///< During a drag, a few times a second.
  void followResult(); ///< After the filter executed.
  void update();
  void refresh();

  const QPointer<FitEditor> Editor; ///< The source may go before its panel does.
  PullModel* const Pulls;
  ListTree* const Tree;
  QToolButton* const Delete;
  QToolButton* const Clear;
  QTimer Soon;
};
}

#endif
