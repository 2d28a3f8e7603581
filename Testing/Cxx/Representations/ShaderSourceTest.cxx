// SPDX-License-Identifier: BSD-3-Clause
// Proves that every program the product draws with compiles and links on this GPU.
#include "Representations/Gpu/ShaderSource.h"
#include "Testing/Cxx/Representations/TestWindow.h"

#include <vtkOpenGLShaderCache.h>
#include <vtkShaderProgram.h>

#include <gtest/gtest.h>

#include <set>
#include <string>

using namespace brainshift;
using namespace brainshift::testing;

TEST(ShaderSource, CompilesInEveryVariant)
{
  TestWindow shown;
  std::set<std::string> names;
  for (const auto& [name, source] : allSources())
  {
    EXPECT_TRUE(names.insert(name).second) << name << " twice";
    vtkShaderProgram* program = shown.window()->GetShaderCache()->ReadyShaderProgram(
      source.vertex.c_str(), source.fragment.c_str(), source.geometry.c_str());
    EXPECT_TRUE(program && program->GetCompiled()) << name;
  }
  for (const char* name : { "refine", "invert", "composite", "raycast_deformed_gradient_texture",
         "presence_deformed", "proxy", "normals" })
  {
    EXPECT_TRUE(names.count(name)) << name;
  }
}

TEST(ShaderSource, HoldsOnlyWhatAVariantNeeds)
{
  const std::string plain = rayCastSource({ false, RayCastVariant::Unshaded }).fragment;
  const std::string deformed = rayCastSource({ true, RayCastVariant::Unshaded }).fragment;
  EXPECT_EQ(plain.find("#define DEFORMED"), std::string::npos);
  EXPECT_NE(deformed.find("#define DEFORMED"), std::string::npos);
  EXPECT_EQ(deformed.find("#define SHADED"), std::string::npos);
  RayCastVariant alone{ true, RayCastVariant::GradientTexture };
  EXPECT_EQ(rayCastSource(alone).fragment.find("#define SEGMENTED"), std::string::npos);
  alone.segmented = true;
  EXPECT_NE(rayCastSource(alone).fragment.find("#define SEGMENTED"), std::string::npos);
}
