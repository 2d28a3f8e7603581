// SPDX-License-Identifier: BSD-3-Clause
#include "Panel/Parts/SoftHighlight.h"

#include <QGuiApplication>
#include <QPalette>
#include <QWidget>

namespace brainshift
{
void softenHighlight(QWidget* list)
{
  constexpr double share = 0.35; // of the theme's highlight
  const QPalette theme = QGuiApplication::palette();
  const QColor strong = theme.color(QPalette::Highlight);
  const QColor base = theme.color(QPalette::Base);
  const auto mixed = [](int part, int rest) { return int(share * part + (1.0 - share) * rest); };
  QPalette soft;
  soft.setColor(QPalette::Highlight,
    QColor(mixed(strong.red(), base.red()), mixed(strong.green(), base.green()),
      mixed(strong.blue(), base.blue())));
  soft.setColor(QPalette::HighlightedText, theme.color(QPalette::Text));
  list->setPalette(soft);
}
}
