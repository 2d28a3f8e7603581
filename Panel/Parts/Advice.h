// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Advice about figures, in words and colours.
#ifndef BrainShift_Advice_h
#define BrainShift_Advice_h

#include <QColor>
#include <QPalette>
#include <QString>

namespace brainshift
{
/// How good a number is.
enum class Grade
{
  Good,
  Doubtful,
  Bad,
};

/// Warns that control points `spacing` mm apart cannot follow a stroke of this radius (mm). Empty
/// if they can. The sentence begins with `name`, the name of the radius.
QString radiusAdvice(const QString& name, double radius, double spacing);

/// Notes that the guard against folding applies only a fraction (0 to 1) of a stroke of `amount`
/// mm. Empty if it applies the whole stroke.
QString guardAdvice(double amount, double share);

/// Warns that the tissue at the centre of a stroke of `amount` mm went less than 80 % of that.
/// Empty if it went further.
QString reachAdvice(double amount, double reached);

/// Notes how many strokes the guard against folding shortens. Empty if it shortens none.
QString guardAdvice(int shortenedStrokes);

/// Grades the smallest Jacobian determinant: 1 keeps the volume of tissue, 0 or less folds it.
Grade jacobianGrade(double determinant);
/// The squeezing of the most squeezed tissue, in words: its remaining volume in percent.
QString jacobianText(double determinant);
/// Explains the percentages, and gives the determinant.
QString jacobianTip(double determinant);

/// A colour that is legible on the window colour of a palette, light or dark: green, amber or red,
/// or else blue, the colour of text, or orange.
QColor gradeColor(Grade grade, const QPalette& palette, bool blueAndOrange);
/// A colour for text that matters less. Unlike that of disabled text it is legible.
QColor quietColor(const QPalette& palette);
}

#endif
