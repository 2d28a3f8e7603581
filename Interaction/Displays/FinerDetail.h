// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Draws views again while finer voxels of their volumes arrive, and shows in the status bar which
/// level is drawn and what is still to come.
#ifndef BrainShift_FinerDetail_h
#define BrainShift_FinerDetail_h

#include <QElapsedTimer>
#include <QObject>
#include <QTimer>

#include <map>
#include <vector>

class pqDataRepresentation;
class pqView;

namespace brainshift
{
/// The numbers of the report's Detail, in its order: vtkDeformedVolumeReport.h explains them.
enum DetailNumber : std::size_t
{
  Level,
  Drawn,
  ToCome,
  IsOverfull,
  IsReading,
  HasUnshown,
  NeedsPyramid,
  DetailNumbers
};

/// Asks for these numbers of a display that is drawn as Deformed Volume or Deformed Slices. Zeros
/// if there is no answer.
std::vector<double> detailNumbersOf(pqDataRepresentation* display);

class FinerDetail : public QObject
{
  Q_OBJECT

public:
  explicit FinerDetail(QObject* parent);

private:
  void watch();
  void drawOn();

  QTimer Next;
  std::map<pqView*, QElapsedTimer> SinceDrawn; // views for which bricks come, or since they began
};
}

#endif
