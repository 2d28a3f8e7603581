// SPDX-License-Identifier: BSD-3-Clause
// Proves that lines of MetaImage and NRRD that contradict each other, occur twice or are almost
// those of the format are refused by name, and that a spacing that is not there is said.
#include "Testing/Formats/Volumes/VolumeFormatTesting.h"

#include <algorithm>
#include <map>
#include <vector>

using namespace brainshift::testing;

namespace
{
using Lines = std::map<std::string, std::string>; // of a header, by name

// The numbers 1 to 8 as bytes. The first is "!" where text would be read.
const std::string Numbers = "!\"#$%&'(";

std::string metaImage(const Lines& other, const std::string& added = "")
{
  Lines lines{ { "ObjectType", "Image" }, { "NDims", "3" }, { "BinaryData", "True" },
    { "TransformMatrix", "-1 0 0 0 -1 0 0 0 1" }, { "Offset", "0 0 0" },
    { "ElementSpacing", "1 2 3" }, { "DimSize", "2 2 2" }, { "ElementType", "MET_UCHAR" } };
  std::string text;
  for (const auto& [name, value] : other)
  {
    lines[name] = value;
  }
  for (const auto& [name, value] : lines)
  {
    if (!value.empty())
    {
      text.append(name).append(" = ").append(value).append("\n");
    }
  }
  return text + added + "ElementDataFile = LOCAL\n" + Numbers;
}

std::string nrrd(const std::string& lines, const std::string& sizes = "2 2 2")
{
  const std::string dimension = sizes.size() > 5 ? "4" : "3";
  return "NRRD0005\ntype: uchar\nencoding: raw\ndimension: " + dimension + "\nsizes: " + sizes +
    "\n" + lines + "\n" + Numbers + Numbers + Numbers;
}

const std::string Placed =
  "space: RAS\nspace directions: (1,0,0) (0,2,0) (0,0,3)\nspace origin: (0,0,0)\n";

template <typename Reader>
std::string saidOf(const std::string& name, const std::string& bytes)
{
  writeFile(name, bytes);
  FormatReading<Reader> reading(name);
  EXPECT_GT(reading.image()->GetNumberOfPoints(), 0) << bytes;
  return reading.said();
}

template <typename Reader>
void expectSaid(const std::string& name, const std::string& bytes, const std::string& words)
{
  const std::string said = saidOf<Reader>(name, bytes);
  EXPECT_NE(said.find(words), std::string::npos) << words << ": " << said;
}
}

TEST(TextHeaderSaid, FieldsThatOccurTwice)
{
  expectRefused<NRRD>(
    "twice.nrrd", nrrd(Placed + "space origin: (5,0,0)\n"), "has the field 'space origin' twice");
  expectRefused<NRRD>("twice.nrrd", nrrd(Placed + "space: LPS\n"), "has the field 'space' twice");
  expectRefused<NRRD>("twice.nrrd", nrrd("spacings: 1 1 1\naxis mins: 0 0 0\naxismins: 1 0 0\n"),
    "has the field 'axis mins' twice");
  expectRefused<NRRD>("twice.nrrd",
    nrrd("spacings: 1 1 1\ncenters: cell cell cell\ncenterings: node node node\n"),
    "has the field 'centers' twice");
  expectRefused<NRRD>("twice.nrrd", nrrd(Placed + "Segment0_ID:=a\nSegment0_ID:=b\n"),
    "has the field 'Segment0_ID' twice");
  EXPECT_EQ(saidOf<NRRD>("twice.nrrd", nrrd(Placed + "note:=a\nnote:=a\n")), "");
  expectRefused<Meta>("twice.mha", metaImage({}, "Offset = 5 0 0\n"), "has the key Offset twice");
  expectRefused<Meta>(
    "twice.mha", metaImage({}, "elementspacing = 1 2 3\n"), "has the key elementspacing twice");
  EXPECT_EQ(saidOf<Meta>("twice.mha", metaImage({}, "Note = a\nNote = b\n")), "");
}

TEST(TextHeaderSaid, FieldsOfNRRDBesideSpaceDirections)
{
  expectRefused<NRRD>("beside.nrrd", nrrd(Placed + "spacings: 9 2 3\n"),
    "has the spacings 9 2 3; that of axis 1 must be nan or the length of its space directions, 1");
  EXPECT_EQ(saidOf<NRRD>("beside.nrrd", nrrd(Placed + "spacings: 1 nan 3.0001\n")), "");
  expectRefused<NRRD>("beside.nrrd", nrrd(Placed + "axis mins: nan 4 nan\n"),
    "has axis mins for axis 2, whose place the space directions and the space origin say");
  expectRefused<NRRD>("beside.nrrd", nrrd(Placed + "axis maxs: 9 9 9\n"), "has axis maxs for");
  expectRefused<NRRD>("beside.nrrd", nrrd(Placed + "kinds: space time space\n"),
    "has the kinds space time space; axis 2 has space directions and must be a domain or space");
  EXPECT_EQ(saidOf<NRRD>("beside.nrrd", nrrd(Placed + "kinds: Space domain ???\n")), "");
}

