// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Knows whether the active view shows a volume that is too large to be drawn with all its voxels,
/// and draws it from an OME-Zarr image then. It calls brainshift.draw_from_pyramid.
#ifndef BrainShift_DrawAllVoxels_h
#define BrainShift_DrawAllVoxels_h

#include <QObject>
#include <QPointer>
#include <QTimer>

class pqPipelineSource;

namespace brainshift
{
class DrawAllVoxels : public QObject
{
  Q_OBJECT

public:
  explicit DrawAllVoxels(QObject* parent);

  /// Whether there is such a volume.
  bool isOffered() const { return !this->Coarser.isNull(); }

  /// Asks the user for a folder, writes the image there and draws from it. One step to undo.
  void begin();

Q_SIGNALS:
  void changed();                    ///< isOffered may be another.
  void failed(const QString& words); ///< Nothing was changed: a sentence, with its full stop.

private:
  void askSoon();
  void ask();
  void offer(pqPipelineSource* coarser);

  QTimer Soon; // merges pictures into one question
  QPointer<pqPipelineSource> Coarser;
};
}

#endif
