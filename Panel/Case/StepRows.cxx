// SPDX-License-Identifier: BSD-3-Clause
#include "Panel/Case/StepRows.h"

#include "Interaction/Commands/Application.h"
#include "Panel/Parts/Advice.h"

#include <QEvent>
#include <QGridLayout>
#include <QJsonArray>
#include <QJsonObject>
#include <QLabel>
#include <QPushButton>

#include <utility>

namespace brainshift
{
namespace
{
constexpr int RowGap = 3; // pixels between rows

enum StepColumn
{
  ButtonColumn,
  SignColumn,
  TextColumn
};

// Makes a label as high as its lines: a grid in a scroll area does not ask for that.
void fitHeight(QLabel* label)
{
  label->setMinimumHeight(0); // else the height for a width is at least the former one
  label->setMinimumHeight(label->heightForWidth(label->width()));
}

class Lines : public QLabel
{
public:
  Lines()
  {
    this->setWordWrap(true);
    this->setTextFormat(Qt::PlainText);
    this->setTextInteractionFlags(Qt::TextSelectableByMouse | Qt::TextSelectableByKeyboard);
  }

protected:
  void resizeEvent(QResizeEvent* event) override
  {
    QLabel::resizeEvent(event);
    fitHeight(this);
  }
};

struct Words
{
  QString label;
  QString tip;
};

// Of a step as Python calls it.
Words wordsOf(const QString& step)
{
  static const QMap<QString, Words> words{
    { "Look",
      { tr("Look"), tr("Show the bent volume with a preset, and the points on the cortex.") } },
    { "Measure",
      { tr("Measure"), tr("Show the distances of traces and electrodes to the cortex.") } },
    { "Fit",
      { tr("Fit"),
        tr("Bend the volume by traces, electrodes and landmarks. The fit then follows the "
           "roles.") } },
    { "By hand",
      { tr("By Hand"),
        tr("Take a tool in hand to bend the volume in the view. The panel Properties has the "
           "other tools and the list of strokes.") } },
    { "Refine", { tr("Refine"), tr("Bend the volume until it matches the reference.") } },
    { "Judge",
      { tr("Judge"),
        tr("Measure the errors at the landmarks: of those that the fit used, by leaving each "
           "out.") } },
    { "Export",
      { tr("Export..."),
        tr("Write the bent volume, its displacement field and the labels of the tumour into a "
           "folder.") } },
    { "Tumour left",
      { tr("Tumour Left"),
        tr("Measure how much tumour is left after the resection, and show it: removed "
           "tissue is cut away.") } },
    { "Report", { tr("Report..."), tr("Write a page with pictures and figures of the case.") } },
    { "Moments",
      { tr("Show Moments"),
        tr("Show the moments of the surgery as time steps. Play shows the way from moment to "
           "moment.") } },
  };
  return words[step];
}
}

StepRows::StepRows()
  : Grid(new QGridLayout(this))
{
  this->setObjectName("BrainShiftCaseSteps");
  this->Grid->setContentsMargins(0, 0, 0, 0);
  this->Grid->setVerticalSpacing(RowGap);
  this->Grid->setColumnStretch(TextColumn, 1);
  // Now, so that the key Tab comes to them in this order.
  for (const char* step : { "Look", "Measure", "Fit", "By hand", "Refine", "Judge", "Export",
         "Tumour left", "Report", "Moments" })
  {
    this->row(step);
  }
}

StepRows::Row& StepRows::row(const QString& step)
{
  Row& row = this->Rows[step];
  if (!row.button)
  {
    const int at = this->Grid->rowCount();
    row.button = new QPushButton(wordsOf(step).label);
    row.button->setObjectName("BrainShiftCase" + QString(step).remove(' '));
    row.button->setToolTip(wordsOf(step).tip);
    this->connect(
      row.button, &QPushButton::clicked, this, [this, step] { Q_EMIT this->pressed(step); });
    row.sign = new QLabel;
    row.text = new Lines;
    row.text->setObjectName(row.button->objectName() + "Text");
    this->Grid->addWidget(row.button, at, ButtonColumn, Qt::AlignTop);
    this->Grid->addWidget(row.sign, at, SignColumn, Qt::AlignTop);
    this->Grid->addWidget(row.text, at, TextColumn);
  }
  return row;
}

void StepRows::show(const QJsonArray& told)
{
  for (const QJsonValue step : told)
  {
    Row& row = this->row(step["name"].toString());
    const QString lacks = step["lacks"].toString();
    const bool isDone = step["state"].toString() == "done";
    row.button->setText(wordsOf(step["name"].toString()).label);
    row.button->setEnabled(lacks.isEmpty());
    const QString found = step["found"].toString(); // beside what is missing it says why to doubt
    row.isDoubtful = step["doubtful"].toBool();
    row.sign->setText(row.isDoubtful ? "!" : isDone ? QString(QChar(0x2713)) : QString());
    row.sign->setToolTip(
      row.isDoubtful ? StepRows::tr("Doubtful: read what it found.") : QString());
    row.text->setText(lacks.isEmpty()
        ? found
        : StepRows::tr("Needs %1").arg(lacks) + (found.isEmpty() ? QString() : ". " + found));
    row.lacks = !lacks.isEmpty();
    this->paint(row);
    fitHeight(row.text);
    row.button->setAccessibleDescription(row.text->text());
  }
}

// The text is not disabled where something is missing: then nobody could read what.
void StepRows::paint(const Row& row)
{
  QPalette palette = this->palette();
  const QColor quiet = quietColor(palette);
  const QColor found = palette.color(QPalette::WindowText);
  const Grade grade = row.isDoubtful ? Grade::Bad : Grade::Good;
  palette.setColor(QPalette::WindowText, gradeColor(grade, palette, false));
  row.sign->setPalette(palette);
  palette.setColor(QPalette::WindowText, row.lacks && !row.isDoubtful ? quiet : found);
  row.text->setPalette(palette);
}

void StepRows::changeEvent(QEvent* event)
{
  QWidget::changeEvent(event);
  if (event->type() == QEvent::PaletteChange)
  {
    for (const Row& row : std::as_const(this->Rows))
    {
      this->paint(row);
    }
  }
}

void StepRows::showInstead(const QString& step, const QString& text, const QString& button)
{
  Row& row = this->row(step);
  row.text->setText(text);
  row.lacks = false;
  this->paint(row);
  fitHeight(row.text);
  row.button->setAccessibleDescription(text);
  row.button->setText(button);
  row.button->setEnabled(true);
}
}
