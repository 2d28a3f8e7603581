// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Draws marks of landmarks over all views that show a Free-Form Deformation or its reference.
/// ParaView's client alone draws them, so nothing of them is in states or on servers.
#ifndef BrainShift_LandmarkMarks_h
#define BrainShift_LandmarkMarks_h

#include <vtkSmartPointer.h>

#include <QHash>
#include <QObject>
#include <QTimer>

class pqPipelineSource;
class pqRenderView;
class pqView;
class vtkLandmarkMarks;

namespace brainshift
{
class LandmarkMarks : public QObject
{
  Q_OBJECT

public:
  /// Watches sources and views from now on.
  explicit LandmarkMarks(QObject* parent);
  ~LandmarkMarks() override;

private:
  void watchSource(pqPipelineSource* source);
  void watchView(pqView* view);
  void mark(pqRenderView* view); ///< Updates the marks of a view. It draws nothing.
  void refresh();                ///< Draws the views in which marks have changed.

  QHash<pqRenderView*, vtkSmartPointer<vtkLandmarkMarks>> Marks;
  QTimer Soon; ///< Merges events that may have changed something.
};
}

#endif
