// SPDX-License-Identifier: BSD-3-Clause
// What the panel says about numbers, and in which colour.
#ifndef BrainShift_Advice_h
#define BrainShift_Advice_h

#include <QColor>
#include <QPalette>
#include <QString>

enum class Grade
{
  Good,
  Doubtful,
  Bad,
};

// Warning that control points `spacing` mm apart cannot follow a stroke of this radius (mm); empty
// if they can. `name` is the radius's, to begin the sentence with.
QString radiusAdvice(const QString& name, double radius, double spacing);

// Note that the guard against folding applies only a share, 0 to 1, of a stroke of so many mm;
// empty if it applies all of it.
QString guardAdvice(double amount, double share);

// The same of all strokes together; empty if none is shortened.
QString guardAdvice(int shortenedStrokes);

// Smallest Jacobian determinant: 1 keeps volume, 0 or less folds tissue.
Grade jacobianGrade(double determinant);
QString jacobianText(double determinant);

// Green, amber or red that reads on the palette's window colour, be it light or dark.
QColor gradeColor(Grade grade, const QPalette& palette);

#endif
