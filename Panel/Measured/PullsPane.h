// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The list of pulls and pins of a Free-Form Deformation, with its heading and buttons. It is
/// hidden while there is no fit. Each edit is one undo step and acts at once.
#ifndef BrainShift_PullsPane_h
#define BrainShift_PullsPane_h

#include "Interaction/Edits/FormerWeights.h"
#include "Panel/Parts/List.h"

#include <QPointer>
#include <QTimer>
#include <QWidget>

#include <memory>

class QToolButton;
class pqPipelineSource;

namespace brainshift
{
// The pulls and then the pins of a Fit Deformation as rows of a table. They are solved together,
// so their order means nothing.

/// The pulls and pins of a fit.
struct Pulled
{
  std::vector<Pull> pulls;
  std::vector<Pin> pins;
};

class PullModel : public ListModel
{
  Q_OBJECT

public:
  enum Column
  {
    KindColumn,   ///< Number and kind, with the check box that switches it on.
    AskedColumn,  ///< mm, editable: the requested displacement of a pull.
    MissedColumn, ///< mm: how far from there the fit leaves it.
    WeightColumn, ///< Editable: how far a pull is trusted.
    WhereColumn,  ///< mm: the tissue at rest.
    ColumnCount,
  };

  /// Replaces all of it. The text names the edit on the undo stack.
  using Write = std::function<void(const Pulled&, const QString&)>;

  /// `weights`: those of rows that are switched off.
  PullModel(Write write, std::shared_ptr<FormerWeights> weights, QObject* parent = nullptr);

  /// Shows what the fit has now.
  void show(const Pulled& pulled);
  /// Where the fit takes the tissue of each row (mm); empty: not known. `held`: where each pin
  /// should hold its tissue (mm); empty: where it was at rest.
  void setPlaces(const std::vector<glm::dvec3>& places, const std::vector<glm::dvec3>& held = {});

  const Pulled& pulled() const { return this->Now; }

  bool isOn(int row) const override;
  /// A pull that is switched on again has its former weight, or 1 if that is not known.
  void setOn(const QList<int>& rows, bool on) override;
  void removeRowsOf(const QList<int>& rows) override;
  /// Deletes all rows: one edit.
  void removeAll();

protected:
  int count() const override;
  QString text(int row, int column) const override;
  QString toolTip(int row, int column) const override;
  std::optional<Number> number(int row, int column) const override;
  void change(int row, int column, double number) override;

private:
  bool isPull(int row) const { return row < static_cast<int>(this->Now.pulls.size()); }
  const Pull& pull(int row) const { return this->Now.pulls[static_cast<std::size_t>(row)]; }
  const Pin& pin(int row) const;
  glm::dvec3 target(int row) const;

  const Write WritePulled;
  const std::shared_ptr<FormerWeights> Weights;
  Pulled Now;
  std::vector<glm::dvec3> Places;
  std::vector<glm::dvec3> Held; // of the pins
};

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
