// SPDX-License-Identifier: BSD-3-Clause
// Proves that memory is counted as the driver allocated it, whatever a texture's format and size.
#include "Representations/Gpu/GpuMemory.h"
#include "Representations/Gpu/OpenGL.h"
#include "Testing/Cxx/Representations/TestWindow.h"

#include <vtkNew.h>
#include <vtkTextureObject.h>

#include <gtest/gtest.h>

using namespace brainshift;
using namespace brainshift::testing;

TEST(TextureMemory, CountsVolumesImagesAndDepth)
{
  TestWindow open;
  vtkOpenGLRenderWindow* window = open.window();
  vtkNew<vtkTextureObject> scalars;
  scalars->SetContext(window);
  scalars->SetInternalFormat(GL_R16);
  ASSERT_TRUE(scalars->Allocate3D(5, 6, 7, 1, VTK_UNSIGNED_SHORT));
  EXPECT_EQ(textureBytes(scalars), 5 * 6 * 7 * 2);

  vtkNew<vtkTextureObject> image;
  image->SetContext(window);
  ASSERT_TRUE(image->Allocate2D(30, 20, 4, VTK_FLOAT));
  EXPECT_EQ(textureBytes(image), 30 * 20 * 16);

  vtkNew<vtkTextureObject> depth;
  depth->SetContext(window);
  ASSERT_TRUE(depth->AllocateDepth(30, 20, vtkTextureObject::Float32));
  EXPECT_EQ(textureBytes(depth), 30 * 20 * 4);
}

TEST(TextureMemory, OfNothingIsNothing)
{
  TestWindow open;
  vtkOpenGLRenderWindow* window = open.window();
  EXPECT_EQ(textureBytes(nullptr), 0);
  vtkNew<vtkTextureObject> unmade;
  unmade->SetContext(window);
  EXPECT_EQ(textureBytes(unmade), 0);
}
