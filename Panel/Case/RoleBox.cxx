// SPDX-License-Identifier: BSD-3-Clause
#include "Panel/Case/RoleBox.h"

#include "Panel/Parts/StillWheel.h"

#include <pqActiveObjects.h>
#include <pqCoreUtilities.h>
#include <pqFileDialog.h>

#include <QDragEnterEvent>
#include <QDropEvent>
#include <QJsonArray>
#include <QJsonObject>
#include <QKeyEvent>
#include <QMimeData>
#include <QSignalBlocker>
#include <QTimer>
#include <QUrl>

#include <algorithm>
#include <array>

namespace brainshift
{
namespace
{
// Entries that are no source: their data.
constexpr int FileEntry = -1;
constexpr int SphereEntry = -2;

constexpr int LeastLetters = 12;
}

QStringList pathsOf(const QMimeData* dragged)
{
  QStringList paths;
  for (const QUrl& url : dragged->urls())
  {
    if (url.isLocalFile())
    {
      paths.append(url.toLocalFile());
    }
  }
  return paths;
}

RoleBox::RoleBox(const QString& role)
  : Role(role)
{
  this->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  this->setMinimumContentsLength(LeastLetters);
  this->setAcceptDrops(true);
  keepStill(this);
  this->connect(this, &QComboBox::activated, this, &RoleBox::choose);
}

void RoleBox::show(const QJsonObject& told, bool sphere)
{
  const QSignalBlocker quiet(this);
  this->clear();
  this->addItem(QStringLiteral("\u2013"), 0);
  for (const QJsonValue choice : told["choices"].toArray())
  {
    this->addItem(choice[1].toString(), choice[0].toInt());
  }
  if (this->Role == "opening")
  {
    this->addItem(tr("Sphere"), SphereEntry);
  }
  this->insertSeparator(this->count());
  this->addItem(tr("Open File..."), FileEntry);
  this->Shown = this->findData(sphere ? SphereEntry : told["chosen"].toInt());
  this->setCurrentIndex(this->Shown);
}

void RoleBox::choose(int index)
{
  const int entry = this->itemData(index).toInt();
  if (entry == FileEntry)
  {
    this->setCurrentIndex(this->Shown); // until the file is read
    this->openFile();
  }
  else if (index != this->Shown)
  {
    entry == SphereEntry ? Q_EMIT this->sphereChosen() : Q_EMIT this->sourceChosen(entry);
  }
}

void RoleBox::openFile()
{
  pqFileDialog dialog(pqActiveObjects::instance().activeServer(), pqCoreUtilities::mainWidget(),
    tr("Open: %1").arg(this->accessibleName()));
  dialog.setObjectName("BrainShiftCaseFile");
  dialog.setFileMode(pqFileDialog::ExistingFile);
  if (dialog.exec() == QDialog::Accepted && !dialog.getSelectedFiles().isEmpty())
  {
    Q_EMIT this->fileChosen(dialog.getSelectedFiles().first());
  }
}

void RoleBox::dragEnterEvent(QDragEnterEvent* event)
{
  if (pathsOf(event->mimeData()).size() == 1)
  {
    event->acceptProposedAction();
  }
}

// Later: the program that the file comes from waits for the end of the drop.
void RoleBox::dropEvent(QDropEvent* event)
{
  event->acceptProposedAction();
  QTimer::singleShot(
    0, this, [this, path = pathsOf(event->mimeData()).first()] { Q_EMIT this->fileChosen(path); });
}

void RoleBox::keyPressEvent(QKeyEvent* event)
{
  constexpr std::array<int, 6> chooses{ Qt::Key_Up, Qt::Key_Down, Qt::Key_PageUp, Qt::Key_PageDown,
    Qt::Key_Home, Qt::Key_End };
  const bool isLetter = !event->text().isEmpty() && event->text().front().isPrint();
  if (isLetter || std::find(chooses.begin(), chooses.end(), event->key()) != chooses.end())
  {
    this->showPopup();
    return;
  }
  this->QComboBox::keyPressEvent(event);
}
}
