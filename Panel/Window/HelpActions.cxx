// SPDX-License-Identifier: BSD-3-Clause
#include "Panel/Window/HelpActions.h"

#include "Panel/Window/KeysText.h"
#include "Panel/Window/Tutorial.h"

#include <pqCoreUtilities.h>

#include <QDialogButtonBox>
#include <QLabel>
#include <QVBoxLayout>

namespace brainshift
{
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
