// SPDX-License-Identifier: BSD-3-Clause
#include "Panel/Case/CaseDock.h"

#include "Interaction/Cases/CaseOrders.h"
#include "Interaction/Commands/Application.h"
#include "Interaction/Commands/Tools.h"
#include "Interaction/Edits/RefineEditor.h"
#include "Panel/Case/CaseSettings.h"
#include "Panel/Case/ProposalDialog.h"
#include "Panel/Case/RoleBox.h"
#include "Panel/Case/StepRows.h"
#include "Panel/Parts/Advice.h"
#include "Panel/Parts/MillimetreField.h"
#include "Panel/Parts/StillWheel.h"
#include "Panel/Registered/PaneParts.h"
#include "Panel/Registered/RefinePane.h"

#include <pqActiveObjects.h>
#include <pqCoreConfiguration.h>
#include <pqCoreUtilities.h>
#include <pqFileDialog.h>
#include <pqPipelineSource.h>
#include <pqSettings.h>
#include <pqView.h>

#include <vtkPVSession.h>

#include <QAction>
#include <QApplication>
#include <QComboBox>
#include <QDragEnterEvent>
#include <QDropEvent>
#include <QFormLayout>
#include <QGroupBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QMainWindow>
#include <QPushButton>
#include <QScrollArea>
#include <QScrollBar>
#include <QSignalBlocker>
#include <QStringList>
#include <QTimer>
#include <QVBoxLayout>

#include <algorithm>
#include <array>
#include <utility>