TEST(TextHeaderSaid, LabelsOfNRRDWithoutDirections)
{
  const std::string spacings = "spacings: 1 1 2 3\n";
  expectRefused<NRRD>("labels.nrrd",
    nrrd(spacings + "labels: \"t\" \"x\" \"y\" \"z\"\n", "3 2 2 2"),
    "has the labels \"t\" \"x\" \"y\" \"z\", but axis 1 counts as x");
  EXPECT_TRUE(isOnlyOfSides(saidOf<NRRD>("labels.nrrd",
    nrrd(
      spacings + "labels: \"t\" \"x\" \"y\" \"z\"\nkinds: time space space space\n", "3 2 2 2"))));
  expectRefused<NRRD>(
    "labels.nrrd", nrrd("spacings: 1 2 3\nlabels: \"z\" \"y\" \"x\"\n"), "but axis 1 counts as x");
  EXPECT_TRUE(isOnlyOfSides(
    saidOf<NRRD>("labels.nrrd", nrrd("spacings: 1 2 3\nlabels: \"x\" \"Y\" \"slice\"\n"))));
}

TEST(TextHeaderSaid, KeysOfMetaImageThatAreAlmostThoseOfTheFormat)
{
  for (const auto& [wrong, right] :
    std::map<std::string, std::string>{ { "TransformMatix", "TransformMatrix" },
      { "ElementSpaceing", "ElementSpacing" }, { "Element Spacing", "ElementSpacing" },
      { "DistanceUnit", "DistanceUnits" }, { "Offsets", "Offset" } })
  {
    expectRefused<Meta>("slip.mha", metaImage({ { right, "" }, { wrong, "1 2 3" } }),
      "which MetaImage does not define; it must be " + right);
  }
  expectSaid<Meta>("slip.mha", metaImage({ { "ElementToIntensitySlope", "2" } }),
    "has the key 'elementtointensityslope', which MetaImage does not define; it does not count");
  expectSaid<Meta>("slip.mha",
    metaImage({ { "TransformMatrix", "" }, { "TransformMaTrix", "-1 0 0 0 -1 0 0 0 1" } }),
    "has the key 'TransformMaTrix' in other capitals than MetaImage's");
  EXPECT_EQ(saidOf<Meta>("slip.mha", metaImage({ { "0008|0020", "2026" }, { "Namen", "a" } })), "");
  EXPECT_EQ(saidOf<Meta>("of_nifti.mha", // ITK copies the header of NIfTI
              metaImage({ { "toffset", "0" }, { "vox_offset", "352" }, { "scl_slope", "1" } })),
    "");
}

// As old Macs wrote them.
TEST(TextHeaderSaid, LinesMayEndWithCarriageReturns)
{
  const auto expectRead = [](auto&& reading) {
    EXPECT_EQ(reading.said(), "");
    ASSERT_EQ(reading.image()->GetNumberOfPoints(), 8);
    EXPECT_EQ(reading.values().at(7), '(');
  };
  const auto old = [](std::string text) {
    std::replace(text.begin(), text.end(), '\n', '\r');
    return text;
  };
  writeFile("old.mha", old(metaImage({})));
  expectRead(FormatReading<Meta>("old.mha"));
  writeFile("old.nrrd", old(nrrd(Placed)));
  expectRead(FormatReading<NRRD>("old.nrrd"));
}

TEST(TextHeaderSaid, SlopesThatAreNone)
{
  const std::string slope = "ElementToIntensityFunctionSlope";
  for (const std::string zero : { "0", "0.0", "-0" })
  {
    const std::string bytes =
      metaImage({ { slope, zero }, { "ElementToIntensityFunctionOffset", "2" } });
    expectSaid<Meta>("slope.mha", bytes, "has the " + slope + " 0, which counts as 1");
    FormatReading<Meta> reading("slope.mha");
    EXPECT_EQ(reading.values().at(0), '!' + 2.0);
    EXPECT_EQ(reading.values().at(7), '(' + 2.0);
  }
  for (const std::string none : { "nan", "inf", "two", "1 2" })
  {
    std::string sentence = "has the " + slope + " ";
    sentence += none;
    sentence += "; it must be a finite number";
    expectRefused<Meta>("slope.mha", metaImage({ { slope, none } }), sentence);
  }
}

