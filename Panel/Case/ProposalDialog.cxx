// SPDX-License-Identifier: BSD-3-Clause
#include "Panel/Case/ProposalDialog.h"

#include "Panel/Parts/StillWheel.h"

#include <QComboBox>
#include <QDialogButtonBox>
#include <QFileInfo>
#include <QHeaderView>
#include <QJsonArray>
#include <QLabel>
#include <QPushButton>
#include <QStringList>
#include <QTableWidget>
#include <QVBoxLayout>

namespace brainshift
{
namespace
{
enum Column
{
  FileColumn,
  RoleColumn,
  ReasonColumn,
  Columns
};

constexpr int DialogLetters = 96; // wide
constexpr int DialogLines = 22;   // high

QTableWidgetItem* textItem(const QString& text, const QString& tip)
{
  auto item = new QTableWidgetItem(text);
  item->setFlags(Qt::ItemIsEnabled | Qt::ItemIsSelectable);
  item->setToolTip(tip);
  return item;
}

QComboBox* boxOf(const QTableWidget* table, int row)
{
  return qobject_cast<QComboBox*>(table->cellWidget(row, RoleColumn));
}
}

ProposalDialog::ProposalDialog(QWidget* parent, const QJsonArray& proposal, const QJsonArray& roles)
  : QDialog(parent)
{
  this->setObjectName("BrainShiftProposal");
  this->setWindowTitle(tr("Files of the case"));
  auto layout = new QVBoxLayout(this);
  auto text = new QLabel(tr("Each file gets the role that its name or content suggests. Correct "
                            "what is wrong. A case that has a volume stays; the files then begin "
                            "another."));
  text->setWordWrap(true);
  layout->addWidget(text);
  this->Table = new QTableWidget(static_cast<int>(proposal.size()), Columns);
  this->Table->setObjectName("BrainShiftProposalTable");
  this->Table->setHorizontalHeaderLabels({ tr("File"), tr("Role"), tr("Why") });
  this->Table->verticalHeader()->hide();
  this->Table->setWordWrap(true);
  this->Table->setTabKeyNavigation(false);
  layout->addWidget(this->Table, 1);
  for (int row = 0; row < proposal.size(); ++row)
  {
    const QString path = proposal[row][1].toString();
    this->Table->setItem(row, FileColumn, textItem(QFileInfo(path).fileName(), path));
    this->Table->item(row, FileColumn)->setData(Qt::UserRole, path);
    const QString reason = proposal[row][2].toString();
    this->Table->setItem(row, ReasonColumn, textItem(reason, reason));
    auto box = new QComboBox;
    box->setObjectName(QString("BrainShiftProposal%1").arg(row));
    box->setAccessibleName(tr("Role of %1").arg(QFileInfo(path).fileName()));
    keepStill(box);
    box->addItem(tr("None"), QString());
    for (const QJsonValue role : roles)
    {
      box->addItem(role["label"].toString(), role["role"].toString());
    }
    box->setCurrentIndex(box->findData(proposal[row][0].toString()));
    this->connect(box, &QComboBox::currentIndexChanged, this, &ProposalDialog::judge);
    this->Table->setCellWidget(row, RoleColumn, box);
  }
  this->Table->resizeColumnsToContents();
  QHeaderView* header = this->Table->horizontalHeader();
  header->setSectionResizeMode(ReasonColumn, QHeaderView::Stretch); // a long one takes more lines
  this->connect(
    header, &QHeaderView::sectionResized, this->Table, &QTableWidget::resizeRowsToContents);
  this->Problem = new QLabel;
  this->Problem->setObjectName("BrainShiftProposalProblem");
  this->Problem->setWordWrap(true);
  layout->addWidget(this->Problem);
  this->Buttons = new QDialogButtonBox(QDialogButtonBox::Ok | QDialogButtonBox::Cancel);
  this->Buttons->button(QDialogButtonBox::Ok)->setObjectName("BrainShiftProposalOk");
  this->Buttons->button(QDialogButtonBox::Cancel)->setObjectName("BrainShiftProposalCancel");
  this->connect(this->Buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
  this->connect(this->Buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  layout->addWidget(this->Buttons);
  this->resize(DialogLetters * this->fontMetrics().averageCharWidth(),
    DialogLines * this->fontMetrics().height());
  this->judge();
}

QJsonObject ProposalDialog::accepted() const
{
  QJsonObject files;
  for (int row = 0; row < this->Table->rowCount(); ++row)
  {
    const QString role = boxOf(this->Table, row)->currentData().toString();
    if (!role.isEmpty())
    {
      files[role] = this->Table->item(row, FileColumn)->data(Qt::UserRole).toString();
    }
  }
  return files;
}

void ProposalDialog::judge()
{
  QStringList given;
  QStringList twice;
  for (int row = 0; row < this->Table->rowCount(); ++row)
  {
    const QComboBox* box = boxOf(this->Table, row);
    const QString role = box ? box->currentData().toString() : QString();
    if (!role.isEmpty() && given.contains(role))
    {
      twice.append(box->currentText());
    }
    given.append(role);
  }
  twice.removeDuplicates();
  this->Problem->setText(twice.isEmpty()
      ? QString()
      : tr("Two files have the role %1. Give one of them another.").arg(twice.join(", ")));
  this->Buttons->button(QDialogButtonBox::Ok)->setEnabled(twice.isEmpty());
}
}
