// SPDX-License-Identifier: BSD-3-Clause
// Proves that the shaders find tissue where the deformation puts it, to the 0.05 mm of the design,
// number by number.
#include "Filters/Deformation/Kernels.h"
#include "Filters/Deformation/MaskWeights.h"
#include "Representations/Field/FieldTexture.h"
#include "Representations/Gpu/Program.h"
#include "Representations/Gpu/VolumePass.h"
#include "Representations/Scene/RayCastScene.h"
#include "Testing/Cxx/Representations/TestFieldRequest.h"
#include "Testing/Cxx/Representations/TestFineCells.h"
#include "Testing/Cxx/Representations/TestWindow.h"

#include <vtkShaderProgram.h>
#include <vtkSmartPointer.h>
#include <vtkTextureObject.h>

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

using namespace brainshift;
using namespace brainshift::testing;

namespace
{
constexpr int Places = 61; // a side; it shares no factor with the nodes
// From the same evaluation in C++. llvmpipe comes within 0.01 mm. Cards interpolate with fractions
// of eight bits: 1/512 of the difference between two nodes; an H200 came within 0.029 mm.
constexpr double CardMm = 0.04;

std::string shader(const std::string& name)
{
  std::ifstream file(std::string(BRAINSHIFT_SOURCE_DIR) + "/Shaders/" + name);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

// A program that asks field.glsl for offsets at places all over a box.
ShaderSource askingSource()
{
  ShaderSource source = invertSource();
  source.fragment = "//VTK::System::Dec\n//VTK::Output::Dec\n#define DEFORMED\n" + fieldDefines() +
    "#define PLACES " + std::to_string(Places) + ".0\n" + shader("Field/volume_pass.glsl") +
    shader("Rays/rays.glsl") + shader("Field/field.glsl") +
    "uniform vec3 askedLow;\nuniform vec3 askedHigh;\n"
    "void main()\n{\n"
    "  vec3 position = mix(askedLow, askedHigh, targetTexel() / (PLACES - 1.0));\n"
    "  gl_FragData[0] = vec4(offsetAt(position), 1.0);\n}\n";
  return source;
}

// A field on the GPU, as a picture's shaders read it.
class FineDrawing : public ::testing::Test
{
protected:
  ~FineDrawing() override { this->Field.releaseGraphicsResources(this->Shown.window()); }

  void update(const Lattice& lattice, Inverse inverse = Inverse::Exact)
  {
    this->Request = requestFor(lattice, FineSamples, inverse);
    this->Request.offsetScale = { 0.05f, 0.06f, 0.07f };
    ASSERT_TRUE(this->Field.update(this->Shown.window(), this->Request, this->Count));
  }

  void correct(const CorrectedField& known)
  {
    Accuracy accuracy;
    accuracy.map = &known.map;
    accuracy.mmFromCell = known.spacing;
    accuracy.allowedMm = AllowedMm;
    ASSERT_TRUE(this->Field.correct(this->Shown.window(), accuracy, this->Count));
  }

  // Offsets (lattice cells) between two nodes, x fastest.
  std::vector<glm::vec3> ask(const glm::vec3& low, const glm::vec3& high)
  {
    SceneField scene;
    scene.offsets = this->Field.offsets();
    scene.corrections.codes = this->Field.fine().codes();
    scene.corrections.values = this->Field.fine().corrections();
    scene.latticeFromTexture = 1.0 / glm::dvec3(this->Request.offsetScale);
    vtkOpenGLRenderWindow* window = this->Shown.window();
    EXPECT_TRUE(this->Asking.use(window, askingSource(), this->Count));
    setFieldUniforms(this->Asking, scene);
    const glm::vec3 nodes(this->Request.nodes.count);
    this->Asking.set("askedLow", (low + 0.5f) / nodes);
    this->Asking.set("askedHigh", (high + 0.5f) / nodes);
    auto target = vtkSmartPointer<vtkTextureObject>::New();
    target->SetContext(window);
    EXPECT_TRUE(target->Allocate3D(Places, Places, Places, 4, VTK_FLOAT));
    runVolumePass(
      window, this->Asking.get()->GetHandle(), { target }, glm::ivec3(0), glm::ivec3(Places));
    deactivateField(scene);
    std::vector<glm::vec3> offsets;
    for (const glm::vec4& texel : readVolume(window, target, glm::ivec3(0), glm::ivec3(Places)))
    {
      offsets.push_back(glm::vec3(texel) / this->Request.offsetScale);
    }
    target->ReleaseGraphicsResources(window);
    return offsets;
  }

  // The largest miss among places where tissue moves, and the largest difference from the same
  // evaluation in C++; mm.
  std::pair<double, double> missAndDifference(const CorrectedField& known)
  {
    const glm::vec3 low = glm::vec3(known.moved.first) + 0.013f;
    const glm::vec3 high = glm::vec3(known.moved.last) - 0.017f;
    const std::vector<glm::vec3> drawn = this->ask(low, high);
    double miss = 0.0;
    double difference = 0.0;
    std::size_t place = 0;
    forEachIndex(glm::ivec3(0), glm::ivec3(Places - 1), [&](const glm::ivec3& at) {
      const glm::vec3 node = glm::mix(low, high, glm::vec3(at) / static_cast<float>(Places - 1));
      miss = std::max(miss, known.missAt(node, drawn[place]));
      difference = std::max(
        difference, double(glm::length((known.drawnAt(node) - drawn[place]) * known.spacing)));
      ++place;
    });
    return { miss, difference };
  }

  TestWindow Shown;
  FieldTexture Field;
  FieldRequest Request;
  Program Asking;
  Counters Count;
};
}

TEST_F(FineDrawing, PutsTissueWhereTheDeformationSays)
{
  for (const int kernel : { KernelCatmullRom, KernelBSpline })
  {
    for (const auto& [name, stroke] : bendingStrokes())
    {
      const Lattice lattice = latticeAfter(referenceLatticeGrid(), kernel, { stroke });
      CorrectedField known(lattice);
      known.correct(known.moved);
      this->update(lattice);
      this->Field.leaveOutCorrections();
      const double rough = this->missAndDifference(known).first;
      this->correct(known);
      const auto [miss, difference] = this->missAndDifference(known);
      std::printf("%s: %.3f mm, corrected %.4f mm, from C++ %.4f mm\n", name.c_str(), rough, miss,
        difference);
      EXPECT_GT(rough, miss) << name;
      EXPECT_LT(miss, AllowedMm) << name;
      EXPECT_LT(difference, CardMm) << name;
    }
  }
}

// Strokes while the picture moves, then a still picture: the field is the same as if it were new.
TEST_F(FineDrawing, IsExactAgainAfterMoving)
{
  const Grid grid = referenceLatticeGrid();
  const auto strokes = bendingStrokes();
  Stroke second = strokes[1].second;
  second.anchor.x += 20.0;
  const Lattice first = latticeAfter(grid, KernelCatmullRom, { strokes[2].second });
  const Lattice last = latticeAfter(grid, KernelCatmullRom, { strokes[2].second, second });
  this->update(first);
  this->correct(CorrectedField(first));
  EXPECT_FALSE(this->Field.isRough());
  second.vector *= 0.5;
  for (const Lattice& moving :
    { latticeAfter(grid, KernelCatmullRom, { strokes[2].second, second }), last })
  {
    this->update(moving);
    EXPECT_TRUE(this->Field.isRough());
    this->Field.leaveOutCorrections();
  }
  CorrectedField known(last);
  const double rough = this->missAndDifference(known).first;
  EXPECT_GT(rough, AllowedMm);
  this->correct(known);
  known.correct(known.moved);
  const auto [miss, difference] = this->missAndDifference(known);
  EXPECT_LT(miss, AllowedMm);
  EXPECT_LT(difference, CardMm);
  // Where nothing bends much there is nothing to look up.
  const std::vector<glm::vec4> offsets = readVolume(
    this->Shown.window(), this->Field.offsets(), glm::ivec3(0), this->Request.nodes.count);
  const auto marked = std::count_if(
    offsets.begin(), offsets.end(), [](const glm::vec4& offset) { return offset.w > 0.0f; });
  EXPECT_GT(marked, 500);
  EXPECT_LT(marked, static_cast<std::ptrdiff_t>(offsets.size() / 20));
}

// Also a masked and a negated field.
TEST_F(FineDrawing, IsExactWithAMaskAndNegated)
{
  Lattice lattice =
    latticeAfter(referenceLatticeGrid(), KernelCatmullRom, { bendingStrokes()[1].second });
  for (const bool masked : { false, true })
  {
    const Inverse inverse = masked ? Inverse::Exact : Inverse::Negated;
    if (masked)
    {
      Mask mask{ plainGrid({ 65, 65, 38 }, glm::dvec3(4.0)), {} };
      forEachIndex(glm::ivec3(0), mask.grid.dimensions - 1, [&](const glm::ivec3& voxel) {
        mask.inside.push_back(
          glm::distance(glm::dvec3(voxel) * 4.0, glm::dvec3(128.0, 128.0, 80.0)) < 60.0);
      });
      lattice.mask = maskWeights(lattice.grid, FineSamples, mask, 15.0);
    }
    CorrectedField known(lattice, inverse);
    known.correct(known.moved);
    this->update(lattice, inverse);
    this->correct(known);
    const auto [miss, difference] = this->missAndDifference(known);
    EXPECT_LT(miss, AllowedMm) << masked;
    EXPECT_LT(difference, CardMm) << masked;
  }
}

// Where there is no memory for corrections, the field is drawn without, and with them again later.
TEST_F(FineDrawing, ForgetsCorrectionsAndFindsThemAgain)
{
  const Lattice lattice =
    latticeAfter(referenceLatticeGrid(), KernelCatmullRom, { bendingStrokes()[1].second });
  CorrectedField known(lattice);
  this->update(lattice);
  this->correct(known);
  const double exact = this->missAndDifference(known).first;
  EXPECT_NE(this->Field.fine().codes(), nullptr);
  this->Field.forgetCorrections();
  EXPECT_EQ(this->Field.fine().codes(), nullptr);
  EXPECT_TRUE(this->Field.isRough());
  const double rough = this->missAndDifference(known).first;
  EXPECT_GT(rough, AllowedMm);
  this->correct(known);
  EXPECT_TRUE(this->Field.bent().all) << "a kept picture would stay without them";
  EXPECT_EQ(this->missAndDifference(known).first, exact);
}

TEST_F(FineDrawing, NeedsNoTexturesWithoutCorrections)
{
  Lattice lattice = makeLattice(referenceLatticeGrid(), KernelCatmullRom);
  lattice.displacements[9 * 19 * 19 + 9 * 19 + 9] = { 0.1f, 0.0f, 0.0f };
  CorrectedField known(lattice);
  this->update(lattice);
  this->correct(known);
  EXPECT_EQ(this->Field.fine().codes(), nullptr);
  EXPECT_EQ(this->Field.fine().corrections(), nullptr);
  EXPECT_LT(this->missAndDifference(known).first, AllowedMm);
}
