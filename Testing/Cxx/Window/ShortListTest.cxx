// SPDX-License-Identifier: BSD-3-Clause
// Proves that a list with long texts, such as that of DICOM series, does not widen the panel, and
// that its texts can be read all the same.
#include "Interaction/Workarounds/ShortListDecorator.h"
#include "Testing/Cxx/Window/Application.h"

#include <pqPropertyWidget.h>

#include <vtkNew.h>
#include <vtkPVXMLElement.h>
#include <vtkSMProxy.h>

#include <QAbstractItemView>
#include <QComboBox>
#include <QHBoxLayout>

#include <gtest/gtest.h>

#include <memory>

namespace
{
const QString Short = "3, T1";
const QString Long = "801, a description of the series that is far longer than the panel is wide, "
                     "MR, 512 x 512 x 320, 2026-11-23, ORIGINAL PRIMARY M";

class ShortList : public testing::Test
{
protected:
  ShortList()
  {
    brainshift::application();
    this->Widget = std::make_unique<pqPropertyWidget>(this->Proxy.Get());
    this->List = new QComboBox(this->Widget.get());
    this->List->addItems({ Short, Long });
    (new QHBoxLayout(this->Widget.get()))->addWidget(this->List);
  }

  int textWidth() const { return this->List->fontMetrics().horizontalAdvance(Long); }

  void decorate()
  {
    vtkNew<vtkPVXMLElement> xml;
    new brainshift::ShortListDecorator(xml, this->Widget.get()); // the widget owns it
  }

  vtkNew<vtkSMProxy> Proxy;
  std::unique_ptr<pqPropertyWidget> Widget;
  QComboBox* List = nullptr;
};
}

TEST_F(ShortList, WouldWidenThePanel)
{
  EXPECT_GT(this->List->minimumSizeHint().width(), this->textWidth());
}

TEST_F(ShortList, DoesNotWidenThePanel)
{
  this->decorate();
  EXPECT_LT(this->List->minimumSizeHint().width(), this->textWidth() / 3);
}

TEST_F(ShortList, OpensAsWideAsItsTexts)
{
  this->decorate();
  EXPECT_GE(this->List->view()->minimumWidth(), this->textWidth());
}

TEST_F(ShortList, TellsTheWholeTextThatIsChosen)
{
  this->decorate();
  EXPECT_EQ(this->List->toolTip(), Short);
  this->List->setCurrentIndex(1);
  EXPECT_EQ(this->List->toolTip(), Long);
}
