// SPDX-License-Identifier: BSD-3-Clause
// Proves that each entry that Formats/Transforms/README.md lists changes the map or is refused by
// name: nothing that moves a point is passed over.
#include "Common/Problem.h"
#include "Formats/Transforms/PointTransform.h"
#include "Formats/Transforms/TransformFile.h"

#include <glm/geometric.hpp>

#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <string>
#include <vector>

using namespace brainshift;

namespace
{
using Names = std::set<std::string>;
using Lines = std::vector<std::string>;

std::string written(const std::string& name, const std::string& text)
{
  const std::string path = std::string(BRAINSHIFT_TEST_TEMP) + "/" + name;
  std::ofstream(path, std::ios::binary) << text;
  return path;
}

std::string problemIn(const TransformFiles& files)
{
  return problemOf([&] { readTransformFiles(files); });
}

glm::dvec3 mappedBy(const TransformFiles& files)
{
  return mapped(readTransformFiles(files), glm::dvec3(20.0, -30.0, 40.0));
}

// The first cells of the tables of the page.
Names listed()
{
  std::ifstream page(std::string(BRAINSHIFT_SOURCE_DIR) + "/Formats/Transforms/README.md");
  Names names;
  bool isList = false;
  for (std::string line; std::getline(page, line);)
  {
    isList = isList || line.rfind("## What is honoured", 0) == 0;
    if (isList && line.rfind("| `", 0) == 0)
    {
      names.insert(line.substr(3, line.find('`', 3) - 3));
    }
  }
  return names;
}

// One change of a good file: a line that begins with `entry` becomes `line`, or is added.
struct Change
{
  std::string entry;
  std::string line;  // empty: without it
  std::string words; // of the refusal; empty: the map is another one
};

std::string nameIn(const std::string& line)
{
  return line.substr(line.front() == '(' ? 1 : 0, line.find(' ') - (line.front() == '(' ? 1 : 0));
}

std::string changed(const Lines& lines, const Change& change)
{
  std::string text;
  bool isSeen = false;
  for (const std::string& line : lines)
  {
    const bool isIt = nameIn(line) == change.entry;
    isSeen = isSeen || isIt;
    text += isIt && change.line.empty() ? "" : (isIt ? change.line : line) + "\n";
  }
  return isSeen || change.line.empty() ? text : text + change.line + "\n";
}

// Walks changes of a good file, and returns their entries.
void walk(const Lines& good, const std::vector<Change>& changes, Names& walked)
{
  const glm::dvec3 before = mappedBy({ { written("walk.txt", changed(good, {})) }, "", "" });
  for (const Change& change : changes)
  {
    const TransformFiles files{ { written("walk.txt", changed(good, change)) }, "", "" };
    const std::string problem = problemIn(files);
    walked.insert(change.entry);
    if (change.words.empty())
    {
      EXPECT_EQ(problem, "") << change.line;
      EXPECT_GT(glm::distance(problem.empty() ? mappedBy(files) : before, before), 0.1)
        << change.entry << " " << change.line;
    }
    else
    {
      EXPECT_NE(problem.find(change.words), std::string::npos) << change.line << ": " << problem;
    }
  }
}

const Lines Euler{ R"((Transform "EulerTransform"))", "(NumberOfParameters 6)",
  "(TransformParameters 0.1 0.2 0.3 4 5 6)", "(CenterOfRotationPoint 1 20 30)",
  "(FixedImageDimension 3)", "(Size 8 8 8)", R"((ComputeZYX "false"))" };

Lines spline()
{
  std::string numbers;
  for (int i = 0; i < 3 * 125; ++i)
  {
    numbers += " " + std::to_string(i % 7 + i / 125);
  }
  return { R"((Transform "BSplineTransform"))", "(TransformParameters" + numbers + ")",
    "(GridSize 5 5 5)", "(GridIndex 0 0 0)", "(GridSpacing 60 60 60)",
    "(GridOrigin -130 -120 -110)", "(GridDirection 1 0 0 0 1 0 0 0 1)" };
}

std::string fieldFile()
{
  std::string numbers;
  for (int i = 0; i < 24; ++i)
  {
    const int value = i % 3 + i / 3;
    const auto number = static_cast<float>(value);
    numbers.append(reinterpret_cast<const char*>(&number), sizeof(number));
  }
  return written("walk.nrrd",
    "NRRD0004\ntype: float\ndimension: 4\nspace: left-posterior-superior\nsizes: 3 2 2 2\n"
    "space directions: none (90,0,0) (0,90,0) (0,0,90)\nkinds: vector domain domain domain\n"
    "endian: little\nencoding: raw\nspace origin: (-60,-60,-20)\n\n" +
      numbers);
}
}

