// SPDX-License-Identifier: BSD-3-Clause
#include "HelpActions.h"

#include "ToolChoice.h"

#include <pqCoreUtilities.h>

#include <QDialog>
#include <QDialogButtonBox>
#include <QLabel>
#include <QVBoxLayout>

namespace
{
struct Shortcut
{
  QString keys;
  const char* what;
};

QString heading(const QString& text)
{
  return QString("<tr><td colspan=2 style=\"padding-top:12px\"><big><b>%1</b></big></td></tr>")
    .arg(text.toHtmlEscaped());
}

QString row(const QString& keys, const QString& what)
{
  return QString("<tr><td><b>%1</b>&nbsp;&nbsp;&nbsp;</td><td>%2</td></tr>")
    .arg(keys.toHtmlEscaped(), what.toHtmlEscaped());
}

// Not modal, so that it can be read beside the work.
void showText(const QString& name, const QString& title, const QString& text)
{
  QWidget* window = pqCoreUtilities::mainWidget();
  delete window->findChild<QDialog*>(name, Qt::FindDirectChildrenOnly);
  auto dialog = new QDialog(window);
  dialog->setObjectName(name);
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setWindowTitle(title);
  auto label = new QLabel(text, dialog);
  label->setObjectName("text");
  label->setWordWrap(true);
  label->setMinimumWidth(dialog->fontMetrics().averageCharWidth() * 70);
  label->setTextInteractionFlags(Qt::TextBrowserInteraction);
  label->setOpenExternalLinks(true);
  auto buttons = new QDialogButtonBox(QDialogButtonBox::Close, dialog);
  QObject::connect(buttons, &QDialogButtonBox::rejected, dialog, &QDialog::close);
  auto column = new QVBoxLayout(dialog);
  column->addWidget(label);
  column->addWidget(buttons);
  dialog->show();
}
}

HelpActions::HelpActions(QObject* parent)
  : QActionGroup(parent)
{
  QAction* shortcuts = this->addAction(tr("BrainShift Mouse and Keys"));
  shortcuts->setObjectName("actionBrainShiftShortcuts");
  this->connect(shortcuts, &QAction::triggered, this, &HelpActions::showShortcuts);
  QAction* about = this->addAction(tr("About BrainShift"));
  about->setObjectName("actionBrainShiftAbout");
  this->connect(about, &QAction::triggered, this, &HelpActions::showAbout);
}

void HelpActions::showShortcuts()
{
  const Shortcut inView[] = {
    { tr("Drag"), QT_TR_NOOP("Move, Soft: moves tissue. Stamp: pulls and pushes along its axis") },
    { tr("Wheel over tissue"), QT_TR_NOOP("Stamp: pulls and pushes by the millimetres per click") },
    { tr("Over a slice"), QT_TR_NOOP("All of this stays within the slice") },
    { tr("Shift+Wheel"), QT_TR_NOOP("Soft: the radius. Stamp: the major radius") },
    { tr("Shift+Click"), QT_TR_NOOP("Move: one control point more, or one less") },
    { tr("X, Y, Z"), QT_TR_NOOP("While dragging: holds the drag to that axis; again: lets go") },
    { tr("I"), QT_TR_NOOP("Stamp: the point of interest is the tissue under the cursor") },
    { tr("Escape"), QT_TR_NOOP("Gives up what is under the hand") },
    { tr("K"), QT_TR_NOOP("Compare Volumes: deformed volume and reference in turn; again: ends") },
  };
  const Shortcut withoutTool[] = {
    { tr("O"), QT_TR_NOOP("Shows the volume as loaded for as long as it is held down") },
    { tr("Wheel, Page Up, Page Down"), QT_TR_NOOP("2D view of slices: the next slice") },
    { tr("Shift+Drag"), QT_TR_NOOP("2D view of slices: brings the other slices to the cursor") },
    { tr("Ctrl+Wheel"), QT_TR_NOOP("2D view of slices: zooms") },
  };
  const Shortcut inList[] = {
    { tr("Space"), QT_TR_NOOP("Disables or enables the selected strokes") },
    { tr("Left, Right, Enter"), QT_TR_NOOP("Choose a number of the stroke and change it") },
    { tr("Delete"), QT_TR_NOOP("Deletes the selected strokes") },
    { tr("Ctrl+Z, Ctrl+Y"), QT_TR_NOOP("Undo and redo, one edit a step, here and in the view") },
  };
  QString text = "<table>" + heading(tr("Tools"));
  for (const ToolChoice& choice : toolChoices())
  {
    text += row(choice.shortcut.toString(QKeySequence::NativeText), choice.what);
  }
  text += heading(tr("In the view, with a tool in hand"));
  for (const Shortcut& shortcut : inView)
  {
    text += row(shortcut.keys, tr(shortcut.what));
  }
  text += heading(tr("In the view, also without a tool"));
  for (const Shortcut& shortcut : withoutTool)
  {
    text += row(shortcut.keys, tr(shortcut.what));
  }
  text += heading(tr("In the list of strokes"));
  for (const Shortcut& shortcut : inList)
  {
    text += row(shortcut.keys, tr(shortcut.what));
  }
  showText("BrainShiftShortcuts", tr("BrainShift: mouse and keys"), text + "</table>");
}

void HelpActions::showAbout()
{
  showText("BrainShiftAbout", tr("About BrainShift"),
    tr("<h3>BrainShift %1</h3>"
       "<p>Bends a medical volume by hand and draws it bent, live.</p>"
       "<p><b>Research software, not a medical device.</b> Do not use it to treat or diagnose.</p>"
       "<p>After S. van der Steen, H. J. Noordmans, R. Verdaasdonk, <i>Interactive brain shift "
       "compensation using GPU based programming</i>, Proc. SPIE 7169, 71691D (2009), "
       "<a href=\"https://doi.org/10.1117/12.808491\">doi:10.1117/12.808491</a>.</p>"
       "<p>BSD-3-Clause licence.</p>")
      .arg(BRAINSHIFT_VERSION));
}
