// SPDX-License-Identifier: BSD-3-Clause
#include "Panel/Window/Tutorial.h"

#include "Interaction/Commands/Tools.h"
#include "Interaction/Edits/StrokeEditor.h"
#include "Interaction/Views/ActiveDeformation.h"

#include <pqActiveObjects.h>
#include <pqApplicationCore.h>
#include <pqCoreUtilities.h>
#include <pqDataRepresentation.h>
#include <pqPipelineSource.h>
#include <pqUndoStack.h>

#include <vtkPythonInterpreter.h>
#include <vtkSMPropertyHelper.h>

#include <QAction>
#include <QApplication>
#include <QHBoxLayout>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QVBoxLayout>
#include <QWidget>
#include <QWindow>

#include <algorithm>
#include <cstring>

namespace brainshift
{
namespace
{
constexpr int WelcomeLooksAgain = 100; // ms
constexpr int MostLooks = 300;         // a slow start may read a volume first
}

bool closeWelcome()
{
  QWidget* modal = QApplication::activeModalWidget();
  return modal && std::strcmp(modal->metaObject()->className(), "pqWelcomeDialog") == 0 &&
    modal->close();
}

void keepWelcomeAway(QObject* owner)
{
  auto timer = new QTimer(owner);
  const auto looks = std::make_shared<int>(0);
  QObject::connect(timer, &QTimer::timeout, timer, [timer, looks] {
    if (closeWelcome() || ++*looks == MostLooks)
    {
      timer->deleteLater();
    }
  });
  timer->start(WelcomeLooksAgain);
}

namespace
{
constexpr int LookAgain = 200; // ms
constexpr const char* Sample = "import brainshift\nbrainshift.open_sample()\n";

enum class Task
{
  Open,
  Look,
  UseTool,
  Compare,
  Save
};

struct Page
{
  Task task;
  const char* title;
  const char* text;
  const char* help = nullptr; // text of the button that does the step; null: no button
  Tool tool = Tool::None;     // of the task UseTool
};

std::vector<Page> makePages()
{
  std::vector<Page> pages{
    { Task::Open, "Open a volume",
      "Press <b>Open the sample</b>. For a volume of your own, choose File &gt; Open, press Apply, "
      "then choose Filters &gt; BrainShift &gt; Free-Form Deformation and press Apply.",
      "Open the sample" },
    { Task::Look, "Choose a preset",
      "Press the button <b>Look</b> (the small head) in the toolbar and choose <b>Brain</b>. You "
      "see the cortex without skin and skull. Without a segmentation, choose another preset. Drag "
      "in the view to turn it." },
  };
  // The last tools first: the stamp is the easiest.
  for (auto row = toolTable().rbegin(); row != toolTable().rend(); ++row)
  {
    if (const auto& lesson = row->lesson)
    {
      pages.push_back({ Task::UseTool, lesson->title, lesson->text, lesson->button, row->tool });
    }
  }
  pages.push_back({ Task::Compare, "Compare",
    "Hold down the button <b>Before/After</b> in the toolbar to see the volume as loaded. Over a "
    "view, the key O does this, too." });
  pages.push_back({ Task::Save, "Save",
    "Choose <b>File &gt; Save State</b>. The state file holds every stroke. Load it later to "
    "continue. Ctrl+Z undoes strokes one by one." });
  return pages;
}

const std::vector<Page>& pages()
{
  static const std::vector<Page> all = makePages();
  return all;
}

int stepCount()
{
  return static_cast<int>(pages().size());
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
  tutorial->belongToWindow();
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
  this->go(0);
  this->placeInCorner();
}

void Tutorial::addTexts()
{
  this->Progress = new QProgressBar(this);
  this->Progress->setRange(0, stepCount());
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
  for (const Page& page : pages())
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
  const Page& page = pages()[this->Step];
  if (page.task == Task::UseTool)
  {
    ToolSettings::instance()->setTool(page.tool);
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
  this->Back->setEnabled(step > 0);
  this->Skip->setVisible(step < stepCount());
  if (step >= stepCount())
  {
    this->Title->setText(tr("<b>Done</b>"));
    this->Text->setText(tr("You know the tools. Help &gt; BrainShift Mouse and Keys lists all "
                           "gestures and keys. Press Leave to close this window."));
    this->Help->hide();
    return;
  }
  const Page& page = pages()[step];
  this->Title->setText(
    tr("<b>Step %1 of %2: %3</b>").arg(step + 1).arg(stepCount()).arg(tr(page.title)));
  this->Text->setText(tr(page.text));
  this->Help->setText(page.help ? tr(page.help) : QString());
  this->Help->setVisible(page.help);
  this->ComparedBefore = editor() ? editor()->timesBefore() : 0;
  this->Saved = false;
  this->ColorsBefore = shownColors();
  this->StrokesBefore = countStrokes(page.tool);
}

// Qt tells the window manager once whose tool this window is, when it is shown. ParaView makes its
// window again when it gets its first view, and then the tool would belong to no window: it would
// lie under the main window, at the latest after a click there.
void Tutorial::belongToWindow()
{
  QWindow* window = this->parentWidget()->windowHandle();
  const WId owner = window && window->handle() ? window->winId() : 0;
  if (!this->isVisible() || owner == 0 || owner == this->Owner)
  {
    return;
  }
  this->Owner = owner;
  this->setAttribute(Qt::WA_ShowWithoutActivating);
  this->hide();
  this->winId(); // so that it has a window to tell about
  this->windowHandle()->setTransientParent(window);
  this->show();
  this->setAttribute(Qt::WA_ShowWithoutActivating, false);
}

void Tutorial::watch()
{
  closeWelcome();
  this->belongToWindow();
  if (this->ColorsBefore.empty())
  {
    this->ColorsBefore = shownColors(); // the volume may be shown later than the step
  }
  if (this->Step < stepCount() && this->isDone())
  {
    this->go(this->Step + 1);
  }
}

bool Tutorial::isDone() const
{
  const Page& page = pages()[this->Step];
  switch (page.task)
  {
    case Task::Open:
      return editor() != nullptr;
    case Task::Look:
      return shownColors() != this->ColorsBefore;
    case Task::UseTool:
      return countStrokes(page.tool) > this->StrokesBefore && !editor()->isEditing();
    case Task::Compare: // until it is let go
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
