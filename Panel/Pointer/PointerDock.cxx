// SPDX-License-Identifier: BSD-3-Clause
#include "Panel/Pointer/PointerDock.h"

#include "Interaction/Commands/Application.h"
#include "Interaction/Commands/Commands.h"
#include "Interaction/Pointer/Pointer.h"
#include "Panel/Parts/Advice.h"
#include "Panel/Pointer/RegistrationTable.h"

#include <pqSettings.h>

#include <QCheckBox>
#include <QDoubleSpinBox>
#include <QFileDialog>
#include <QFormLayout>
#include <QGroupBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QMessageBox>
#include <QPushButton>
#include <QScrollArea>
#include <QSignalBlocker>
#include <QSpinBox>
#include <QStringList>
#include <QVBoxLayout>

#include <cmath>

namespace brainshift
{
// Texts of the dock about the pointer.

class Pointer;

/// The connection in a few words: device, rate (Hz), age of the last pose (s), what was lost; or
/// the reason why it ended, one sentence.
QString connectionText(const Pointer& pointer);
/// Whether connectionText() is a warning that needs action.
bool warnsOf(const Pointer& pointer);
/// The distance of the tip to the deformed cortex (mm) with its side; or why there is none.
QString distanceText(const Pointer& pointer);
/// The position of the tip (mm, world axes).
QString positionText(const Pointer& pointer);

namespace
{

bool isOld(const Pointer& pointer)
{
  return pointer.age().value_or(0.0) > Pointer::OldSeconds;
}

QString sentence(const std::string& problem)
{
  return problem.empty() ? QString() : QString::fromStdString(problem) + ".";
}

// Lost messages by cause; empty if there are none.
QString lossText(const SourceState& state)
{
  QStringList parts;
  if (state.badChecksums > 0)
  {
    parts.append(tr("%1 damaged (checksum)").arg(state.badChecksums));
  }
  if (state.refused > 0)
  {
    parts.append(tr("%1 without a valid pose").arg(state.refused));
  }
  if (state.overrun > 0)
  {
    parts.append(tr("%1 skipped").arg(state.overrun));
  }
  return parts.isEmpty() ? QString() : "\n" + tr("Messages lost: %1").arg(parts.join(", "));
}

QString fullText(const Pointer& pointer)
{
  return pointer.isSessionFull()
    ? "\n" + tr("Save Session keeps the first %1 poses and no further ones.").arg(MostPoses)
    : QString();
}

QString runningText(const Pointer& pointer)
{
  const SourceState& state = pointer.state();
  const auto age = pointer.age();
  if (!age)
  {
    return tr("Connected. No pose has been received yet.");
  }
  const QString device = QString::fromStdString(state.device);
  if (!state.visible)
  {
    return tr("%1 is not visible. Last pose %2 s ago.").arg(device).arg(*age, 0, 'f', 1);
  }
  if (isOld(pointer))
  {
    return tr("No data from %1. Last pose %2 s ago.").arg(device).arg(*age, 0, 'f', 1);
  }
  return tr("%1: %2 Hz, %3 s old").arg(device).arg(state.rate, 0, 'f', 0).arg(*age, 0, 'f', 2);
}
}

QString connectionText(const Pointer& pointer)
{
  const SourceState& state = pointer.state();
  switch (state.phase)
  {
    case SourceState::Phase::Connecting:
      return state.problem.empty() ? tr("Connecting...")
                                   : tr("%1 Trying again.").arg(sentence(state.problem));
    case SourceState::Phase::Running:
      return runningText(pointer) + lossText(state) + fullText(pointer);
    case SourceState::Phase::Ended:
      break;
  }
  return state.problem.empty() ? tr("Not connected") : sentence(state.problem) + lossText(state);
}

bool warnsOf(const Pointer& pointer)
{
  const SourceState& state = pointer.state();
  if (state.phase == SourceState::Phase::Running)
  {
    return pointer.age() && (!state.visible || isOld(pointer));
  }
  return !state.problem.empty() && !pointer.isReplay();
}

QString distanceText(const Pointer& pointer)
{
  if (!pointer.tip() || isOld(pointer))
  {
    return QStringLiteral("\u2013 mm");
  }
  if (!pointer.distance())
  {
    return pointer.distanceProblem().isEmpty() ? tr("no cortex here") : pointer.distanceProblem();
  }
  const double distance = pointer.distance().value_or(0.0);
  return tr(distance < 0.0 ? "%1 mm inside" : "%1 mm outside").arg(std::abs(distance), 0, 'f', 1);
}

QString positionText(const Pointer& pointer)
{
  if (!pointer.tip() || isOld(pointer))
  {
    return {};
  }
  const glm::dvec3 tip = pointer.tip().value_or(glm::dvec3(0.0));
  return tr("Tip at %1 %2 %3 mm").arg(tip.x, 0, 'f', 1).arg(tip.y, 0, 'f', 1).arg(tip.z, 0, 'f', 1);
}

namespace
{
constexpr int ShowEachMs = 100; // faster than one can read
constexpr int LeastWidth = 330; // pixels: two points of the table beside each other
constexpr int DefaultPort = 18944;

// A heading, and the layout under it.
QVBoxLayout* addGroup(QVBoxLayout* layout, const QString& title)
{
  auto group = new QGroupBox(title);
  layout->addWidget(group);
  return new QVBoxLayout(group);
}

QLabel* wrapped(const QString& name)
{
  auto label = new QLabel;
  label->setObjectName(name);
  label->setWordWrap(true);
  label->setTextFormat(Qt::PlainText); // names come from a server
  return label;
}

void paint(QLabel* label, bool warns)
{
  QPalette palette = label->parentWidget()->palette();
  if (warns)
  {
    palette.setColor(QPalette::WindowText, gradeColor(Grade::Bad, palette, false));
  }
  label->setPalette(palette);
}

pqSettings* settings()
{
  return pqApplicationCore::instance()->settings();
}
}

PointerDock::PointerDock(QWidget* parent)
  : QDockWidget(tr("Live Pointer"), parent)
{
  this->setObjectName("BrainShiftPointerDock");
  auto content = new QWidget;
  auto layout = new QVBoxLayout(content);
  this->addConnection(layout);
  this->addTip(layout);
  this->Registration = new RegistrationTable;
  addGroup(layout, tr("Tracker in the image"))->addWidget(this->Registration);
  this->connect(this->Registration, &RegistrationTable::problem, this,
    [this](const QString& problem) { this->report(problem); });
  this->addSession(layout);
  layout->addStretch(1);
  auto scroll = new QScrollArea;
  scroll->setWidgetResizable(true);
  scroll->setFrameShape(QFrame::NoFrame);
  scroll->setWidget(content);
  scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  scroll->setMinimumWidth(LeastWidth);
  this->setWidget(scroll);
  this->Soon.setSingleShot(true);
  this->Soon.setInterval(ShowEachMs);
  this->connect(&this->Soon, &QTimer::timeout, this, &PointerDock::showState);
  this->connect(Pointer::instance(), &Pointer::recordHandled, this, &PointerDock::report);
  this->connect(Pointer::instance(), &Pointer::changed, this, [this] {
    if (!this->Soon.isActive())
    {
      this->Soon.start();
    }
  });
  this->connect(this, &QDockWidget::visibilityChanged, this, &PointerDock::showState);
  // ParaView shows each dock that it is given; without a pointer it would only take room.
  QTimer::singleShot(0, this, &QWidget::hide);
  this->showState();
}

void PointerDock::addLine(
  QFormLayout* form, const QString& name, QWidget* field, const QString& tip)
{
  field->setToolTip(tip);
  form->addRow(name, field);
}

void PointerDock::addConnection(QVBoxLayout* layout)
{
  QVBoxLayout* group = addGroup(layout, tr("OpenIGTLink server"));
  this->Server = new QWidget;
  group->addWidget(this->Server);
  auto form = new QFormLayout(this->Server);
  form->setContentsMargins(0, 0, 0, 0);
  this->Host = new QLineEdit(settings()->value("BrainShift/Pointer/Host", "127.0.0.1").toString());
  this->Host->setObjectName("BrainShiftPointerHost");
  this->addLine(form, tr("Host"), this->Host,
    tr("Name or IP address of the computer that runs the server, such as PLUS or 3D Slicer. "
       "127.0.0.1 is this computer."));
  this->Port = new QSpinBox;
  this->Port->setObjectName("BrainShiftPointerPort");
  this->Port->setRange(1, 65535);
  this->Port->setValue(settings()->value("BrainShift/Pointer/Port", DefaultPort).toInt());
  this->addLine(form, tr("Port"), this->Port, tr("Port of the server. OpenIGTLink uses 18944."));
  this->Device = new QLineEdit(settings()->value("BrainShift/Pointer/Device").toString());
  this->Device->setObjectName("BrainShiftPointerDevice");
  this->Device->setPlaceholderText("StylusToReference");
  this->addLine(form, tr("Device"), this->Device,
    tr("Name under which the server sends the tip. If the field is empty, BrainShift takes "
       "StylusToReference, else StylusTipToReference, else the first device that the server "
       "names."));
  this->Reconnect = new QCheckBox(tr("Connect again when the connection ends"));
  this->Reconnect->setObjectName("BrainShiftPointerReconnect");
  form->addRow(this->Reconnect);
  this->Connect = new QPushButton;
  this->Connect->setObjectName("BrainShiftPointerConnect");
  this->connect(this->Connect, &QPushButton::clicked, this, &PointerDock::toggleConnection);
  this->Connect->setDefault(true);
  group->addWidget(this->Connect);
  this->Status = wrapped("BrainShiftPointerStatus");
  group->addWidget(this->Status);
}

void PointerDock::addTip(QVBoxLayout* layout)
{
  QVBoxLayout* group = addGroup(layout, tr("Tip"));
  this->Distance = wrapped("BrainShiftPointerDistance");
  QFont large = this->Distance->font();
  large.setPointSizeF(1.6 * large.pointSizeF());
  large.setBold(true);
  this->Distance->setFont(large);
  this->Distance->setToolTip(tr("Distance (mm) of the tip to the deformed cortex."));
  group->addWidget(this->Distance);
  this->Position = wrapped("BrainShiftPointerPlace");
  this->Position->setToolTip(tr("Position of the tip (mm, world axes)."));
  group->addWidget(this->Position);
  auto row = new QHBoxLayout;
  this->ThresholdName = new QLabel(tr("Cortex at intensity"));
  this->Threshold = new QDoubleSpinBox;
  this->Threshold->setObjectName("BrainShiftPointerThreshold");
  this->Threshold->setRange(-1e9, 1e9);
  this->Threshold->setDecimals(2);
  this->Threshold->setToolTip(
    tr("Lowest intensity of the brain. If the volume has a Trace Distance or a Fit Deformation, "
       "its value is used instead."));
  this->connect(this->Threshold, &QDoubleSpinBox::valueChanged, this,
    [](double value) { Pointer::instance()->setThreshold(value); });
  row->addWidget(this->ThresholdName);
  row->addWidget(this->Threshold, 1);
  group->addLayout(row);
  this->Record = new QPushButton;
  this->Record->setObjectName("BrainShiftPointerRecord");
  this->Record->setCheckable(true);
  this->Record->setText(tr("Record Trace (hold %1)").arg(keysText(rowOf(Command::RecordTrace))));
  this->Record->setToolTip(
    tr("Record the path of the tip on the cortex. The brain deforms at once to fit the trace. You "
       "can also hold the key, or a foot switch that sends it."));
  this->connect(this->Record, &QPushButton::clicked, this,
    [this](bool on) { this->report(Pointer::instance()->record(on)); });
  group->addWidget(this->Record);
  this->Recorded = wrapped("BrainShiftPointerRecorded");
  group->addWidget(this->Recorded);
}

void PointerDock::addSession(QVBoxLayout* layout)
{
  auto row = new QHBoxLayout;
  layout->addLayout(row);
  this->Save = new QPushButton(tr("Save Session..."));
  this->Save->setObjectName("BrainShiftPointerSave");
  this->Save->setToolTip(
    tr("Save all poses received since the pointer was connected, with their times (s)."));
  this->connect(this->Save, &QPushButton::clicked, this, &PointerDock::save);
  row->addWidget(this->Save);
  this->Play = new QPushButton(tr("Replay..."));
  this->Play->setObjectName("BrainShiftPointerReplay");
  this->Play->setToolTip(tr("Replay a saved session as if the pointer moved again."));
  this->connect(this->Play, &QPushButton::clicked, this, &PointerDock::replay);
  row->addWidget(this->Play);
  this->Problem = wrapped("BrainShiftPointerProblem");
  layout->addWidget(this->Problem);
  auto note = wrapped("BrainShiftPointerNote");
  note->setText(tr("Research software, not a medical device: never guide surgery with it."));
  note->setEnabled(false);
  layout->addWidget(note);
}

void PointerDock::report(const QString& problem)
{
  this->Problem->setText(problem);
  this->Problem->setVisible(!problem.isEmpty());
  paint(this->Problem, true);
  this->showState();
}

void PointerDock::toggleConnection()
{
  Pointer* pointer = Pointer::instance();
  if (pointer->isOpen())
  {
    pointer->close();
  }
  else if (this->mayDrop())
  {
    TrackerOptions options;
    options.host = this->Host->text().trimmed().toStdString();
    options.port = this->Port->value();
    options.device = this->Device->text().trimmed().toStdString();
    options.reconnect = this->Reconnect->isChecked();
    settings()->setValue("BrainShift/Pointer/Host", this->Host->text().trimmed());
    settings()->setValue("BrainShift/Pointer/Port", this->Port->value());
    settings()->setValue("BrainShift/Pointer/Device", this->Device->text().trimmed());
    pointer->open(options);
  }
  this->report({});
}

void PointerDock::save()
{
  QFileDialog dialog(this, tr("Save Session"), {}, tr("Pointer sessions (*.txt)"));
  dialog.setObjectName("BrainShiftPointerSession");
  dialog.setAcceptMode(QFileDialog::AcceptSave); // it confirms before it replaces a file
  dialog.setDefaultSuffix(QStringLiteral("txt"));
  if (dialog.exec() == QDialog::Accepted)
  {
    this->report(Pointer::instance()->saveSession(dialog.selectedFiles().front()));
  }
}

// Whether nothing is lost if poses begin anew: they are saved, or the user does not want them.
bool PointerDock::mayDrop()
{
  if (!Pointer::instance()->hasUnsaved())
  {
    return true;
  }
  QMessageBox question(QMessageBox::Question, tr("Live Pointer"),
    tr("The poses received since the pointer was connected are not saved. Save them?"),
    QMessageBox::Save | QMessageBox::Discard | QMessageBox::Cancel, this);
  question.setObjectName("BrainShiftPointerUnsaved");
  question.button(QMessageBox::Discard)->setObjectName("BrainShiftPointerDiscard");
  question.button(QMessageBox::Cancel)->setObjectName("BrainShiftPointerCancel");
  const int answer = question.exec();
  if (answer == QMessageBox::Save)
  {
    this->save();
    return !Pointer::instance()->hasUnsaved();
  }
  return answer == QMessageBox::Discard;
}

void PointerDock::replay()
{
  QFileDialog dialog(this, tr("Replay Session"), {}, tr("Pointer sessions (*.txt);;All files (*)"));
  dialog.setObjectName("BrainShiftPointerSession");
  dialog.setFileMode(QFileDialog::ExistingFile);
  if (dialog.exec() == QDialog::Accepted && this->mayDrop())
  {
    this->report(Pointer::instance()->replay(dialog.selectedFiles().front()));
  }
}

void PointerDock::showState()
{
  this->Problem->setVisible(!this->Problem->text().isEmpty());
  this->showConnection();
  this->showTip();
  this->Registration->showState();
}

void PointerDock::showConnection()
{
  const Pointer* pointer = Pointer::instance();
  const bool open = pointer->isOpen();
  this->Connect->setText(!open ? tr("Connect")
      : pointer->isReplay()    ? tr("Stop Replay")
                               : tr("Disconnect"));
  this->Server->setEnabled(!open);
  this->Status->setText(connectionText(*pointer));
  paint(this->Status, warnsOf(*pointer));
  this->Save->setEnabled(pointer->hasSession());
}

void PointerDock::showTip()
{
  const Pointer* pointer = Pointer::instance();
  this->Distance->setText(distanceText(*pointer));
  this->Position->setText(positionText(*pointer));
  const bool isNeeded = pointer->needsThreshold();
  this->ThresholdName->setVisible(isNeeded);
  this->Threshold->setVisible(isNeeded);
  if (isNeeded && !this->Threshold->hasFocus())
  {
    const QSignalBlocker quiet(this->Threshold);
    this->Threshold->setValue(pointer->threshold());
  }
  const PointerTrace& trace = pointer->trace();
  this->Record->setEnabled(pointer->isOpen());
  this->Record->setChecked(trace.isRecording());
  this->Recorded->setVisible(trace.isRecording() || !trace.points().empty());
  this->Recorded->setText(trace.isRecording() ? tr("Recording: %1 points").arg(trace.added())
                                              : tr("Last trace: %1 points").arg(trace.added()));
}
}