namespace
{
void walkEuler(Names& walked)
{
  const std::string before = written("before.txt", changed(Euler, {}));
  walk(Euler,
    { { "Transform", R"((Transform "SplineKernelTransform"))", "does not know" },
      { "Transform", R"((Transform "TranslationTransform"))", "6 parameters" },
      { "NumberOfParameters", "(NumberOfParameters 12)", "NumberOfParameters is 12" },
      { "TransformParameters", "", "no entry TransformParameters" },
      { "TransformParameters", "(TransformParameters 0.1 0.2 0.3 4 5 7)", "" },
      { "TransformParameters", "(TransformParameters 0.1 0.2 0.3 4 5 6,5)", "6,5 in the entry" },
      { "TransformParameters", "(TransformParameters 0.1 0.2 0.3 4 5 inf)", "inf in the entry" },
      { "TransformParameters", "(TransformParameters 0.1 0.2 0.3 4 5 1e300)", "beyond 1e12" },
      { "UseBinaryFormatForTransformationParameters",
        R"((UseBinaryFormatForTransformationParameters "true"))", "in another file" },
      { "InitialTransformParameterFileName", "(InitialTransformParameterFileName)", "0 values" },
      { "InitialTransformParameterFileName",
        "(InitialTransformParameterFileName \"" + before + "\")", "no entry HowToCombine" },
      { "InitialTransformParameterFileName",
        "(InitialTransformParameterFileName \"" + before +
          "\")\n(HowToCombineTransforms \"Compose\")",
        "" },
      { "InitialTransformParametersFileName",
        "(InitialTransformParametersFileName \"" + before +
          "\")\n(HowToCombineTransforms \"Compose\")",
        "" },
      { "HowToCombineTransforms",
        "(InitialTransformParameterFileName \"" + before + "\")\n(HowToCombineTransforms \"Add\")",
        "combines its transforms by Add" },
      { "FixedImageDimension", "(FixedImageDimension 2)", "2 and 3 dimensions" },
      { "MovingImageDimension", "(MovingImageDimension 4)", "3 and 4 dimensions" },
      { "UseDirectionCosines", R"((UseDirectionCosines "false"))", "UseDirectionCosines" },
      { "CenterOfRotationPoint", "(CenterOfRotationPoint 0 0 0)", "" },
      { "CenterOfRotationPoint", "", "no entry CenterOfRotationPoint" },
      { "CenterOfRotationPoint", "(CenterOfRotationPoint 1 20)", "2 numbers in the entry" },
      { "CenterOfRotationPoint", "(CenterOfRotationPoint 1,5 20 30)", "1,5 in the entry" },
      { "CenterOfRotationPoint", "(centerOfRotationPoint 1 20 30)", "elastix writes CenterOfRot" },
      { "CenterOfRotationPoint", "(CentreOfRotationPoint 1 20 30)", "elastix writes CenterOfRot" },
      { "CenterOfRotationPoint", "(CenterOfRotationPoint 1 20 30", "not between brackets" },
      { "CenterOfRotation", "(CenterOfRotationPoint 1 2 3)", "twice" },
      { "ComputeZYX", R"((ComputeZYX "true"))", "" },
      { "ComputeZYX", R"((ComputeZYX "True"))", "must be true or false" },
      { "ComputeZYX", R"((computeZYX "true"))", "elastix writes ComputeZYX" },
      { "ComputeZYX", R"((ComputeZYX "true))", "ends inside quotes" } },
    walked);
  const std::string index =
    changed(Euler, { "CenterOfRotationPoint", "(CenterOfRotation 1 2 3)", "" });
  EXPECT_NE(
    problemIn({ { written("walk.txt", index) }, "", "" }).find("by an index"), std::string::npos);
}

void walkGridsAndFields(Names& walked)
{
  walk(spline(),
    { { "GridSize", "(GridSize 5 5)", "2 numbers" }, { "GridSize", "", "no entry GridSize" },
      { "GridSize", "(GridSize 4 5 5)", "parameters" },
      { "GridIndex", "(GridIndex 0 1 0)", "GridIndex" },
      { "GridSpacing", "(GridSpacing 75 60 60)", "" }, { "GridSpacing", "", "no entry GridSpac" },
      { "GridSpacing", "(GridSpacing 6O 60 60)", "6O in the entry" },
      { "GridOrigin", "(GridOrigin -115 -120 -110)", "" }, { "GridOrigin", "", "no entry GridOri" },
      { "GridDirection", "(GridDirection 0.8 0.6 0 -0.6 0.8 0 0 0 1)", "" },
      { "GridDirection", "", "no entry GridDirection" },
      { "GridDirection", "(GridDirection 1 0 0 0 1 0 0 0)", "8 numbers" },
      { "BSplineTransformSplineOrder", "(BSplineTransformSplineOrder 2)", "of order 2" },
      { "UseCyclicTransform", R"((UseCyclicTransform "true"))", "cyclic" } },
    walked);
  const Lines field{ R"((Transform "DeformationFieldTransform"))",
    "(DeformationFieldFileName \"" + fieldFile() + "\")",
    "(DeformationFieldInterpolationOrder 1)" };
  walk(field,
    { { "DeformationFieldFileName", "", "no entry DeformationFieldFileName" },
      { "DeformationFieldFileName", R"((DeformationFieldFileName "no.nrrd"))", "does not exist" },
      { "DeformationFieldInterpolationOrder", "(DeformationFieldInterpolationOrder 0)", "" },
      { "DeformationFieldInterpolationOrder", "(DeformationFieldInterpolationOrder 3)",
        "InterpolationOrder 3" } },
    walked);
}

void walkITK(Names& walked)
{
  const Lines itk{ "#Insight Transform File V1.0", "Transform: Euler3DTransform_double_3_3",
    "Parameters: 0.1 0.2 0.3 4 5 6", "FixedParameters: 1 20 30 0" };
  walk(itk,
    { { "Transform:", "Transform: TpsTransform_double_3_3", "does not know" },
      { "Parameters:", "", "0 parameters" }, { "Parameters:", "Parameters: 0.1 0.2 0.3 4 5 7", "" },
      { "Parameters:", "Parameters: 0.1 0.2 0.3 4 5 6,5", "no numbers" },
      { "FixedParameters:", "", "0 fixed parameters" },
      { "FixedParameters:", "FixedParameters: 1 20", "2 fixed parameters" },
      { "FixedParameters:", "FixedParameters: 1 20 30 1", "" },
      { "FixedParameters:", "FixedParameters: 1 20 31 0 7", "5 fixed parameters" },
      { "FixedParameters:", "fixedParameters: 1 20 30", "must begin with" },
      { "ComponentTransformFile:", "ComponentTransformFile: a.tfm", "must begin with" } },
    walked);
}
}

