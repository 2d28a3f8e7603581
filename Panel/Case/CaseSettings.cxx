// SPDX-License-Identifier: BSD-3-Clause
#include "Panel/Case/CaseSettings.h"

#include "Panel/Parts/StillWheel.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QJsonArray>
#include <QJsonObject>
#include <QLineEdit>
#include <QRegularExpression>
#include <QSignalBlocker>
#include <QStringList>

namespace brainshift
{
namespace
{
constexpr double MostGrowth = 100.0;   // mm
constexpr double MostMinutes = 9999.0; // about a week
constexpr double MostStamp = 1e13;     // ms since 1970, in the year 2286

QString nameOfField(const QString& setting)
{
  return "BrainShiftCase_" + setting;
}

QString textOf(const QJsonValue& value)
{
  QStringList parts;
  for (const QJsonValue label : value.toArray())
  {
    parts.append(QString::number(label.toInt()));
  }
  return value.isArray() ? parts.join(", ")
    : value.isString()   ? value.toString()
    : value.isDouble()   ? QString::number(value.toDouble(), 'g', 10)
                         : QString();
}

void showIn(QWidget* field, const QJsonValue& value)
{
  const QSignalBlocker quiet(field);
  if (auto check = qobject_cast<QCheckBox*>(field))
  {
    check->setChecked(value.toBool());
  }
  else if (auto number = qobject_cast<QDoubleSpinBox*>(field))
  {
    number->setValue(value.toDouble());
  }
  else if (auto choice = qobject_cast<QComboBox*>(field))
  {
    choice->setCurrentIndex(choice->findData(value.toString()));
  }
  else if (auto text = qobject_cast<QLineEdit*>(field))
  {
    text->setText(textOf(value));
  }
}
}

CaseSettings::CaseSettings()
  : Form(new QFormLayout(this))
{
  this->Form->setContentsMargins(0, 0, 0, 0);
  this->addName();
  this->addMinutes();
  this->addTraceTimes();
  this->addLevel();
  this->addLabels("brain_labels", tr("Label of the brain"),
    tr("The label that counts as brain. Empty: all above 0."));
  this->addCheck("holds_outside", tr("Hold tissue outside the brain"),
    tr("Only the brain moves. In the tissue around it displacements fade to nothing."));
  this->addGrowth();
  this->addLabels("tumour_labels", tr("Labels of the tumour"),
    tr("The labels that count as tumour, with commas between. Empty: all above 0."));
  this->addLabels("cavity_labels", tr("Labels of the cavity"),
    tr("The labels that count as cavity, with commas between. Empty: all above 0."));
  this->addCheck("landmarks_judge", tr("Landmarks judge only"),
    tr("The fit does not use the landmarks, so that they judge it."));
}

void CaseSettings::addField(
  const QString& name, const QString& label, const QString& tip, QWidget* field)
{
  field->setObjectName(nameOfField(name));
  field->setAccessibleName(label);
  field->setToolTip(tip);
  keepStill(field);
  this->Fields[name] = field;
  if (qobject_cast<QCheckBox*>(field))
  {
    this->Form->addRow(field);
  }
  else
  {
    this->Form->addRow(label, field);
  }
}

void CaseSettings::addCheck(const QString& name, const QString& label, const QString& tip)
{
  auto field = new QCheckBox(label);
  this->connect(field, &QCheckBox::toggled, this,
    [this, name, label](bool on) { Q_EMIT this->edited(name, on, label); });
  this->addField(name, label, tip, field);
}

void CaseSettings::addLabels(const QString& name, const QString& label, const QString& tip)
{
  auto field = new QLineEdit;
  field->setPlaceholderText(tr("all above 0"));
  this->connect(field, &QLineEdit::editingFinished, this, [this, field, name, label] {
    if (!field->isModified())
    {
      return;
    }
    field->setModified(false);
    static const QRegularExpression between("[\\s,;]+");
    QJsonArray labels;
    for (const QString& part : field->text().split(between, Qt::SkipEmptyParts))
    {
      bool isWhole = false;
      labels.append(part.toInt(&isWhole));
      if (!isWhole)
      {
        Q_EMIT this->refused(tr("%1: \"%2\" is no whole number.").arg(label, part));
        return;
      }
    }
    Q_EMIT this->edited(name, labels, label);
  });
  this->addField(name, label, tip, field);
}

void CaseSettings::addName()
{
  auto field = new QLineEdit;
  field->setPlaceholderText(tr("for example after resection"));
  const QString label = tr("Moment");
  this->connect(field, &QLineEdit::editingFinished, this, [this, field, label] {
    if (field->isModified())
    {
      field->setModified(false);
      Q_EMIT this->edited("moment", field->text().trimmed(), label);
    }
  });
  this->addField("moment", label, tr("What the moment of the surgery is called."), field);
}

void CaseSettings::addMinutes()
{
  auto field = new QDoubleSpinBox;
  field->setRange(-MostMinutes, MostMinutes);
  field->setDecimals(1);
  field->setSuffix(tr(" min"));
  field->setKeyboardTracking(false);
  const QString label = tr("Time");
  this->connect(field, &QDoubleSpinBox::valueChanged, this,
    [this, label](double value) { Q_EMIT this->edited("minutes", value, label); });
  this->addField("minutes", label,
    tr("When the moment was (minutes, on ParaView's clock). Each moment has its own time."), field);
}

void CaseSettings::addTraceTimes()
{
  auto unit = new QComboBox;
  unit->addItem(tr("no, each moment has its own"), "");
  unit->addItem(tr("by time stamps in s"), "s");
  unit->addItem(tr("by time stamps in ms"), "ms");
  unit->addItem(tr("by time stamps in min"), "min");
  const QString ofUnit = tr("Traces of all moments");
  this->connect(unit, &QComboBox::activated, this, [this, unit, ofUnit](int at) {
    Q_EMIT this->edited("traces_by_time", unit->itemData(at).toString(), ofUnit);
  });
  this->addField("traces_by_time", ofUnit,
    tr("Whether the traces are those of all moments. A point belongs to the last moment that began "
       "at or before its time stamp, the point array Time."),
    unit);

  auto start = new QDoubleSpinBox;
  start->setRange(-MostStamp, MostStamp);
  start->setDecimals(3);
  start->setKeyboardTracking(false);
  const QString ofStart = tr("Stamp at minute 0");
  this->connect(start, &QDoubleSpinBox::valueChanged, this,
    [this, ofStart](double value) { Q_EMIT this->edited("trace_start", value, ofStart); });
  this->addField("trace_start", ofStart,
    tr("The time stamp that the traces have at minute 0 of ParaView's clock, in their unit."),
    start);
}

void CaseSettings::addLevel()
{
  auto field = new QLineEdit;
  const QString label = tr("Surface level");
  this->connect(field, &QLineEdit::editingFinished, this, [this, field, label] {
    if (!field->isModified())
    {
      return;
    }
    field->setModified(false);
    const QString text = field->text().trimmed();
    bool isNumber = false;
    const double level = text.toDouble(&isNumber);
    if (!isNumber && !text.isEmpty())
    {
      Q_EMIT this->refused(tr("%1: \"%2\" is no number.").arg(label, text));
      return;
    }
    Q_EMIT this->edited("surface_level", text.isEmpty() ? QJsonValue() : QJsonValue(level), label);
  });
  this->addField("surface_level", label,
    tr("Scalar of the volume at the cortex. It is needed only where there is no brain."), field);
}

void CaseSettings::addGrowth()
{
  auto field = new QDoubleSpinBox;
  field->setRange(-1.0, MostGrowth);
  field->setDecimals(1);
  field->setSuffix(tr(" mm"));
  field->setSpecialValueText(tr("as needed"));
  field->setKeyboardTracking(false);
  const QString label = tr("Brain grows by");
  this->connect(field, &QDoubleSpinBox::valueChanged, this, [this, label](double value) {
    Q_EMIT this->edited("mask_growth", value < 0.0 ? -1.0 : value, label);
  });
  this->addField("mask_growth", label,
    tr("Distance (mm) by which the brain grows before displacements fade. \"As needed\" lets "
       "all of the brain move."),
    field);
}

void CaseSettings::show(const QJsonObject& told)
{
  bool any = false;
  for (auto field = this->Fields.cbegin(); field != this->Fields.cend(); ++field)
  {
    const QJsonObject setting = told[field.key()].toObject();
    const bool shown = setting["shown"].toBool();
    this->Form->setRowVisible(field.value(), shown);
    any = any || shown;
    const auto text = qobject_cast<QLineEdit*>(field.value());
    if (!text || !text->isModified()) // else the user is typing
    {
      showIn(field.value(), setting["value"]);
    }
  }
  this->setVisible(any);
}
}
