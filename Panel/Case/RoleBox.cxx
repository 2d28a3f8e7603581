// SPDX-License-Identifier: BSD-3-Clause
#include "Panel/Case/RoleBox.h"

#include <pqActiveObjects.h>
#include <pqCoreUtilities.h>
#include <pqFileDialog.h>

#include <QDragEnterEvent>
#include <QDropEvent>
#include <QJsonArray>
#include <QJsonObject>
#include <QMimeData>
#include <QSignalBlocker>
#include <QUrl>
#include <QWheelEvent>

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
  this->setFocusPolicy(Qt::StrongFocus);
  this->setAcceptDrops(true);
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
  if (entry != FileEntry)
  {
    entry == SphereEntry ? Q_EMIT this->sphereChosen() : Q_EMIT this->sourceChosen(entry);
    return;
  }
  this->setCurrentIndex(this->Shown); // until the file is read
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

void RoleBox::dropEvent(QDropEvent* event)
{
  event->acceptProposedAction();
  Q_EMIT this->fileChosen(pathsOf(event->mimeData()).first());
}

// A turn of the wheel over the dock scrolls the dock; it must not give a role away.
void RoleBox::wheelEvent(QWheelEvent* event)
{
  event->ignore();
}
}