TEST(TextHeaderSaid, DirectionsThatScaleTheSpacing)
{
  expectSaid<Meta>("scaled.mha", metaImage({ { "TransformMatrix", "-1 0 0 0 -0.8 0 0 0 1" } }),
    "has directions of its axes with the lengths 1, 0.8 and 1, which should be 1");
  const std::string rounded = "-0.7071 0.7071 0 -0.7071 -0.7071 0 0 0 1";
  EXPECT_EQ(saidOf<Meta>("turned.mha", metaImage({ { "TransformMatrix", rounded } })), "");
}

TEST(TextHeaderSaid, DistancesThatAreNotThere)
{
  expectSaid<Meta>("bare.mha", metaImage({ { "ElementSpacing", "" } }),
    "has no ElementSpacing; its voxels count as 1 mm apart");
  EXPECT_EQ(
    saidOf<Meta>("bare.mha", metaImage({ { "ElementSpacing", "" }, { "ElementSize", "1 2 3" } })),
    "");
  expectSaid<Meta>("bare.mha", metaImage({ { "Offset", "" } }),
    "has no Offset; its first voxel counts as at 0 0 0");
  EXPECT_EQ(saidOf<Meta>("bare.mha", metaImage({ { "Offset", "" }, { "Position", "1 2 3" } })), "");
  EXPECT_TRUE(isOnlyOfSides(
    saidOf<Meta>("bare.mha", metaImage({ { "Offset", "" }, { "TransformMatrix", "" } }))));
  expectSaid<NRRD>("bare.nrrd", nrrd("space: RAS\nspace directions: (1,0,0) (0,2,0) (0,0,3)\n"),
    "has no space origin; its first voxel counts as at 0 0 0");
  expectSaid<NRRD>("bare.nrrd", nrrd(""), "voxels count as 1 mm apart there");
  expectSaid<NRRD>("bare.nrrd", nrrd("spacings: 1 nan 3\n"), "voxels count as 1 mm apart there");
}

TEST(TextHeaderSaid, ImagesAreBinaryIfTheFileDoesNotSayIt)
{
  writeFile("binary.mha", metaImage({ { "BinaryData", "" } }));
  FormatReading<Meta> reading("binary.mha");
  EXPECT_EQ(reading.said(), "");
  EXPECT_EQ(reading.values(), (std::vector<double>{ 33, 34, 35, 36, 37, 38, 39, 40 }));
}

// Files of 3D Slicer before 4.11: one component for each segment, where it is 1.
TEST(TextHeaderSaid, SegmentsWithoutLayers)
{
  const std::string begin = "space: RAS\nspace origin: (0,0,0)\nkinds: list domain domain domain\n"
                            "space directions: none (1,0,0) (0,1,0) (0,0,1)\n"
                            "Segment0_ID:=a\nSegment0_Name:=tumour\nSegment1_ID:=b\n"
                            "Segment1_Name:=vein\nSegment2_ID:=c\nSegment2_Name:=artery\n";
  writeFile("old.seg.nrrd", nrrd(begin, "3 2 2 2"));
  for (int layer = 0; layer < 3; ++layer)
  {
    const char* const names[] = { "1: tumour", "2: vein", "3: artery" };
    NRRD reader;
    reader->SetFileName(scratchFile("old.seg.nrrd").c_str());
    reader->SetChoice(names[layer]);
    reader->Update();
    vtkImageData* image = reader->GetOutput();
    ASSERT_EQ(image->GetNumberOfPoints(), 8);
    EXPECT_EQ(image->GetScalarComponentAsDouble(0, 0, 0, 0), 33.0 + layer);
  }
  expectSaid<NRRD>("old.seg.nrrd", nrrd(begin, "3 2 2 2"), "without vein, artery; Layer chooses");
  expectRefused<NRRD>("old.seg.nrrd", nrrd(begin + "Segment3_ID:=d\n", "3 2 2 2"),
    "has 4 segments in 3 layers, of which 4 name no layer");
  expectRefused<NRRD>("old.seg.nrrd", nrrd(begin + "Segment1_Layer:=1\n", "3 2 2 2"),
    "has 3 segments in 3 layers, of which 2 name no layer");
}