TEST(TransformEntries, OfThePageChangeTheMapOrAreRefused)
{
  Names walked;
  walkEuler(walked);
  walkGridsAndFields(walked);
  walkITK(walked);
  walked.insert({ "program", "fixed_image", "moving_image", "last row" }); // below
  EXPECT_EQ(walked, listed());
}

TEST(TransformEntries, LinesOfITKThatOccurTwice)
{
  const std::string begin =
    "#Insight Transform File V1.0\nTransform: Euler3DTransform_double_3_3\n";
  const auto expectTwice = [&](const std::string& lines, const std::string& name) {
    const std::string problem = problemIn({ { written("twice.tfm", begin + lines) }, "", "" });
    EXPECT_NE(problem.find("has the line " + name + " of Euler3DTransform_double_3_3 twice"),
      std::string::npos)
      << problem;
  };
  expectTwice(
    "Parameters: 0.1 0.2 0.3\nParameters: 4 5 6\nFixedParameters: 1 2 3\n", "Parameters:");
  expectTwice("Parameters: 0.1 0.2 0.3 4 5 6\nFixedParameters: 1 2\nFixedParameters: 3\n",
    "FixedParameters:");
}

TEST(TransformEntries, SixteenNumbersMeanWhatTheCallerSays)
{
  const std::string rows = "0.8 -0.6 0 5\n0.6 0.8 0 -3\n0 0 1 9\n0 0 0 1\n";
  for (const char* name : { "sixteen.txt", "sixteen.mat", "sixteen.xfm" })
  {
    TransformFiles files{ { written(name, rows) }, "", "" };
    const std::string problem = problemIn(files);
    EXPECT_NE(problem.find("fsl"), std::string::npos) << problem;
    EXPECT_NE(problem.find("niftyreg"), std::string::npos) << problem;
    files.program = MatrixProgram::NiftyReg;
    EXPECT_LT(glm::distance(mappedBy(files), { 39.0, -15.0, 49.0 }), 1e-9) << name;
    files.program = MatrixProgram::FSL;
    EXPECT_NE(problemIn(files).find("name the fixed image"), std::string::npos) << name;
    files.program = MatrixProgram::Unknown;
    files.movingImage = "in.nii";
    EXPECT_NE(problemIn(files).find("name the fixed image"), std::string::npos) << name;
  }
  TransformFiles files{ { written("sixteen.txt", "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0.5 1") }, "", "" };
  files.program = MatrixProgram::NiftyReg;
  EXPECT_NE(problemIn(files).find("last row"), std::string::npos);
}

TEST(TransformEntries, AFieldThatIsNoneGivesItsReason)
{
  const std::string scalars = written("scalars.nrrd",
    "NRRD0004\ntype: float\ndimension: 3\nspace: left-posterior-superior\nsizes: 2 2 2\n"
    "space directions: (9,0,0) (0,9,0) (0,0,9)\nkinds: domain domain domain\n"
    "endian: little\nencoding: ascii\nspace origin: (0,0,0)\n\n1 2 3 4 5 6 7 8\n");
  const std::string problem = problemIn({ { scalars }, "", "" });
  EXPECT_NE(problem.find("is a field that cannot be read"), std::string::npos) << problem;
}
