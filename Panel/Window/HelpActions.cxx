// SPDX-License-Identifier: BSD-3-Clause
#include "Panel/Window/HelpActions.h"

#include "Interaction/Commands/Application.h"
#include "Interaction/Commands/Commands.h"
#include "Interaction/Commands/Tools.h"
#include "Panel/Window/Tutorial.h"

#include <pqCoreUtilities.h>

#include <QDialogButtonBox>
#include <QLabel>
#include <QStringList>
#include <QVBoxLayout>

namespace brainshift
{
namespace
{
constexpr Scope Scopes[] = { Scope::Window, Scope::Tool, Scope::View, Scope::Slices, Scope::List };

// The tools that a row needs; empty where it needs none.
QString toolsText(const CommandRow& row)
{
  QStringList names;
  for (const Tool tool : row.tools)
  {
    names.append(nameOf(tool));
  }
  return names.join(", ");
}

QString htmlRow(const CommandRow& row)
{
  const QString tools = toolsText(row);
  const QString before = tools.isEmpty() ? QString() : QString("<i>%1</i>: ").arg(tools);
  return QString("<tr><td style=\"white-space:nowrap\"><b>%1</b>&nbsp;&nbsp;&nbsp;</td>"
                 "<td>%2%3</td></tr>")
    .arg(keysText(row).toHtmlEscaped(), before, tr(row.what).toHtmlEscaped());
}

QString markdownRow(const CommandRow& row)
{
  const QString tools = toolsText(row);
  return QString("| %1 | %2 | %3 |\n")
    .arg(keysText(row), tools.isEmpty() ? QString("any or none") : tools, QString(row.what));
}
}

QString keysAsHtml()
{
  QString text = "<table>";
  for (const Scope scope : Scopes)
  {
    text += QString("<tr><td colspan=2 style=\"padding-top:12px\"><big><b>%1</b></big></td></tr>")
              .arg(headingOf(scope).toHtmlEscaped());
    if (!remarkOn(scope).isEmpty())
    {
      text += QString("<tr><td colspan=2>%1</td></tr>").arg(remarkOn(scope).toHtmlEscaped());
    }
    for (const CommandRow& row : commandTable())
    {
      text += row.scope == scope ? htmlRow(row) : QString();
    }
  }
  return text + "</table>";
}

QString keysAsMarkdown()
{
  QStringList sections;
  for (const Scope scope : Scopes)
  {
    QString section = QString("## %1\n\n").arg(headingOf(scope));
    if (!remarkOn(scope).isEmpty())
    {
      section += remarkOn(scope) + "\n\n";
    }
    section += "| key or gesture | tool | what it does |\n|---|---|---|\n";
    for (const CommandRow& row : commandTable())
    {
      section += row.scope == scope ? markdownRow(row) : QString();
    }
    sections.append(section);
  }
  return "# Mouse and keys\n\n" + sections.join("\n");
}

namespace
{
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
  QAction* tutorial = this->addAction(tr("BrainShift Tutorial"));
  tutorial->setObjectName("actionBrainShiftTutorial");
  tutorial->setToolTip(tr("Learn the tools in seven steps on a sample head."));
  this->connect(tutorial, &QAction::triggered, this, &Tutorial::begin);
  if (qEnvironmentVariableIsSet("BRAINSHIFT_NO_WELCOME")) // the launcher asks for both
  {
    keepWelcomeAway(this);
  }
  if (qEnvironmentVariableIsSet("BRAINSHIFT_TUTORIAL"))
  {
    QTimer::singleShot(0, this, &Tutorial::begin);
  }
  QAction* shortcuts = this->addAction(tr("BrainShift Mouse and Keys"));
  shortcuts->setObjectName("actionBrainShiftShortcuts");
  this->connect(shortcuts, &QAction::triggered, this, &HelpActions::showShortcuts);
  QAction* about = this->addAction(tr("About BrainShift"));
  about->setObjectName("actionBrainShiftAbout");
  this->connect(about, &QAction::triggered, this, &HelpActions::showAbout);
}

void HelpActions::showShortcuts()
{
  showText("BrainShiftShortcuts", tr("BrainShift: mouse and keys"), keysAsHtml());
}

void HelpActions::showAbout()
{
  showText("BrainShiftAbout", tr("About BrainShift"),
    tr("<h3>BrainShift %1</h3>"
       "<p>BrainShift deforms a medical volume by hand and shows the deformed volume live.</p>"
       "<p><b>Research software, not a medical device.</b> Do not use it for diagnosis or "
       "treatment.</p>"
       "<p>The method is based on S. van der Steen, H. J. Noordmans, R. Verdaasdonk, "
       "<i>Interactive brain shift "
       "compensation using GPU based programming</i>, Proc. SPIE 7169, 71691D (2009), "
       "<a href=\"https://doi.org/10.1117/12.808491\">doi:10.1117/12.808491</a>.</p>"
       "<p>BrainShift is free software under the BSD 3-Clause licence.</p>")
      .arg(BRAINSHIFT_VERSION));
}
}