TEST(TextHeaderSaid, SegmentsWhoseValuesTellNothing)
{
  const auto said = [](const std::string& value, const std::string& other) {
    return saidOf<NRRD>("values.seg.nrrd",
      nrrd(Placed + "Segment0_ID:=a\nSegment0_Name:=tumour\nSegment0_LabelValue:=" + value +
        "\nSegment0_Layer:=0\nSegment1_ID:=b\nSegment1_Name:=vein\nSegment1_LabelValue:=3\n" +
        "Segment1_Layer:=" + other + "\n"));
  };
  EXPECT_EQ(said("2", "0"), "");
  EXPECT_EQ(said("3", "1"), ""); // in another layer
  for (const std::string value : { "two", "2.5", "2 3" })
  {
    EXPECT_NE(said(value, "0")
                .find("has the Segment0_LabelValue " + value +
                  ", which is no whole number; it counts as 1"),
      std::string::npos);
  }
  EXPECT_NE(
    said("2", "x").find("has the Segment1_Layer x, which is no whole number"), std::string::npos);
  EXPECT_NE(said("3", "0").find("has the segments tumour and vein in one layer, both with the "
                                "LabelValue 3"),
    std::string::npos);
}

// Recordings of PLUS and 3D Slicer: each picture has a place of its own.
TEST(TextHeaderSaid, PicturesOfATrackedProbeAreNoVolume)
{
  const std::string place = "1 0 0 5 0 1 0 6 0 0 1 7 0 0 0 1";
  const auto tracked = [&](int frame) {
    return "Seq_Frame000" + std::to_string(frame) + "_ProbeToTrackerTransform";
  };
  expectRefused<Meta>("sweep.igs.mha", metaImage({ { tracked(0), place }, { tracked(1), place } }),
    "holds 2 pictures of a tracked probe, each at a place of its own");
  expectRefused<NRRD>("sweep.igs.nrrd", nrrd(Placed + tracked(1) + ":=" + place + "\n"),
    "SlicerIGT, Volume Reconstruction");
  expectRefused<NRRD>("flat.igs.nrrd", // as PLUS writes it
    nrrd("space dimension: 2\nspace directions: (1,0) (0,1) none\nspace origin: (0,0)\n"
         "kinds: domain domain list\n" +
      tracked(1) + ":=" + place + "\n"),
    "holds 2 pictures of a tracked probe");
  expectRefused<Meta>("poses.igs.mha",
    metaImage({ { "DimSize", "0 0 2" }, { tracked(0), place }, { tracked(1), place } }),
    "holds 2 poses of a tracked probe (seq_frame0001_probetotrackertransform) and no picture");
  EXPECT_EQ(saidOf<Meta>("one.mha",
              metaImage({ { tracked(0), place }, { "Seq_Frame0001_Timestamp", "2.5" } })),
    "");
  expectSaid<NRRD>("times.nrrd",
    nrrd("space: RAS\nspace origin: (0,0,0)\nkinds: list domain domain domain\n"
         "space directions: none (1,0,0) (0,1,0) (0,0,1)\n" +
        tracked(1) + ":=" + place + "\n",
      "3 2 2 2"),
    "which do not place it");
}

// The file may begin with a header of its own, such as that of NIfTI.
TEST(TextHeaderSaid, BytesBesideTheNumbersOfAnotherFile)
{
  const std::string header = "NRRD0005\ntype: uchar\nencoding: raw\ndimension: 3\nsizes: 2 2 2\n" +
    Placed + "data file: " + scratchFile("surplus.raw") + "\n";
  writeFile("surplus.raw", Numbers + "1234");
  expectSaid<NRRD>("surplus.nhdr", header, "leaves out 4 bytes at the end of ");
  EXPECT_EQ(saidOf<NRRD>("surplus.nhdr", header + "byte skip: 4\n"), "");
  EXPECT_EQ(saidOf<NRRD>("surplus.nhdr", header + "byte skip: -1\n"), "");
  const auto bytesOf = [](const std::vector<unsigned char>& values) {
    return std::string(values.begin(), values.end());
  };
  // gzip: a stored block of 12 bytes, their checksum and their number
  writeFile("surplus.raw",
    bytesOf({ 0x1f, 0x8b, 8, 0, 0, 0, 0, 0, 0, 3, 1, 12, 0, 0xf3, 0xff }) + Numbers + "1234" +
      bytesOf({ 0xf2, 0x02, 0x82, 0x11, 12, 0, 0, 0 }));
  const std::string ofPacked = std::string(header).replace(header.find("raw"), 3, "gzip");
  expectSaid<NRRD>("surplus.nhdr", ofPacked, "leaves out 4 bytes");
  EXPECT_EQ(saidOf<NRRD>("surplus.nhdr", ofPacked + "byte skip: 4\n"), "");
}
