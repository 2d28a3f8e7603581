// SPDX-License-Identifier: BSD-3-Clause
// What the mouse does in the view and how widely: one for the application, shared by panel, toolbar
// and view. Values are kept for the next session; the tool is not.
#ifndef BrainShift_ToolSettings_h
#define BrainShift_ToolSettings_h

#include <QObject>

class ToolSettings : public QObject
{
  Q_OBJECT
  Q_PROPERTY(Tool tool READ tool WRITE setTool NOTIFY changed)
  Q_PROPERTY(AxisHold axisHold READ axisHold WRITE setAxisHold NOTIFY changed)
  Q_PROPERTY(double radius READ radius WRITE setRadius NOTIFY changed)
  Q_PROPERTY(double majorRadius READ majorRadius WRITE setMajorRadius NOTIFY changed)
  Q_PROPERTY(double minorRadius READ minorRadius WRITE setMinorRadius NOTIFY changed)
  Q_PROPERTY(double sigma READ sigma WRITE setSigma NOTIFY changed)
  Q_PROPERTY(
    double millimetresPerClick READ millimetresPerClick WRITE setMillimetresPerClick NOTIFY changed)

public:
  enum class Tool
  {
    None, // the mouse moves the camera, as ever
    Move,
    Soft,
    Stamp,
  };
  Q_ENUM(Tool)

  // World axis that a drag is held to.
  enum class AxisHold
  {
    None,
    X,
    Y,
    Z,
  };
  Q_ENUM(AxisHold)

  // What the view under the cursor shows of the deformation.
  enum class Ground
  {
    Volume,     // or nothing
    Slices,     // in 3D
    FlatSlices, // slices that face a 2D view
  };
  Q_ENUM(Ground)

  struct Range
  {
    double least;
    double most;
  };

  static ToolSettings* instance();

  Tool tool() const { return this->ToolInHand; }       // default None
  AxisHold axisHold() const { return this->HeldAxis; } // default None
  Ground ground() const { return this->GroundNow; }    // default Volume
  double radius() const;                               // Soft: mm, default 25
  double majorRadius() const;                          // Stamp: half the long axis, mm, default 40
  double minorRadius() const;                          // Stamp: radius across, mm, default 25
  double sigma() const;               // width of the Gaussian, share of the radius, default 0.5
  double millimetresPerClick() const; // Stamp: of the wheel, mm, default 1

  // Sensible values for the volume in hand; what is kept outside them counts as the nearest limit.
  Range radiusRange() const; // of all three radii
  Range sigmaRange() const;  // 0.05 to 2
  Range millimetresPerClickRange() const;

  // `diagonal`: of the volume's box, mm; `spacing`: the widest between two control points, mm.
  // Both above 0.
  void suggestRanges(double diagonal, double spacing);

public Q_SLOTS:
  // Numbers are clamped into their range.
  void setTool(ToolSettings::Tool tool);
  void setAxisHold(ToolSettings::AxisHold axis);
  void setGround(ToolSettings::Ground ground);
  void setRadius(double millimetres);
  void setMajorRadius(double millimetres);
  void setMinorRadius(double millimetres);
  void setSigma(double share);
  void setMillimetresPerClick(double millimetres);

Q_SIGNALS:
  void changed();

private:
  ToolSettings();

  void keep(const char* name, double& kept, double value, const Range& range);

  Tool ToolInHand = Tool::None;
  AxisHold HeldAxis = AxisHold::None;
  Ground GroundNow = Ground::Volume;
  double Radius = 25.0;
  double MajorRadius = 40.0;
  double MinorRadius = 25.0;
  double Sigma = 0.5;
  double PerClick = 1.0;
  double Diagonal = 350.0; // mm, of a head
  double Spacing = 12.0;   // mm, of 19 control points over it
};

#endif
