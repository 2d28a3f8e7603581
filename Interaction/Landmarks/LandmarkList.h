// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The pairs of landmarks of a Free-Form Deformation, with the results of the fit for each. First
/// come those of the inputs of the Fit Deformation, then those that were picked in the window.
/// Positions and lengths: mm.
#ifndef BrainShift_LandmarkList_h
#define BrainShift_LandmarkList_h

#include <vtkSmartPointer.h>

#include <QList>
#include <QObject>
#include <QString>
#include <QTimer>

#include <glm/glm.hpp>

#include <limits>
#include <vector>

class pqPipelineSource;
class vtkSMProxy;
class vtkSMSourceProxy;

namespace brainshift
{
class FitEditor;
struct PointPair;

/// A pair. Numbers that are not known are NaN.
struct LandmarkRow
{
  static constexpr double Unknown = std::numeric_limits<double>::quiet_NaN();

  QString name;              ///< Of a landmark of the inputs. Empty for a pair that was picked.
  int picked = -1;           ///< Index among the picked pairs. Below 0 for one of the inputs.
  bool on = true;            ///< Whether it counts.
  double residual = Unknown; ///< FRE: distance from its fitted position, mm.
  double leftOut = Unknown;  ///< Leave-one-out error: the same of a fit without it, mm.
  glm::dvec3 rest{ Unknown };
  glm::dvec3 measured{ Unknown };
  glm::dvec3 fitted{ Unknown }; ///< Where the fit puts it, measured frame.
  glm::dvec3 drawn{ Unknown };  ///< Where its tissue is drawn, strokes included.

  bool isPicked() const { return this->picked >= 0; }
};

/// Figures of the fit as a whole.
struct LandmarkFigures
{
  double meanLeftOut =
    LandmarkRow::Unknown;       ///< Mean leave-one-out error of the pairs that count, mm.
  double shift = 0.0;           ///< Of the middle of the landmarks by the rigid motion, mm.
  double rotationDegrees = 0.0; ///< Of the rigid motion.
  double applied = 1.0;         ///< Fraction of the fit that the fold guard allowed, 0 to 1.
  int worst = -1; ///< The row with the largest leftOut. Below 0: fewer than 3 are known.
};

class LandmarkList : public QObject
{
  Q_OBJECT

public:
  /// The list of a Free-Form Deformation; it lives as long as the source. Null for any other
  /// source.
  static LandmarkList* of(pqPipelineSource* deformation);

  const std::vector<LandmarkRow>& rows() const { return this->Rows; }
  const LandmarkFigures& figures() const { return this->Figures; }
  /// Why the fit has no figures. Empty: nothing is wrong.
  const QString& problem() const { return this->Problem; }
  /// What to know about the result of the fit, without the last full stop. Empty if nothing.
  const QString& warning() const { return this->Warning; }
  /// Whether pairs can be added.
  bool isOpen() const;
  pqPipelineSource* source() const { return this->Source; }

  /// Whether views mark the landmarks. Default on.
  bool areMarksShown() const { return this->ShowMarks; }
  void showMarks(bool on);

  /// Adds a pair: one undo step.
  void add(const glm::dvec3& rest, const glm::dvec3& measured);
  /// Lets pairs count, or not: one undo step.
  void setOn(const QList<int>& rows, bool on);
  /// Deletes pairs that were picked: one undo step. Those of the inputs stay.
  void remove(const QList<int>& rows);

Q_SIGNALS:
  /// Rows or figures may have changed.
  void changed();

private:
  explicit LandmarkList(pqPipelineSource* source);

  void refreshSoon(bool runs);
  void refresh();
  void readPicked(vtkSMProxy* fit);
  void readInputs(vtkSMProxy* fit);
  void readFigures(vtkSMProxy* fit);
  void findDrawn();
  std::vector<PointPair> picked() const; ///< Pairs as the fit has them now.

  pqPipelineSource* const Source;
  FitEditor* const Editor;
  vtkSmartPointer<vtkSMProxy> Report; ///< A LatticeReport of the source.
  std::vector<LandmarkRow> Rows;
  LandmarkFigures Figures;
  QString Problem;
  QString Warning;
  QTimer Soon;
  bool Runs = false;       ///< The next refresh lets the fit run first.
  bool Refreshing = false; ///< What changes now, this list caused.
  bool ShowMarks = true;
};
}

#endif
