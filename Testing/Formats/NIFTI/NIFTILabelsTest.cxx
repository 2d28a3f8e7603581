// SPDX-License-Identifier: BSD-3-Clause
// Proves that names and colours of labels are read from the extension that Connectome Workbench
// writes, in both byte orders, packed or not, and that damaged ones are left out.
#include "Common/LabelTable.h"
#include "Testing/Formats/NIFTI/NIFTITestFile.h"
#include "Testing/Formats/NIFTI/NIFTITestReading.h"

#include <gtest/gtest.h>

#include <array>

using namespace brainshift;
using namespace brainshift::testing;

namespace
{
const std::string Table =
  "<?xml version=\"1.0\"?><CaretExtension><VolumeInformation Index=\"0\"><LabelTable>"
  "<Label Key=\"0\" Red=\"1\" Green=\"1\" Blue=\"1\" Alpha=\"0\"><![CDATA[???]]></Label>"
  "<Label Key=\"7\" Red=\"1\" Green=\"0.5\" Blue=\"0\" Alpha=\"1\"><![CDATA[LEFT "
  "<PUTAMEN>]]></Label>"
  "<Label Key=\"12\" Red=\"0\" Green=\"9\" Blue=\"x\">plain</Label>"
  "</LabelTable></VolumeInformation></CaretExtension>";

// A file with an extension before its voxels.
std::vector<char> withExtension(int code, int sizeError, bool swapped)
{
  NIFTITestFile file;
  file.swapped = swapped;
  std::string text = Table;
  text.resize((text.size() + 8 + 15) / 16 * 16 - 8, '\0');
  file.voxelOffset = 352.0 + 8.0 + static_cast<double>(text.size());
  std::vector<char> bytes = file.header();
  bytes[348] = 1;
  std::vector<char> extension(8);
  file.put(extension, 0, static_cast<std::int32_t>(text.size() + 8) + sizeError);
  file.put(extension, 4, static_cast<std::int32_t>(code));
  extension.insert(extension.end(), text.begin(), text.end());
  const std::vector<char> voxels = file.voxels<std::int16_t>();
  bytes.insert(bytes.end(), extension.begin(), extension.end());
  bytes.insert(bytes.end(), voxels.begin(), voxels.end());
  return bytes;
}

void expectLabels(const std::string& name)
{
  Reading reading(name);
  EXPECT_EQ(reading.errors, "");
  const std::vector<Label> labels = attachedLabels(reading.image());
  ASSERT_EQ(labels.size(), 3u);
  EXPECT_EQ(labels[1].value, 7);
  EXPECT_EQ(labels[1].name, "LEFT <PUTAMEN>");
  EXPECT_EQ(labels[1].color, (std::array<unsigned char, 3>{ 255, 128, 0 }));
  EXPECT_EQ(labels[2].value, 12);
  EXPECT_EQ(labels[2].name, "plain");
  EXPECT_EQ(labels[2].color, (std::array<unsigned char, 3>{ 0, 255, 255 }));
}
}

TEST(NIFTILabels, VoxelsThatBeginInsideAnExtension)
{
  std::vector<char> bytes = withExtension(30, 0, false);
  const NIFTITestFile file;
  file.put(bytes, 108, 368.0f); // vox_offset
  writePlain(temporary("inside.nii"), bytes);
  Reading reading(temporary("inside.nii"));
  EXPECT_NE(reading.warnings.find("has its voxels at byte 368 (vox_offset), before the end of its "
                                  "extensions at byte "),
    std::string::npos)
    << reading.warnings;
  file.put(bytes, 108, 352.0f); // no extension, whatever byte 348 says
  writePlain(temporary("inside.nii"), bytes);
  Reading without(temporary("inside.nii"));
  EXPECT_EQ(without.errors, "");
  EXPECT_EQ(without.warnings.find("extensions"), std::string::npos) << without.warnings;
  EXPECT_TRUE(attachedLabels(without.image()).empty());
}

TEST(NIFTILabels, AreReadInBothByteOrdersPackedOrNot)
{
  for (const bool swapped : { false, true })
  {
    writePlain(temporary("labels.nii"), withExtension(30, 0, swapped));
    expectLabels(temporary("labels.nii"));
    writePacked(temporary("labels.nii.gz"), withExtension(30, 0, swapped));
    expectLabels(temporary("labels.nii.gz"));
  }
}

TEST(NIFTILabels, OtherAndDamagedExtensionsAreLeftOut)
{
  for (const auto& [code, sizeError] :
    { std::pair(6, 0), std::pair(30, 1), std::pair(30, -10000000), std::pair(30, 1 << 22) })
  {
    writePlain(temporary("other.nii"), withExtension(code, sizeError, false));
    Reading reading(temporary("other.nii"));
    EXPECT_EQ(reading.errors, "");
    EXPECT_GT(reading.image()->GetNumberOfPoints(), 0);
    EXPECT_TRUE(attachedLabels(reading.image()).empty()) << code << " " << sizeError;
  }
}