namespace brainshift
{
namespace
{
constexpr int StepOfRefine = 4; // in the list of steps

constexpr double ShareOfPipeline = 0.2; // of the height, for the pipeline browser above
constexpr int Gap = 3;                  // pixels between rows

constexpr const char* VisibleSetting = "BrainShift/Case/Visible";

constexpr std::array<const char*, 4> SphereNames{ "X", "Y", "Z", "Radius" };

// Order, and what the window calls them: dock.py tells the same, but only once it was asked.
constexpr std::array<const char*, 10> Roles{ "volume", "brain", "tumour", "traces", "opening",
  "landmarks", "measured", "electrodes", "reference", "cavity" };

QPushButton* makePush(const char* name, const QString& text, const QString& tip)
{
  auto button = new QPushButton(text);
  button->setObjectName(name);
  button->setToolTip(tip);
  return button;
}

// Scrolls up and down only, so it is never narrower than what it holds, which would be cut.
class UprightScroll : public QScrollArea
{
public:
  QSize minimumSizeHint() const override
  {
    QSize size = QScrollArea::minimumSizeHint();
    if (this->widget())
    {
      size.setWidth(
        this->widget()->minimumSizeHint().width() + this->verticalScrollBar()->sizeHint().width());
    }
    return size;
  }

protected:
  bool eventFilter(QObject* watched, QEvent* event) override
  {
    if (watched == this->widget() && event->type() == QEvent::LayoutRequest)
    {
      this->updateGeometry();
    }
    return QScrollArea::eventFilter(watched, event);
  }
};

// A heading, and the layout under it.
QVBoxLayout* addGroup(QVBoxLayout* layout, const QString& title)
{
  auto group = new QGroupBox(title);
  layout->addWidget(group);
  auto inside = new QVBoxLayout(group);
  inside->setContentsMargins(2 * Gap, Gap, 2 * Gap, Gap);
  return inside;
}

// Whether ParaView was started to show or do something certain, or its user has met the dock.
bool startsForSomething()
{
  const auto start = pqCoreConfiguration::instance();
  return pqApplicationCore::instance()->settings()->contains(VisibleSetting) ||
    !start->pythonScript().empty() || !start->stateFileName().empty() ||
    !start->dataFileNames().empty() || start->testScriptCount() > 0;
}

QMainWindow* mainWindow()
{
  return qobject_cast<QMainWindow*>(pqCoreUtilities::mainWidget());
}

QString chosenPath(const QString& title, const char* name, pqFileDialog::FileMode mode)
{
  pqFileDialog dialog(nullptr, pqCoreUtilities::mainWidget(), title, QString(),
    mode == pqFileDialog::Directory ? QString() : CaseDock::tr("Web pages (*.html)"));
  dialog.setObjectName(name);
  dialog.setFileMode(mode, vtkPVSession::CLIENT);
  const bool chosen = dialog.exec() == QDialog::Accepted && !dialog.getSelectedFiles().isEmpty();
  return chosen ? dialog.getSelectedFiles().first() : QString();
}
}

CaseDock::CaseDock(QWidget* parent)
  : QDockWidget(tr("Case"), parent)
  , Orders(new CaseOrders(this))
{
  this->setObjectName("BrainShiftCaseDock");
  this->setAcceptDrops(true);
  auto content = new QWidget;
  auto layout = new QVBoxLayout(content);
  layout->setContentsMargins(2 * Gap, Gap, 2 * Gap, Gap);
  layout->setSpacing(Gap);
  this->addCases(layout);
  this->addRoles(layout);
  this->addSteps(layout);
  layout->addStretch(1);
  this->showNothingYet();
  auto scroll = new UprightScroll;
  scroll->setWidgetResizable(true);
  scroll->setFrameShape(QFrame::NoFrame);
  scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  scroll->setWidget(content);
  this->setWidget(scroll);
  this->connect(this->Orders, &CaseOrders::changed, this, &CaseDock::showState);
  this->connect(this, &QDockWidget::visibilityChanged, this->Orders, &CaseOrders::setWatched);
  QTimer::singleShot(0, this, &CaseDock::settle); // once ParaView has placed it
}

void CaseDock::settle()
{
  auto window = mainWindow();
  auto properties = window ? window->findChild<QDockWidget*>("propertiesDock") : nullptr;
  const bool wasShown =
    pqApplicationCore::instance()->settings()->value(VisibleSetting, false).toBool();
  const bool isFirst = !startsForSomething();
  const bool isPlaced =
    this->isFloating() || !window || !window->tabifiedDockWidgets(this).isEmpty();
  if (properties && !isPlaced)
  {
    window->tabifyDockWidget(properties, this);
    properties->raise();
  }
  this->setVisible(wasShown || isFirst);
  if (isFirst)
  {
    this->comeToFront();
  }
  // Not its signal toggled, which the end of the program sends, too.
  this->connect(this->toggleViewAction(), &QAction::triggered, this, &CaseDock::remember);
}

void CaseDock::remember()
{
  pqApplicationCore::instance()->settings()->setValue(VisibleSetting, !this->isHidden());
}

void CaseDock::toggle()
{
  this->showInFront(!this->isInFront());
}

void CaseDock::toggleByKey()
{
  const QWidget* keyboard = QApplication::focusWidget();
  this->showInFront(!this->isInFront() || !keyboard || !this->isAncestorOf(keyboard));
}

bool CaseDock::isInFront() const
{
  return this->isVisible() && !this->visibleRegion().isEmpty(); // not behind another tab
}

void CaseDock::showInFront(bool on)
{
  this->setVisible(on);
  this->remember();
  if (on)
  {
    this->comeToFront();
    this->Boxes[Roles.front()]->setFocus(Qt::ShortcutFocusReason);
  }
}

// The first time with more of the window's height than the panel below the pipeline has: then the
// steps are seen, too.
void CaseDock::comeToFront()
{
  this->raise();
  auto window = mainWindow();
  auto pipeline = window ? window->findChild<QDockWidget*>("pipelineBrowserDock") : nullptr;
  if (!this->IsRoomy && pipeline && !this->isFloating() && pipeline->isVisible() &&
    window->dockWidgetArea(pipeline) == window->dockWidgetArea(this))
  {
    const int both = pipeline->height() + this->height();
    const int above = std::min(pipeline->height(), static_cast<int>(ShareOfPipeline * both));
    window->resizeDocks({ pipeline, this }, { above, both - above }, Qt::Vertical);
    this->IsRoomy = true;
  }
}

void CaseDock::addCases(QVBoxLayout* layout)
{
  auto row = new QHBoxLayout;
  layout->addLayout(row);
  auto folder = makePush("BrainShiftCaseFolder", tr("Open Folder..."),
    tr("Sort the files of a folder into roles, and show them for correction. You can also drop a "
       "folder or files on this dock."));
  this->connect(folder, &QPushButton::clicked, this, &CaseDock::openFolder);
  row->addWidget(folder);
  auto begin = makePush("BrainShiftCaseNew", tr("New Case"),
    tr("Begin another case. The present one stays in the pipeline."));
  this->connect(
    begin, &QPushButton::clicked, this, [this] { this->Orders->give("begin", {}, QString()); });
  row->addWidget(begin);
  this->NewMoment = makePush("BrainShiftCaseNewMoment", tr("New Moment"),
    tr("Begin another moment of the same surgery: it has the same volume and brain, and strokes, "
       "fit and measurements of its own. Give it a name and a time under Settings."));
  this->connect(this->NewMoment, &QPushButton::clicked, this,
    [this] { this->Orders->give("moment", {}, tr("New Moment")); });
  row->addWidget(this->NewMoment);
  row->addStretch(1);
  this->Cases = new QComboBox;
  this->Cases->setObjectName("BrainShiftCases");
  this->Cases->setAccessibleName(tr("Case"));
  keepStill(this->Cases);
  this->Cases->setToolTip(tr("The case that this dock shows."));
  this->connect(this->Cases, &QComboBox::activated, this, [this](int index) {
    this->Orders->give(
      "select", { { "name", this->Cases->itemData(index).toString() } }, QString());
  });
  layout->addWidget(this->Cases);
}

void CaseDock::addRoles(QVBoxLayout* layout)
{
  QVBoxLayout* group = addGroup(layout, tr("Roles"));
  auto form = new QFormLayout;
  form->setVerticalSpacing(Gap);
  group->addLayout(form);
  for (const char* role : Roles)
  {
    auto box = new RoleBox(role);
    QString name(role);
    name[0] = name[0].toUpper();
    box->setObjectName("BrainShiftCase" + name);
    this->Boxes[role] = box;
    this->connect(box, &RoleBox::sourceChosen, this,
      [this, role](int number) { this->choose(role, { { "source", number } }); });
    this->connect(box, &RoleBox::fileChosen, this,
      [this, role](const QString& path) { this->choose(role, { { "path", path } }); });
    this->connect(box, &RoleBox::sphereChosen, this,
      [this] { this->Orders->give("sphere", {}, tr("Choose Opening")); });
    form->addRow(name, box);
    if (this->Boxes.size() == 5) // the opening
    {
      this->addSphere();
      form->addRow(this->Sphere);
    }
  }
}

void CaseDock::addSphere()
{
  this->Sphere = new QWidget;
  this->Sphere->setObjectName("BrainShiftCaseSphere");
  auto row = new QHBoxLayout(this->Sphere);
  row->setContentsMargins(0, 0, 0, 0);
  row->addWidget(new QLabel(tr("Centre, radius (mm)")), 1);
  for (const char* name : SphereNames)
  {
    auto field = new MillimetreField(
      QString("BrainShiftCaseSphere%1").arg(name), qstrcmp(name, "Radius") == 0 ? 0.0 : -1e9);
    field->setAccessibleName(tr("Opening, %1 (mm)").arg(name));
    field->setToolTip(
      tr("Centre and radius (mm) of the opening. They begin as a sphere around the traces."));
    this->SphereFields.append(field);
    row->addWidget(field);
    this->connect(field, &MillimetreField::valueEdited, this, [this] {
      QJsonArray numbers;
      for (const MillimetreField* each : this->SphereFields)
      {
        numbers.append(each->value());
      }
      this->Orders->give("sphere", { { "numbers", numbers } }, tr("Set Opening"));
    });
  }
}

void CaseDock::addSteps(QVBoxLayout* layout)
{
  this->Problem = new QLabel;
  this->Problem->setObjectName("BrainShiftCaseProblem");
  this->Problem->setWordWrap(true);
  this->Problem->setTextFormat(Qt::PlainText);
  this->Problem->setTextInteractionFlags(Qt::TextSelectableByMouse | Qt::TextSelectableByKeyboard);
  layout->addWidget(this->Problem);
  QVBoxLayout* group = addGroup(layout, tr("Steps"));
  this->Steps = new StepRows;
  group->addWidget(this->Steps);
  this->connect(this->Steps, &StepRows::pressed, this, &CaseDock::run);
  this->addSettings(layout);
  this->Note = new QLabel(tr("Research software, not a medical device."));
  this->Note->setWordWrap(true);
  layout->addWidget(this->Note);
  this->paint();
}

void CaseDock::paint()
{
  QPalette palette = this->palette();
  const QColor quiet = quietColor(palette);
  palette.setColor(QPalette::WindowText, gradeColor(Grade::Bad, palette, false));
  this->Problem->setPalette(palette);
  palette.setColor(QPalette::WindowText, quiet);
  this->Note->setPalette(palette);
}

void CaseDock::changeEvent(QEvent* event)
{
  QDockWidget::changeEvent(event);
  if (event->type() == QEvent::PaletteChange && this->Note)
  {
    this->paint();
  }
}

void CaseDock::addSettings(QVBoxLayout* layout)
{
  this->Settings = new CaseSettings;
  addGroup(layout, tr("Settings"))->addWidget(this->Settings);
  this->connect(this->Settings, &CaseSettings::edited, this,
    [this](const QString& name, const QJsonValue& value, const QString& label) {
      this->Orders->give("set", { { "name", name }, { "value", value } }, tr("Set %1").arg(label));
    });
  this->connect(this->Settings, &CaseSettings::refused, this->Orders, &CaseOrders::report);
}

void CaseDock::choose(const QString& role, const QJsonObject& what)
{
  QJsonObject arguments = what;
  arguments["role"] = role;
  this->Orders->give("choose", arguments, tr("Choose %1").arg(this->Boxes[role]->accessibleName()));
}

void CaseDock::openFolder()
{
  const QString folder =
    chosenPath(tr("Folder of a case"), "BrainShiftCaseFolderDialog", pqFileDialog::Directory);
  if (!folder.isEmpty())
  {
    this->propose({ folder });
  }
}

void CaseDock::propose(const QStringList& paths)
{
  const QJsonArray proposal = this->Orders->sorted(paths);
  if (proposal.isEmpty())
  {
    this->Orders->report(this->Orders->problem().isEmpty()
        ? tr("%1 has no volumes or points that can be opened.").arg(paths.join(", "))
        : this->Orders->problem());
    return;
  }
  ProposalDialog dialog(
    pqCoreUtilities::mainWidget(), proposal, this->Orders->told()["roles"].toArray());
  if (dialog.exec() == QDialog::Accepted)
  {
    this->Orders->give("accept", { { "roles", dialog.accepted() } }, tr("Open Case"));
  }
}

void CaseDock::dragEnterEvent(QDragEnterEvent* event)
{
  if (!pathsOf(event->mimeData()).isEmpty())
  {
    event->acceptProposedAction();
  }
}

// Later: the program that the files come from waits for the end of the drop.
void CaseDock::dropEvent(QDropEvent* event)
{
  event->acceptProposedAction();
  QTimer::singleShot(0, this, [this, paths = pathsOf(event->mimeData())] { this->propose(paths); });
}

void CaseDock::run(const QString& step)
{
  static const QStringList changing{ "Look", "Measure", "Fit", "Tumour left", "Moments" };
  const bool changesPipeline = changing.contains(step);
  if (step == "By hand")
  {
    this->runByHand();
  }
  else if (step == "Refine")
  {
    this->runRefine();
  }
  else if (step == "Export" || step == "Report")
  {
    this->writeTo(step);
  }
  else
  {
    this->Orders->give("run", { { "step", step } }, changesPipeline ? step : QString());
  }
}

void CaseDock::runByHand()
{
  pqPipelineSource* bent = this->Orders->bent();
  if (!bent)
  {
    return;
  }
  pqActiveObjects::instance().setActiveSource(bent);
  const auto& tools = toolTable();
  const auto easiest =
    std::find_if(tools.rbegin(), tools.rend(), [](const ToolRow& row) { return row.lesson; });
  ToolSettings::instance()->setTool(easiest == tools.rend() ? Tool::None : easiest->tool);
  if (auto properties = mainWindow()->findChild<QDockWidget*>("propertiesDock"))
  {
    properties->show();
    properties->raise();
  }
  if (pqView* view = pqActiveObjects::instance().activeView())
  {
    view->widget()->setFocus(Qt::OtherFocusReason); // else a button behind the panel had it
  }
}

void CaseDock::runRefine()
{
  RefineEditor* editor = RefineEditor::of(this->Orders->bent());
  if (!editor)
  {
    return;
  }
  if (editor->isActive())
  {
    editor->stop();
    return;
  }
  RefineSettings settings;
  settings.reference = this->Orders->comparison();
  editor->begin(settings);
  this->showState();
}

void CaseDock::writeTo(const QString& step)
{
  const bool isFolder = step == "Export";
  const QString path = isFolder
    ? chosenPath(tr("Export into a folder"), "BrainShiftCaseExportDialog", pqFileDialog::Directory)
    : chosenPath(tr("Write a report"), "BrainShiftCaseReportDialog", pqFileDialog::AnyFile);
  if (!path.isEmpty())
  {
    this->Orders->give(
      "run", { { "step", step }, { isFolder ? "folder" : "file", path } }, QString());
  }
}

// Until Python answers for the first time, which takes it a second.
void CaseDock::showNothingYet()
{
  for (RoleBox* box : std::as_const(this->Boxes))
  {
    box->show({}, false);
  }
  const std::array<QWidget*, 4> empty{ this->Cases, this->Sphere, this->Settings->parentWidget(),
    this->Problem };
  for (QWidget* widget : empty)
  {
    widget->hide();
  }
  this->NewMoment->setEnabled(false);
  this->Steps->setEnabled(false);
}

void CaseDock::showState()
{
  this->Steps->setEnabled(true);
  const QJsonObject& told = this->Orders->told();
  const QJsonArray sphere = told["sphere"].toArray();
  for (const QJsonValue role : told["roles"].toArray())
  {
    RoleBox* box = this->Boxes[role["role"].toString()];
    box->setAccessibleName(role["label"].toString());
    box->setToolTip(role["tip"].toString());
    box->show(role.toObject(), box == this->Boxes["opening"] && !sphere.isEmpty());
  }
  this->NewMoment->setEnabled(told["bent"].toInt() != 0);
  this->Sphere->setVisible(!sphere.isEmpty());
  for (int i = 0; i < sphere.size(); ++i)
  {
    this->SphereFields[i]->setValue(sphere[i].toDouble());
  }
  this->Settings->show(told["settings"].toObject());
  this->Settings->parentWidget()->setVisible(!this->Settings->isHidden());
  this->Steps->show(told["steps"].toArray());
  this->showRefine();
  this->Problem->setText(this->Orders->problem());
  this->Problem->setVisible(!this->Orders->problem().isEmpty());
  const QSignalBlocker quiet(this->Cases);
  this->Cases->clear();
  const QJsonArray cases = told["cases"].toArray();
  for (const QJsonValue each : cases)
  {
    this->Cases->addItem(each[1].toString(), each[0].toString());
  }
  if (this->Cases->findData(told["case"].toString()) < 0)
  {
    this->Cases->addItem(tr("New case"), told["case"].toString());
  }
  this->Cases->setCurrentIndex(this->Cases->findData(told["case"].toString()));
  this->Cases->setVisible(this->Cases->count() > 1);
}

// What only the editor knows: the progress of a run, and why it failed.
void CaseDock::showRefine()
{
  RefineEditor* editor = RefineEditor::of(this->Orders->bent());
  if (editor)
  {
    this->connect(
      editor, &RefineEditor::changed, this, &CaseDock::showRefine, Qt::UniqueConnection);
  }
  if (!editor || (editor->costs().isEmpty() && editor->problem().isEmpty()))
  {
    return;
  }
  const RefineFigures& figures = editor->figures();
  if (editor->isActive())
  {
    this->Steps->showInstead("Refine", refineProgress(figures), tr("Stop"));
    return;
  }
  const QJsonValue step = this->Orders->told()["steps"][StepOfRefine];
  const QString text = editor->problem().isEmpty() ? step["found"].toString() : editor->problem();
  if (step["lacks"].toString().isEmpty())
  {
    this->Steps->showInstead("Refine", text, tr("Refine"));
  }
}
}
