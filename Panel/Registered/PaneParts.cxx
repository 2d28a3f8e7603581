// SPDX-License-Identifier: BSD-3-Clause
#include "Panel/Registered/PaneParts.h"

#include <QLabel>
#include <QToolButton>

namespace brainshift
{
QToolButton* makeButton(const char* name, const QString& text, const QString& tip)
{
  auto button = new QToolButton;
  button->setObjectName(name);
  button->setText(text);
  button->setToolTip(tip);
  button->setFocusPolicy(Qt::TabFocus); // a click leaves the keyboard where it is
  return button;
}

QLabel* makeText(const char* name)
{
  auto text = new QLabel;
  text->setObjectName(name);
  text->setWordWrap(true);
  text->setTextInteractionFlags(Qt::TextSelectableByMouse | Qt::TextSelectableByKeyboard);
  text->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Minimum);
  return text;
}
}
