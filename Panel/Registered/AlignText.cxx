// SPDX-License-Identifier: BSD-3-Clause
#include "Panel/Registered/AlignText.h"

#include "Interaction/Edits/AlignRun.h"

#include <QCoreApplication>

namespace brainshift
{
namespace
{
// As in brainshift.align of Python: tests start up to 20 mm and 15 degrees from the right place,
// and the middle of what is compared then moves a little farther than that of the reference.
constexpr double FarthestShift = 24.0; // mm
constexpr double FarthestTurn = 17.0;  // degrees

QString said(const char* text)
{
  return QCoreApplication::translate("BrainShift", text);
}

QString figure(double value, int digits)
{
  return QString::number(value, 'f', digits);
}

QString moved(const AlignFigures& figures)
{
  return said("The reference moved by %1 mm and %2 degrees. %3 % of the volume lies within it.")
    .arg(figure(figures.shift, 2), figure(figures.turn, 2), figure(100.0 * figures.compared, 0));
}
}

QString alignProgress(const AlignFigures& figures)
{
  return said("Step %1: mutual information %2 nats. ")
           .arg(QString::number(figures.lines), figure(figures.information, 3)) +
    moved(figures);
}

QString alignResult(const QString& ended, const AlignFigures& figures)
{
  return said("%1 after %2 steps. Mutual information: %3 nats before, %4 now (more is better). ")
           .arg(ended, QString::number(figures.lines), figure(figures.informationBefore, 3),
             figure(figures.information, 3)) +
    moved(figures);
}

QString alignWarning(const AlignFigures& figures)
{
  return figures.shift > FarthestShift || figures.turn > FarthestTurn
    ? said("Nobody has tested Align from more than 20 mm or 15 degrees away. Look whether the "
           "reference lies right.")
    : QString();
}
}
