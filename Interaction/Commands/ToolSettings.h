// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The tool in hand and the settings of all tools. The application has one such object; panel,
/// toolbar and views use it together. The numbers are kept for the next session. The tool is not.
#ifndef BrainShift_ToolSettings_h
#define BrainShift_ToolSettings_h

#include "Filters/Deformation/Stroke.h"

#include <QObject>
#include <QString>

namespace brainshift
{
class ToolSettings : public QObject
{
  Q_OBJECT
  Q_PROPERTY(brainshift::Tool tool READ tool WRITE setTool NOTIFY changed)
  Q_PROPERTY(AxisHold axisHold READ axisHold WRITE setAxisHold NOTIFY changed)
  Q_PROPERTY(double radius READ radius WRITE setRadius NOTIFY changed)
  Q_PROPERTY(double majorRadius READ majorRadius WRITE setMajorRadius NOTIFY changed)
  Q_PROPERTY(double minorRadius READ minorRadius WRITE setMinorRadius NOTIFY changed)
  Q_PROPERTY(double sigma READ sigma WRITE setSigma NOTIFY changed)
  Q_PROPERTY(
    double millimetresPerClick READ millimetresPerClick WRITE setMillimetresPerClick NOTIFY changed)

public:
  /// The world axis that a drag is held to.
  enum class AxisHold
  {
    None,
    X,
    Y,
    Z,
  };
  Q_ENUM(AxisHold)

  /// What the view under the cursor shows of the deformation.
  enum class Ground
  {
    Volume,     ///< A volume, or nothing.
    Slices,     ///< Slices in a 3D view.
    FlatSlices, ///< Slices that face a 2D view.
  };
  Q_ENUM(Ground)

  /// Limits of a number.
  struct Range
  {
    double least;
    double most;
  };

  static ToolSettings* instance();

  Tool tool() const { return this->ToolInHand; }       ///< Default None.
  AxisHold axisHold() const { return this->HeldAxis; } ///< Default None.
  Ground ground() const { return this->GroundNow; }    ///< Default Volume.
  /// Name of the volume that the view under the cursor shows, while the tool in hand works on
  /// another one that this view does not show. Default empty: it works on what the view shows.
  const QString& shownInstead() const { return this->ShownInstead; }
  /// The next thing that the user should do, a whole sentence. Default empty: nothing.
  const QString& request() const { return this->Request; }
  double radius() const;              ///< Soft: mm, default 25.
  double majorRadius() const;         ///< Stamp: half the long axis, mm, default 40.
  double minorRadius() const;         ///< Stamp: across the long axis, mm, default 25.
  double sigma() const;               ///< Width of the Gaussian / radius, default 0.5.
  double millimetresPerClick() const; ///< Stamp: mm per click of the wheel, default 1.

  /// Sensible values of all three radii for the current volume (mm). A radius that was kept outside
  /// counts as the nearest limit.
  Range radiusRange() const;
  /// 0.05 to 2.
  Range sigmaRange() const;
  /// Sensible values for the current volume (mm).
  Range millimetresPerClickRange() const;

  /// Adapts the ranges to a volume: the diagonal of its box and the largest spacing of its control
  /// points (mm, both above 0).
  void suggestRanges(double diagonal, double spacing);

public Q_SLOTS:
  /// Slots clamp numbers to their range.
  void setTool(brainshift::Tool tool);
  void setAxisHold(ToolSettings::AxisHold axis);
  void setGround(ToolSettings::Ground ground);
  void setShownInstead(const QString& name);
  void setRequest(const QString& request);
  void setRadius(double millimetres);
  void setMajorRadius(double millimetres);
  void setMinorRadius(double millimetres);
  void setSigma(double fraction);
  void setMillimetresPerClick(double millimetres);

Q_SIGNALS:
  void changed();
  /// The user wants the tool to work on the volume of shownInstead().
  void switchWanted();

private:
  ToolSettings();

  void keep(const char* name, double& kept, double value, const Range& range);

  Tool ToolInHand = Tool::None;
  AxisHold HeldAxis = AxisHold::None;
  Ground GroundNow = Ground::Volume;
  QString ShownInstead;
  QString Request;
  double Radius = 25.0;
  double MajorRadius = 40.0;
  double MinorRadius = 25.0;
  double Sigma = 0.5;
  double PerClick = 1.0;
  double Diagonal = 350.0; ///< mm; of a head.
  double Spacing = 12.0;   ///< mm; of 19 control points along a head.
};
}

#endif
