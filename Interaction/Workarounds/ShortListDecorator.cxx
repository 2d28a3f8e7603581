// SPDX-License-Identifier: BSD-3-Clause
#include "Interaction/Workarounds/ShortListDecorator.h"

#include <pqPropertyWidget.h>

#include <QAbstractItemView>
#include <QComboBox>

#include <algorithm>

namespace brainshift
{
namespace
{
constexpr int ShortestLetters = 12; // of the text that stays in sight

void showAllOf(QComboBox* list)
{
  list->setToolTip(list->currentText());
  int width = 0;
  for (int i = 0; i < list->count(); ++i)
  {
    width = std::max(width, list->fontMetrics().horizontalAdvance(list->itemText(i)));
  }
  constexpr int FramePixels = 40; // of the opened list, with its bar
  list->view()->setMinimumWidth(width + FramePixels);
}
}

ShortListDecorator::ShortListDecorator(vtkPVXMLElement* xml, pqPropertyWidget* parent)
  : pqPropertyWidgetDecorator(xml, parent)
{
  for (QComboBox* list : parent->findChildren<QComboBox*>())
  {
    list->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    list->setMinimumContentsLength(ShortestLetters);
    this->connect(list, &QComboBox::currentTextChanged, list, [list] { showAllOf(list); });
    showAllOf(list);
  }
}
}
