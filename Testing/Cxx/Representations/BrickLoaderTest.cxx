// SPDX-License-Identifier: BSD-3-Clause
// Proves that a brick that was read and not taken is not read again, that bricks of another order
// are dropped, and that threads unpack no block twice and give bricks in the order in which these
// were wanted.
#include "Representations/Bricks/BrickLoader.h"
#include "Formats/Volumes/VolumeFile.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkPointData.h"
#include "vtkTextureObject.h" // for its smart pointer

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>

using namespace brainshift;

namespace
{
constexpr int Side = 64; // voxels: eight bricks, each of which needs voxels of all eight blocks
constexpr std::size_t Blocks = 8;
std::atomic<std::size_t> loaded{ 0 };

class ZerosFile : public VolumeFile
{
public:
  std::string noun() const override { return "file of zeros"; }
  void readHeader(const std::string&, VolumeHeader& header) override
  {
    header = VolumeHeader();
    header.dimensions = glm::ivec3(Side);
    header.storedType = VTK_SHORT;
  }
  void load(std::size_t, const Progress&, StoredVoxels& voxels) override
  {
    if (++loaded % 2 == 1) // so that another thread is done first
    {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    voxels.image = vtkSmartPointer<vtkImageData>::New();
    voxels.image->SetDimensions(Side, Side, Side);
    voxels.image->AllocateScalars(VTK_SHORT, 1);
    voxels.image->GetPointData()->GetScalars()->Fill(0.0);
  }
};

bool isOne(const std::string&)
{
  return true;
}

const VolumeFormat Zeros{ "Zeros", isOne, makeVolumeFile<ZerosFile> };

class BrickLoaderTest : public ::testing::Test
{
protected:
  static LevelSource source()
  {
    LevelSource source;
    source.format = &Zeros;
    source.fileName = "zeros";
    source.level = 1;
    source.type = VTK_SHORT;
    source.components = 1;
    return source;
  }

  static BrickOrder order()
  {
    BrickOrder order;
    order.fine.voxels = glm::ivec3(Side);
    order.fine.voxelFromTexture = glm::dvec3(Side);
    order.texels = glm::ivec3(Side / 2);
    return order;
  }

  void waitUntilDone()
  {
    while (!this->Loader.isDone())
    {
      std::this_thread::yield();
    }
  }

  std::vector<int> All{ 0, 1, 2, 3, 4, 5, 6, 7 };
  BrickLoader Loader{ source() };
};
}

TEST_F(BrickLoaderTest, ReadsABrickOnceUntilItIsTaken)
{
  this->waitUntilDone();
  ASSERT_EQ(this->Loader.problem(), "");
  this->Loader.order(order(), { 5, 2 });
  this->waitUntilDone();
  EXPECT_EQ(this->Loader.waiting(), 2);
  EXPECT_EQ(this->Loader.countRead(), 2);
  this->Loader.order(order(), this->All);
  EXPECT_EQ(this->Loader.waiting(), 8);
  this->waitUntilDone();
  EXPECT_EQ(this->Loader.countRead(), 8);
  std::vector<int> bricks;
  for (const ReadBrick& read : this->Loader.take(100))
  {
    EXPECT_EQ(read.remark, "");
    bricks.push_back(read.brick);
  }
  std::sort(bricks.begin(), bricks.end());
  EXPECT_EQ(bricks, this->All);
  this->Loader.order(order(), { 5 });
  this->waitUntilDone();
  EXPECT_EQ(this->Loader.countRead(), 1) << "it was taken, and is wanted again";
}

TEST_F(BrickLoaderTest, DropsBricksOfAnotherOrder)
{
  this->waitUntilDone();
  this->Loader.order(order(), this->All);
  this->waitUntilDone();
  BrickOrder other = order();
  other.texels = glm::ivec3(Side / 4);
  this->Loader.order(other, {});
  EXPECT_EQ(this->Loader.countRead(), 0);
  EXPECT_TRUE(this->Loader.take(100).empty());
}

TEST_F(BrickLoaderTest, ThreadsShareBlocksAndKeepTheOrder)
{
  this->waitUntilDone();
  loaded = 0;
  const std::vector<int> wanted{ 7, 0, 6, 1, 5, 2, 4, 3 };
  this->Loader.order(order(), wanted);
  std::vector<int> bricks;
  while (bricks.size() < wanted.size())
  {
    for (const ReadBrick& read : this->Loader.take(1))
    {
      bricks.push_back(read.brick);
    }
  }
  EXPECT_EQ(bricks, wanted);
  EXPECT_EQ(loaded, Blocks);
}
