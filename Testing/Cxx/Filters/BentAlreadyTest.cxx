// SPDX-License-Identifier: BSD-3-Clause
// Proves that a deformation is never dropped without a word: a volume that carries one is not bent
// again, and a displacement field carries none.
#include "Common/FieldDirection.h"
#include "Common/Problem.h"
#include "Testing/Cxx/Filters/TestPipeline.h"

#include <gtest/gtest.h>

#include <string>

using namespace brainshift;
using namespace brainshift::testing;

namespace
{
class BentAlready : public ::testing::Test
{
protected:
  const Grid VolumeGrid = obliqueGrid({ 21, 16, 13 });
  vtkSmartPointer<vtkImageData> Volume =
    volumeOn(VolumeGrid, VTK_SHORT, [](vtkIdType i) { return double(i % 100); });
  vtkNew<vtkFreeFormDeformation> First;
  vtkNew<vtkFreeFormDeformation> Second;
  Errors Heard{ Second };

  void SetUp() override
  {
    this->First->SetInputData(this->Volume);
    const Stroke stroke =
      strokeAt(Tool::Stamp, this->VolumeGrid.worldFromGrid({ 10, 8, 6 }), { 4.0, -3.0, 6.0 });
    setStrokes(this->First, { stroke });
    setStrokes(this->Second, { stroke, stroke });
    this->First->Update();
  }
  vtkImageData* bent() { return vtkImageData::SafeDownCast(this->First->GetOutputDataObject(0)); }
  vtkImageData* output()
  {
    this->Second->Update();
    return vtkImageData::SafeDownCast(this->Second->GetOutputDataObject(0));
  }
};
}

TEST_F(BentAlready, TheFirstDeformationStaysAndAnErrorSaysSo)
{
  this->Second->SetInputConnection(this->First->GetOutputPort());
  const Deformation kept = deformationOf(this->output());
  EXPECT_EQ(kept.lattice.displacements, deformationOf(this->bent()).lattice.displacements);
  const std::string error = this->Heard.take();
  for (const char* word : { "already carries a deformation", "Bake Deformation" })
  {
    EXPECT_NE(error.find(word), std::string::npos) << '"' << error << "\" lacks " << word;
  }
  this->Second->SetInputData(this->Volume);
  this->Second->Update();
  EXPECT_EQ(this->Heard.take(), "") << "an unbent volume is bent as ever";
}

TEST_F(BentAlready, AFieldThatKeptTheArraysIsNoDeformableVolume)
{
  vtkNew<vtkImageData> saved; // what earlier releases wrote
  saved->ShallowCopy(this->bent());
  nameDirection(saved, Direction::Forward);
  EXPECT_FALSE(carriesDeformation(saved));
  EXPECT_THROW(readDeformation(saved), Problem);
  this->Second->SetInputData(saved);
  EXPECT_TRUE(carriesDeformation(this->output())) << "a field is bent like any other volume";
  EXPECT_EQ(this->Heard.take(), "");
}
