// SPDX-License-Identifier: BSD-3-Clause
// The pipeline browser, the session and the dialogs of ParaView's window, for test_hand.py.
#include "TestHandExport.h"

#include <pqApplicationCore.h>
#include <pqDeleteReaction.h>
#include <pqObjectBuilder.h>
#include <pqOutputPort.h>
#include <pqPipelineBrowserWidget.h>
#include <pqPipelineModel.h>
#include <pqPipelineSource.h>
#include <pqSelectReaderDialog.h>
#include <pqServerDisconnectReaction.h>
#include <pqServerManagerModel.h>
#include <pqUndoStack.h>
#include <pqView.h>

#include <vtkSMProxy.h>

#include <QAbstractItemModel>
#include <QApplication>
#include <QByteArray>
#include <QDialog>
#include <QItemSelectionModel>
#include <QMessageBox>
#include <QPointer>
#include <QStringList>
#include <QTimer>

namespace
{
pqPipelineBrowserWidget* browser()
{
  for (QWidget* widget : QApplication::allWidgets())
  {
    if (auto found = qobject_cast<pqPipelineBrowserWidget*>(widget))
    {
      return found;
    }
  }
  return nullptr;
}

// The row of a source in the browser, by its proxy's number; invalid if there is none.
QModelIndex rowOf(pqPipelineBrowserWidget* list, unsigned int id, const QModelIndex& parent = {})
{
  QAbstractItemModel* model = list->getSelectionModel()->model();
  for (int row = 0; row < model->rowCount(parent); ++row)
  {
    const QModelIndex index = model->index(row, 0, parent);
    auto item = qobject_cast<pqProxy*>(
      list->getPipelineModel(index)->getItemFor(list->pipelineModelIndex(index)));
    if (item && item->getProxy()->GetGlobalID() == id)
    {
      return index;
    }
    const QModelIndex below = rowOf(list, id, index);
    if (below.isValid())
    {
      return below;
    }
  }
  return {};
}

pqOutputPort* portOf(unsigned int id)
{
  auto model = pqApplicationCore::instance()->getServerManagerModel();
  for (pqPipelineSource* source : model->findItems<pqPipelineSource*>())
  {
    if (source->getProxy()->GetGlobalID() == id)
    {
      return source->getOutputPort(0);
    }
  }
  return nullptr;
}

QStringList closedDialogs;

// Where ParaView has a reader of its own for a file, it asks which to use. Ours stands first and is
// chosen. Whether it asked.
bool chooseReader(QWidget* modal)
{
  auto dialog = qobject_cast<pqSelectReaderDialog*>(modal);
  if (dialog)
  {
    dialog->accept();
  }
  return dialog != nullptr;
}

// A dialog would wait for ever: its words are kept, and it is sent away.
void sendAway()
{
  static QPointer<QWidget> seen;
  QWidget* modal = QApplication::activeModalWidget();
  if (modal && modal == seen && !chooseReader(modal))
  {
    auto box = qobject_cast<QMessageBox*>(modal);
    closedDialogs.append(modal->windowTitle() + ": " +
      (box ? box->text() : QString(modal->metaObject()->className())).simplified());
    auto dialog = qobject_cast<QDialog*>(modal);
    dialog ? dialog->reject() : static_cast<void>(modal->close());
  }
  seen = modal;
}
}

// Clicks the name of a source in the pipeline browser, by its proxy's number. Returns whether it is
// there.
TEST_HAND_EXPORT int test_hand_select(unsigned int source)
{
  pqPipelineBrowserWidget* list = browser();
  const QModelIndex row = list ? rowOf(list, source) : QModelIndex();
  if (row.isValid())
  {
    list->getSelectionModel()->setCurrentIndex(
      row, QItemSelectionModel::ClearAndSelect | QItemSelectionModel::Rows);
  }
  return row.isValid() ? 1 : 0;
}

// Clicks its eye.
TEST_HAND_EXPORT int test_hand_eye(unsigned int source)
{
  pqPipelineBrowserWidget* list = browser();
  const QModelIndex row = list ? rowOf(list, source) : QModelIndex();
  const QModelIndex eye = row.isValid() ? row.sibling(row.row(), 1) : row;
  return eye.isValid() &&
      QMetaObject::invokeMethod(list, "handleIndexClicked", Q_ARG(QModelIndex, eye))
    ? 1
    : 0;
}

// As Edit > Delete does with what is selected, and Edit > Delete Downstream Chain with all that is
// made of it, too.
TEST_HAND_EXPORT void test_hand_delete(int downstream)
{
  downstream ? pqDeleteReaction::deleteTree() : pqDeleteReaction::deleteSelected();
}

// As Edit > Reset Session does, once its question is answered.
TEST_HAND_EXPORT void test_hand_reset_session()
{
  pqServerDisconnectReaction::disconnectFromServer();
}

// Makes a filter of two sources, by their proxies' numbers, as the menu does once its dialog has
// been answered. `name`: in XML; `input`: the property that takes the other source.
TEST_HAND_EXPORT void test_hand_create_filter_of_two(
  const char* name, unsigned int source, const char* input, unsigned int other)
{
  pqOutputPort* first = portOf(source);
  pqOutputPort* second = portOf(other);
  if (first && second)
  {
    SCOPED_UNDO_SET("Create filter");
    pqApplicationCore::instance()->getObjectBuilder()->createFilter(
      "filters", name, { { "Input", { first } }, { input, { second } } }, first->getServer());
  }
}

// From now on dialogs that stay are sent away, as Escape does, but for the choice of a reader.
TEST_HAND_EXPORT void test_hand_send_dialogs_away()
{
  static QTimer* timer = nullptr;
  if (!timer)
  {
    constexpr int interval = 300; // ms
    timer = new QTimer(qApp);
    QObject::connect(timer, &QTimer::timeout, timer, sendAway);
    timer->start(interval);
  }
}

// What they said since the last call, one line each. Holds until the next call.
TEST_HAND_EXPORT const char* test_hand_dialogs()
{
  static QByteArray text;
  text = closedDialogs.join('\n').toUtf8();
  closedDialogs.clear();
  return text.constData();
}

// The proxies' numbers of all views that are seen, with blanks between. Holds until the next call.
TEST_HAND_EXPORT const char* test_hand_seen_views()
{
  static QByteArray text;
  QStringList numbers;
  for (pqView* view : pqApplicationCore::instance()->getServerManagerModel()->findItems<pqView*>())
  {
    if (view->widget() && view->widget()->isVisible())
    {
      numbers.append(QString::number(view->getProxy()->GetGlobalID()));
    }
  }
  text = numbers.join(' ').toUtf8();
  return text.constData();
}
