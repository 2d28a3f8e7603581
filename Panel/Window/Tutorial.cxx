// SPDX-License-Identifier: BSD-3-Clause
#include "Panel/Window/Tutorial.h"

#include "Interaction/Commands/ToolSettings.h"
#include "Interaction/Edits/StrokeEditor.h"
#include "Interaction/Views/ActiveDeformation.h"
#include "Panel/Window/Welcome.h"

#include <pqActiveObjects.h>
#include <pqApplicationCore.h>
#include <pqCoreUtilities.h>
#include <pqDataRepresentation.h>
#include <pqPipelineSource.h>
#include <pqUndoStack.h>

#include <vtkPythonInterpreter.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMProxy.h>

#include <QAction>
#include <QHBoxLayout>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QVBoxLayout>

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

namespace brainshift
{
namespace
{
constexpr int LookAgain = 200; // ms
constexpr const char* Sample = "import brainshift\nbrainshift.open_sample()\n";

enum Steps
{
  OpenStep,
  LookStep,
  StampStep,
  SoftStep,
  MoveStep,
  CompareStep,
  SaveStep,
  StepCount
};

struct Page
{
  const char* title;
  const char* text;
  const char* help; // what the button does for the user; null: nothing
};

constexpr std::array<Page, StepCount> Pages{ {
  { "Open a volume",
    "Press <b>Open the sample</b>. For a volume of your own, choose File &gt; Open, press Apply, "
    "then choose Filters &gt; BrainShift &gt; Free-Form Deformation and press Apply.",
    "Open the sample" },
  { "Choose a look",
    "Press the button <b>Look</b> in the toolbar, the small head, and choose <b>Brain</b>. You see "
    "the cortex without skin and skull. Without a segmentation, choose another look. Drag in the "
    "view to turn it.",
    nullptr },
  { "Push with the stamp",
    "Press <b>Take the stamp</b>. Move the mouse over the cortex until you see the ellipse. Turn "
    "the wheel: the tissue goes in or comes out. Shift and wheel change the radius.",
    "Take the stamp" },
  { "Drag softly",
    "Press <b>Take Soft</b>. Press on the cortex and drag: tissue near the mouse goes along, less "
    "and less with the distance.",
    "Take Soft" },
  { "Pull one control point",
    "Press <b>Take Move</b>. Move the mouse over the cortex. Press on a control point, a small "
    "ball, and drag it. Only the tissue around this point goes along.",
    "Take Move" },
  { "Compare",
    "Hold down the button <b>Before/After</b> in the toolbar: you see the volume as it was loaded. "
    "Over a view, the key O does this, too.",
    nullptr },
  { "Save",
    "Choose <b>File &gt; Save State</b>. The state file holds every stroke. Load it tomorrow and "
    "go "
    "on. Ctrl+Z takes strokes back one by one.",
    nullptr },
} };

std::optional<Tool> toolOf(int step)
{
  switch (step)
  {
    case StampStep:
      return Tool::Stamp;
    case SoftStep:
      return Tool::Soft;
    case MoveStep:
      return Tool::Move;
    default:
      return {};
  }
}

ToolKind kindOf(int step)
{
  return step == StampStep ? ToolKind::Stamp : step == SoftStep ? ToolKind::Soft : ToolKind::Move;
}

StrokeEditor* editor()
{
  pqPipelineSource* bent = activeDeformation();
  return bent ? StrokeEditor::of(bent) : nullptr;
}

int countStrokes(Tool tool)
{
  const StrokeEditor::Strokes strokes = editor() ? editor()->strokes() : StrokeEditor::Strokes();
  return static_cast<int>(std::count_if(
    strokes.begin(), strokes.end(), [&](const Stroke& stroke) { return stroke.tool == tool; }));
}

// The colours that the volume is shown in; empty if it is not.
std::vector<double> shownColors()
{
  pqPipelineSource* bent = activeDeformation();
  pqDataRepresentation* display =
    bent ? bentDisplay(bent, pqActiveObjects::instance().activeView()) : nullptr;
  vtkSMProxy* colors = display ? display->getLookupTableProxy() : nullptr;
  return colors ? vtkSMPropertyHelper(colors, "RGBPoints").GetDoubleArray() : std::vector<double>();
}
}

void Tutorial::begin()
{
  QWidget* window = pqCoreUtilities::mainWidget();
  auto tutorial = window->findChild<Tutorial*>(QString(), Qt::FindDirectChildrenOnly);
  if (!tutorial)
  {
    tutorial = new Tutorial(window);
  }
  tutorial->show();
  tutorial->raise();
}

Tutorial::Tutorial(QWidget* window)
  : QDialog(window, Qt::Tool)
{
  this->setObjectName("BrainShiftTutorial");
  this->setAttribute(Qt::WA_DeleteOnClose);
  this->setWindowTitle(tr("BrainShift tutorial"));
  new QVBoxLayout(this);
  this->addTexts();
  this->addButtons();
  this->connect(pqApplicationCore::instance(), &pqApplicationCore::aboutToWriteState, this,
    [this] { this->Saved = true; });
  this->connect(&this->Watch, &QTimer::timeout, this, &Tutorial::watch);
  this->Watch.start(LookAgain);
  this->go(OpenStep);
  this->placeInCorner();
}

void Tutorial::addTexts()
{
  this->Progress = new QProgressBar(this);
  this->Progress->setRange(0, StepCount);
  this->Progress->setTextVisible(false);
  this->Progress->setMaximumHeight(this->fontMetrics().height() / 2);
  this->Title = new QLabel(this);
  this->Title->setObjectName("TutorialTitle");
  this->Text = new QLabel(this);
  this->Text->setObjectName("TutorialText");
  this->Text->setWordWrap(true);
  this->Text->setFixedWidth(this->fontMetrics().averageCharWidth() * 44);
  this->Text->setAlignment(Qt::AlignLeft | Qt::AlignTop);
  int tallest = 0; // a window that is too small would cut the longer pages off
  for (const Page& page : Pages)
  {
    this->Text->setText(tr(page.text));
    tallest = std::max(tallest, this->Text->heightForWidth(this->Text->width()));
  }
  this->Text->setMinimumHeight(tallest);
  for (QWidget* part : std::initializer_list<QWidget*>{ this->Progress, this->Title, this->Text })
  {
    this->layout()->addWidget(part);
  }
}

void Tutorial::addButtons()
{
  auto row = new QHBoxLayout();
  static_cast<QVBoxLayout*>(this->layout())->addLayout(row);
  const auto add = [&](const char* name, const QString& text, const auto& pressed) {
    auto button = new QPushButton(text, this);
    button->setObjectName(name);
    button->setAutoDefault(false); // Enter belongs to the window
    this->connect(button, &QPushButton::clicked, this, pressed);
    row->addWidget(button);
    return button;
  };
  this->Help = add("TutorialHelp", QString(), [this] { this->help(); });
  row->addStretch();
  this->Back = add("TutorialBack", tr("Back"), [this] { this->go(this->Step - 1); });
  this->Skip = add("TutorialSkip", tr("Skip"), [this] { this->go(this->Step + 1); });
  add("TutorialLeave", tr("Leave"), [this] { this->close(); });
}

void Tutorial::help()
{
  if (toolOf(this->Step))
  {
    ToolSettings::instance()->setTool(kindOf(this->Step));
    return;
  }
  SCOPED_UNDO_EXCLUDE();
  vtkPythonInterpreter::Initialize();
  vtkPythonInterpreter::RunSimpleString(Sample);
}

void Tutorial::go(int step)
{
  this->Step = step;
  this->Progress->setValue(step);
  this->Back->setEnabled(step > OpenStep);
  this->Skip->setVisible(step < StepCount);
  if (step >= StepCount)
  {
    this->Title->setText(tr("<b>Done</b>"));
    this->Text->setText(tr("You know the tools. Help &gt; BrainShift Mouse and Keys lists what "
                           "mouse and keys do. Press Leave to close this window."));
    this->Help->hide();
    return;
  }
  const Page& page = Pages[step];
  this->Title->setText(
    tr("<b>Step %1 of %2: %3</b>").arg(step + 1).arg(int(StepCount)).arg(tr(page.title)));
  this->Text->setText(tr(page.text));
  this->Help->setText(page.help ? tr(page.help) : QString());
  this->Help->setVisible(page.help);
  this->ComparedBefore = editor() ? editor()->timesBefore() : 0;
  this->Saved = false;
  this->ColorsBefore = shownColors();
  const std::optional<Tool> tool = toolOf(step);
  this->StrokesBefore = tool ? countStrokes(*tool) : 0;
}

void Tutorial::watch()
{
  closeWelcome();
  if (this->ColorsBefore.empty())
  {
    this->ColorsBefore = shownColors(); // the volume may be shown later than the step
  }
  if (this->Step < StepCount && this->isDone())
  {
    this->go(this->Step + 1);
  }
}

bool Tutorial::isDone() const
{
  if (const std::optional<Tool> tool = toolOf(this->Step))
  {
    return countStrokes(*tool) > this->StrokesBefore && !editor()->isEditing();
  }
  switch (this->Step)
  {
    case OpenStep:
      return editor() != nullptr;
    case LookStep:
      return shownColors() != this->ColorsBefore;
    case CompareStep: // until it is let go
      return editor() && editor()->timesBefore() > this->ComparedBefore && !editor()->showsBefore();
    default:
      return this->Saved;
  }
}

// Where it covers neither the panel nor the middle of the view.
void Tutorial::placeInCorner()
{
  this->adjustSize();
  const QRect window = this->parentWidget()->frameGeometry();
  const int gap = this->fontMetrics().height() * 2;
  this->move(window.right() - this->width() - gap, window.bottom() - this->height() - 2 * gap);
}
}
