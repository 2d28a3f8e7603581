// SPDX-License-Identifier: BSD-3-Clause
#include "Panel/Window/Toolbar.h"

#include "Filters/Looks/Look.h"
#include "Interaction/Commands/Application.h"
#include "Interaction/Commands/Commands.h"
#include "Interaction/Commands/Tools.h"
#include "Interaction/Edits/StrokeEditor.h"
#include "Interaction/Views/ActiveDeformation.h"
#include "Interaction/Views/Flicker.h"
#include "Interaction/Workarounds/QuietMessages.h"
#include "Interaction/Workarounds/StopReading.h"
#include "Panel/Case/CaseDock.h"
#include "Panel/Tools/LookChoice.h"
#include "Panel/Window/StatusLine.h"

#include <pqActiveObjects.h>
#include <pqCoreUtilities.h>
#include <pqPipelineSource.h>
#include <pqView.h>

#include <QDockWidget>
#include <QMainWindow>
#include <QShortcut>
#include <QStatusBar>
#include <QToolButton>

namespace brainshift
{
Toolbar::Toolbar(QWidget* mainWindow)
  : QToolBar(tr("BrainShift"), mainWindow)
{
  this->setObjectName("BrainShift");
  this->addTools();
  this->addSeparator();
  this->addReset();
  this->addCompare();
  this->addFlicker();
  this->addLooks();
  this->addPointer();
  this->addCase();
  for (QAction* action : this->actions()) // buttons are named like actions, for tests to press
  {
    if (!action->isSeparator())
    {
      this->widgetForAction(action)->setObjectName(action->objectName().mid(6) + "Button");
    }
  }
  mainWindow->addActions(this->actions()); // shortcuts hold while the toolbar is hidden
  this->followPipeline();
  this->connect(ToolSettings::instance(), &ToolSettings::changed, this, &Toolbar::refresh);
  this->refresh();
  if (auto window = qobject_cast<QMainWindow*>(mainWindow))
  {
    auto messages = new QuietMessages(window);
    window->statusBar()->addWidget(new StatusLine(window, messages), 1);
    window->statusBar()->addWidget(new CursorLine(window));
    new StopReading(window); // lives as long as the window
  }
}

void Toolbar::addTools()
{
  for (const ToolRow& row : toolTable())
  {
    QAction* action = this->addAction(QIcon(row.icon()), nameOf(row.tool));
    action->setObjectName("actionBrainShift" + row.id());
    action->setToolTip(row.tip());
    action->setShortcut(QKeySequence(row.key));
    action->setCheckable(true);
    this->connect(action, &QAction::triggered, this, [tool = row.tool](bool on) {
      ToolSettings::instance()->setTool(on ? tool : Tool::None);
      pqView* view = pqActiveObjects::instance().activeView();
      if (on && view && view->widget())
      {
        view->widget()->setFocus(); // for the keys of the tool
      }
    });
    this->Tools.append(action);
  }
}

void Toolbar::addReset()
{
  this->Reset = this->addAction(QIcon(":/BrainShift/reset.svg"), tr("Reset All Strokes"));
  this->Reset->setObjectName("actionBrainShiftReset");
  this->Reset->setToolTip(tr("Delete all strokes. Ctrl+Z brings them back."));
  this->connect(this->Reset, &QAction::triggered, this, [this] {
    if (this->Editor)
    {
      this->Editor->replaceAll({}, tr("Reset All Strokes"));
    }
  });
}

void Toolbar::addCompare()
{
  this->Compare = this->addAction(QIcon(":/BrainShift/compare.svg"), tr("Before/After"));
  this->Compare->setObjectName("actionBrainShiftCompare");
  this->Compare->setToolTip(
    tr("Show the volume as loaded while this button is held down. Over a view, the key O does this "
       "too."));
  auto button = qobject_cast<QToolButton*>(this->widgetForAction(this->Compare));
  const auto show = [this](bool before) {
    if (this->Editor)
    {
      this->Editor->showBefore(before);
    }
  };
  this->connect(button, &QToolButton::pressed, this, [show] { show(true); });
  this->connect(button, &QToolButton::released, this, [show] { show(false); });
}

void Toolbar::addFlicker()
{
  this->Flickering = this->addAction(QIcon(":/BrainShift/flicker.svg"), tr("Flicker"));
  this->Flickering->setObjectName("actionBrainShiftFlicker");
  this->Flickering->setToolTip(
    tr("Show the deformed volume and the reference of Compare Volumes in turn (K). Press again to "
       "stop."));
  this->Flickering->setShortcut(shortcutOf(Command::Flicker));
  this->Flickering->setAutoRepeat(false);
  this->Flickering->setCheckable(true);
  auto flicker = new Flicker(this);
  this->connect(this->Flickering, &QAction::triggered, flicker, &Flicker::setOn);
  this->connect(flicker, &Flicker::switched, this->Flickering, &QAction::setChecked);
}

void Toolbar::addLooks()
{
  QAction* action = (new LookMenu(this))->menuAction();
  action->setIcon(iconOfLook(lookTable().front().name));
  action->setObjectName("actionBrainShiftLooks");
  action->setToolTip(
    tr("Look: show skin, brain, bone or vessels of the volume in the active view."));
  this->addAction(action);
  qobject_cast<QToolButton*>(this->widgetForAction(action))
    ->setPopupMode(QToolButton::InstantPopup);
}

void Toolbar::addPointer()
{
  QAction* action = this->addAction(QIcon(":/BrainShift/pointer.svg"), tr("Live Pointer"));
  action->setObjectName("actionBrainShiftPointer");
  action->setToolTip(tr("Live Pointer: show or hide the dock that connects a tracked pointer."));
  this->connect(action, &QAction::triggered, this, [this] {
    // Found when it is wanted: ParaView makes docks after toolbars.
    if (auto dock = this->window()->findChild<QDockWidget*>("BrainShiftPointerDock"))
    {
      dock->setVisible(!dock->isVisible());
      dock->raise();
    }
  });
}

void Toolbar::addCase()
{
  QAction* action = this->addAction(QIcon(":/BrainShift/case.svg"), tr("Case"));
  action->setObjectName("actionBrainShiftCase");
  action->setToolTip(
    tr("Case: show or hide the dock with the files of a patient and the steps from "
       "there to a report (%1).")
      .arg(keysText(rowOf(Command::ShowCase))));
  const auto dock = [] { return pqCoreUtilities::mainWidget()->findChild<CaseDock*>(); };
  this->connect(action, &QAction::triggered, this, [dock] {
    if (CaseDock* found = dock())
    {
      found->toggle();
    }
  });
  // Not the action's: who presses the key in a view wants to go on in the dock that is there.
  auto key = new QShortcut(shortcutOf(Command::ShowCase), pqCoreUtilities::mainWidget());
  this->connect(key, &QShortcut::activated, this, [dock] {
    if (CaseDock* found = dock())
    {
      found->toggleByKey();
    }
  });
}

void Toolbar::followPipeline()
{
  this->RefreshSoon.setSingleShot(true);
  this->RefreshSoon.setInterval(0);
  this->connect(&this->RefreshSoon, &QTimer::timeout, this, &Toolbar::refresh);
  const auto soon = [this] { this->RefreshSoon.start(); };
  pqActiveObjects& active = pqActiveObjects::instance();
  this->connect(&active, &pqActiveObjects::sourceChanged, this, soon);
  this->connect(&active, &pqActiveObjects::viewChanged, this, soon);
  pqServerManagerModel* model = serverManagerModel();
  this->connect(model, &pqServerManagerModel::sourceAdded, this, soon);
  this->connect(model, &pqServerManagerModel::sourceRemoved, this, soon);
  this->connect(model, &pqServerManagerModel::dataUpdated, this, soon);
  this->connect(model, &pqServerManagerModel::modifiedStateChanged, this, soon);
}

void Toolbar::follow(StrokeEditor* editor)
{
  if (editor != this->Editor)
  {
    if (this->Editor)
    {
      this->Editor->showBefore(false);
      this->Editor->disconnect(this);
    }
    this->Editor = editor;
    if (editor)
    {
      this->connect(editor, &StrokeEditor::changed, this, &Toolbar::refresh);
    }
  }
}

void Toolbar::refresh()
{
  pqPipelineSource* source = activeDeformation();
  const bool applied = source && source->modifiedState() != pqProxy::UNINITIALIZED;
  this->follow(applied ? StrokeEditor::of(source) : nullptr);
  const bool hasStrokes = this->Editor && !this->Editor->strokes().empty();
  for (int i = 0; i < this->Tools.size(); ++i)
  {
    this->Tools[i]->setEnabled(applied);
    this->Tools[i]->setChecked(toolTable()[i].tool == ToolSettings::instance()->tool());
  }
  this->Reset->setEnabled(hasStrokes);
  this->Compare->setEnabled(applied); // a base lattice bends without strokes
  this->Flickering->setEnabled(Flicker::isPossible());
  if (!applied)
  {
    ToolSettings::instance()->setTool(Tool::None);
  }
}
}
