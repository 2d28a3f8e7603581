// SPDX-License-Identifier: BSD-3-Clause
#include "Interaction/Landmarks/LandmarkList.h"

#include "Filters/Fit/PackedTables.h"
#include "Interaction/Commands/Application.h"
#include "Interaction/Edits/FitEditor.h"
#include "Interaction/Edits/StrokeEditor.h"
#include "Interaction/Views/ActiveDeformation.h"
#include "Interaction/Views/Reports.h"
#include "Interaction/Workarounds/Sessions.h"

#include <pqPipelineSource.h>

#include <vtkSMPropertyHelper.h>
#include <vtkSMSourceProxy.h>

#include <QScopedValueRollback>

namespace brainshift
{
namespace
{
constexpr std::size_t NumbersPerLandmark = 10; // of LandmarkPlaces: rest, measured, fitted, weight
constexpr int FewestToJudge = 3;               // of two pairs, both are wrong alike

glm::dvec3 tripleAt(const std::vector<double>& numbers, std::size_t first)
{
  return { numbers[first], numbers[first + 1], numbers[first + 2] };
}

std::vector<std::string> textsOf(vtkSMProxy* proxy, const char* property)
{
  const vtkSMPropertyHelper helper(proxy, property);
  std::vector<std::string> texts(helper.GetNumberOfElements());
  for (unsigned int i = 0; i < texts.size(); ++i)
  {
    texts[i] = helper.GetAsString(i);
  }
  return texts;
}

void setTexts(vtkSMProxy* proxy, const char* property, const std::vector<std::string>& texts)
{
  vtkSMPropertyHelper helper(proxy, property);
  helper.SetNumberOfElements(static_cast<unsigned int>(texts.size()));
  for (unsigned int i = 0; i < texts.size(); ++i)
  {
    helper.Set(i, texts[i].c_str());
  }
}
}

LandmarkList* LandmarkList::of(pqPipelineSource* deformation)
{
  if (!isDeformation(deformation))
  {
    return nullptr;
  }
  auto list = deformation->findChild<LandmarkList*>(QString(), Qt::FindDirectChildrenOnly);
  return list ? list : new LandmarkList(deformation);
}

LandmarkList::LandmarkList(pqPipelineSource* source)
  : QObject(source)
  , Source(source)
  , Editor(FitEditor::of(source))
{
  this->Soon.setSingleShot(true);
  this->Soon.setInterval(0);
  this->connect(&this->Soon, &QTimer::timeout, this, &LandmarkList::refresh);
  this->connect(this->Editor, &FitEditor::changed, this, [this] { this->refreshSoon(true); });
  this->connect(this->Editor, &FitEditor::drawn, this, [this] {
    if (!this->Rows.empty())
    {
      this->refreshSoon(false);
    }
  });
  this->connect(StrokeEditor::of(source), &StrokeEditor::drawn, this, [this] {
    if (!this->Rows.empty())
    {
      this->refreshSoon(false);
    }
  });
  this->connect(serverManagerModel(), &pqServerManagerModel::dataUpdated, this,
    [this](pqPipelineSource* updated) {
      if (updated == this->Source || updated->getProxy() == this->Editor->fit())
      {
        this->refreshSoon(false);
      }
    });
  this->refreshSoon(true);
}

bool LandmarkList::isOpen() const
{
  return this->Source->modifiedState() != pqProxy::UNINITIALIZED;
}

void LandmarkList::showMarks(bool on)
{
  if (on != this->ShowMarks)
  {
    this->ShowMarks = on;
    Q_EMIT this->changed();
  }
}

void LandmarkList::refreshSoon(bool runs)
{
  if (!this->Refreshing)
  {
    this->Runs = this->Runs || runs;
    this->Soon.start();
  }
}

void LandmarkList::refresh()
{
  const QScopedValueRollback<bool> refreshing(this->Refreshing, true);
  this->Rows.clear();
  this->Figures = {};
  this->Problem.clear();
  this->Warning.clear();
  const vtkSmartPointer<vtkSMSourceProxy> fit = this->Editor->fit();
  const bool isApplied = this->Source->modifiedState() != pqProxy::UNINITIALIZED;
  if (fit && isApplied)
  {
    if (this->Runs && !this->Editor->isEditing())
    {
      fit->UpdatePipeline(); // a hidden volume does not update it
    }
    pull(fit);
    this->readInputs(fit);
    this->readPicked(fit);
    this->readFigures(fit);
    this->findDrawn();
  }
  this->Runs = false;
  Q_EMIT this->changed();
}

// The rows that the fit reports, in its order.
void LandmarkList::readInputs(vtkSMProxy* fit)
{
  const std::vector<std::string> names = textsOf(fit, "LandmarkNames");
  const std::vector<double> positions = vtkSMPropertyHelper(fit, "LandmarkPlaces").GetDoubleArray();
  const std::vector<double> residuals =
    vtkSMPropertyHelper(fit, "LandmarkResiduals").GetDoubleArray();
  const std::vector<double> leftOut = vtkSMPropertyHelper(fit, "LeaveOneOut").GetDoubleArray();
  this->Problem = QString::fromUtf8(vtkSMPropertyHelper(fit, "Problem").GetAsString());
  this->Warning = QString::fromUtf8(vtkSMPropertyHelper(fit, "Warning").GetAsString());
  if (positions.size() != NumbersPerLandmark * names.size() || residuals.size() != names.size() ||
    leftOut.size() != names.size())
  {
    return; // it failed, or has not run
  }
  for (std::size_t i = 0; i < names.size(); ++i)
  {
    LandmarkRow row;
    row.name = QString::fromStdString(names[i]);
    row.rest = tripleAt(positions, NumbersPerLandmark * i);
    row.measured = tripleAt(positions, NumbersPerLandmark * i + 3);
    row.fitted = tripleAt(positions, NumbersPerLandmark * i + 6);
    row.on = positions[NumbersPerLandmark * i + 9] > 0.0;
    row.residual = residuals[i];
    row.leftOut = leftOut[i];
    this->Rows.push_back(row);
  }
}

// The last rows are the pairs that were picked. Without a result they are all that is known.
void LandmarkList::readPicked(vtkSMProxy* fit)
{
  const std::vector<PointPair> pairs =
    rowsFrom<PointPair>(vtkSMPropertyHelper(fit, "LandmarkPairs").GetDoubleArray());
  const std::size_t count = pairs.size();
  if (this->Rows.size() < count)
  {
    this->Rows.assign(count, {});
  }
  for (std::size_t i = 0; i < count; ++i)
  {
    LandmarkRow& row = this->Rows[this->Rows.size() - count + i];
    row.name.clear();
    row.picked = static_cast<int>(i);
    row.rest = pairs[i].rest;
    row.measured = pairs[i].measured;
    row.on = pairs[i].weight > 0.0;
  }
}

void LandmarkList::readFigures(vtkSMProxy* fit)
{
  double sum = 0.0;
  int count = 0;
  glm::dvec3 middle(0.0);
  int counting = 0;
  for (std::size_t i = 0; i < this->Rows.size(); ++i)
  {
    const LandmarkRow& row = this->Rows[i];
    if (!row.on)
    {
      continue;
    }
    middle += row.rest;
    ++counting;
    if (std::isfinite(row.leftOut))
    {
      sum += row.leftOut;
      ++count;
      const int worst = this->Figures.worst;
      this->Figures.worst =
        worst < 0 || row.leftOut > this->Rows[worst].leftOut ? static_cast<int>(i) : worst;
    }
  }
  this->Figures.worst = count < FewestToJudge ? -1 : this->Figures.worst;
  this->Figures.meanLeftOut = count ? sum / count : LandmarkRow::Unknown;
  this->Figures.applied = vtkSMPropertyHelper(fit, "Share").GetAsDouble();
  const std::vector<double> rigid = vtkSMPropertyHelper(fit, "Rigid").GetDoubleArray();
  if (rigid.size() == 16 && counting > 0)
  {
    middle /= counting;
    const glm::dvec3 rows[3] = { tripleAt(rigid, 0), tripleAt(rigid, 4), tripleAt(rigid, 8) };
    glm::dvec3 moved(0.0);
    for (int axis = 0; axis < 3; ++axis)
    {
      moved[axis] = glm::dot(rows[axis], middle) + rigid[4 * axis + 3];
    }
    this->Figures.shift = glm::distance(moved, middle);
    const double cosine = (rows[0].x + rows[1].y + rows[2].z - 1.0) / 2.0;
    this->Figures.rotationDegrees = glm::degrees(std::acos(std::clamp(cosine, -1.0, 1.0)));
  }
}

void LandmarkList::findDrawn()
{
  std::vector<double> positions;
  for (const LandmarkRow& row : this->Rows)
  {
    positions.insert(positions.end(), { row.rest.x, row.rest.y, row.rest.z });
  }
  if (positions.empty())
  {
    return;
  }
  if (!this->Report)
  {
    this->Report = makeReport(this->Source->getProxy(), "LatticeReport");
    pointAt(this->Report, "Filter", this->Source->getProxy());
    vtkSMPropertyHelper(this->Report, "ToRest").Set(0);
  }
  setNumbers(this->Report, "Places", positions);
  const std::vector<double> drawn = answerOf(this->Report, "SameTissue");
  for (std::size_t i = 0; 3 * i + 2 < drawn.size() && i < this->Rows.size(); ++i)
  {
    this->Rows[i].drawn = tripleAt(drawn, 3 * i);
  }
}

std::vector<PointPair> LandmarkList::picked() const
{
  return rowsFrom<PointPair>(this->Editor->numbers("LandmarkPairs"));
}

void LandmarkList::add(const glm::dvec3& rest, const glm::dvec3& measured)
{
  this->Editor->claim();
  std::vector<PointPair> pairs = this->picked();
  pairs.push_back({ rest, measured, 1.0 });
  this->Editor->replace("LandmarkPairs", numbersFrom(pairs), tr("Add Landmark Pair"));
}

void LandmarkList::setOn(const QList<int>& rows, bool on)
{
  if (!this->Editor->fit())
  {
    return; // gone since the rows were read
  }
  std::vector<PointPair> pairs = this->picked();
  std::vector<std::string> off = textsOf(this->Editor->fit(), "LandmarksOff");
  for (const int i : rows)
  {
    const LandmarkRow& row = this->Rows.at(i);
    const std::string name = row.name.toStdString();
    if (row.isPicked() && row.on != on && row.picked < static_cast<int>(pairs.size()))
    {
      this->Editor->formerWeights()->setOn(pairs[row.picked], on);
    }
    else if (!row.isPicked())
    {
      off.erase(std::remove(off.begin(), off.end(), name), off.end());
      if (!on)
      {
        off.push_back(name);
      }
    }
  }
  this->Editor->edit(on ? tr("Enable Landmarks") : tr("Disable Landmarks"), [&](vtkSMProxy* fit) {
    setNumbers(fit, "LandmarkPairs", numbersFrom(pairs));
    setTexts(fit, "LandmarksOff", off);
  });
}

void LandmarkList::remove(const QList<int>& rows)
{
  const std::vector<PointPair> before = this->picked();
  std::vector<PointPair> left;
  for (std::size_t i = 0; i < before.size(); ++i)
  {
    const bool goes = std::any_of(rows.begin(), rows.end(),
      [&](int row) { return this->Rows.at(row).picked == static_cast<int>(i); });
    if (!goes)
    {
      left.push_back(before[i]);
    }
  }
  this->Editor->replace("LandmarkPairs", numbersFrom(left), tr("Delete Landmark Pairs"));
}
}
