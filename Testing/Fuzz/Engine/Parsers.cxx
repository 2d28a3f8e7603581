// SPDX-License-Identifier: BSD-3-Clause
#include "Testing/Fuzz/Engine/Parsers.h"

#include "Formats/Fields/FieldFile.h"
#include "Formats/Files/Endings.h"
#include "Formats/Files/ZipFile.h"
#include "Formats/Landmarks/LandmarkFormats.h"
#include "Formats/PackedFrames/PackedFrame.h"
#include "Formats/Surfaces/SurfaceFile.h"
#include "Formats/Transforms/FSLWarp.h"
#include "Formats/Transforms/MatrixText.h"
#include "Formats/Transforms/TransformRecord.h"
#include "Formats/Volumes/PlacedVolume.h"
#include "Tracking/Message.h"
#include "Tracking/SessionFile.h"

#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkObject.h"

#include <algorithm>
#include <utility>

namespace brainshift::fuzz
{
namespace
{
bool GoOn(double /*fraction*/)
{
  return true;
}

/** The ending of a NIfTI file, which is that of packed ones where the bytes are packed. */
std::string niftiEnding(const Bytes& bytes)
{
  return bytes.compare(0, 2, "\x1f\x8b") == 0 ? ".nii.gz" : ".nii";
}

/** Reads landmarks by the format that an ending stands for. */
void readLandmarks(const Bytes& bytes, const std::string& ending)
{
  LandmarkList list;
  formatByEnding(landmarkFormats(), ending)->read(bytes, {}, list);
}

/** Reads the last volume of a file, and so the furthest bytes. */
void readVolume(const std::string& format, const std::string& path)
{
  vtkObject::GlobalWarningDisplayOff(); // VTK's own readers write to the terminal
  const std::vector<const VolumeFormat*>& formats = volumeFormats();
  const auto found = std::find_if(formats.begin(), formats.end(),
    [&format](const VolumeFormat* one) { return one->name == format; });
  if (found == formats.end())
  {
    throw std::logic_error("There is no format of volumes called " + format);
  }
  if (!(*found)->isOne(path))
  {
    return;
  }
  PlacedVolume volume((*found)->make());
  volume.readHeader(path);
  const glm::ivec3 last = volume.geometry().grid.dimensions - 1;
  const int extent[6] = { 0, last.x, 0, last.y, 0, last.z };
  const vtkNew<vtkImageData> image;
  volume.read(volume.header().times.size() - 1, extent, GoOn, image);
}

void readField(const Bytes& bytes, const std::string& ending)
{
  vtkObject::GlobalWarningDisplayOff();
  DirectedField field;
  readFieldFile(fileOf(bytes, ending), field);
}

using Unpack = UnpackedFrame(const std::string& packed, const FrameShape& shape);

void readFrame(const Bytes& bytes, Unpack* unpack)
{
  constexpr std::size_t ShapeBytes = 5;
  if (bytes.size() < ShapeBytes)
  {
    return;
  }
  constexpr std::size_t LongestSide = 1024; // larger ones take time alone
  FrameShape shape;
  shape.columns = static_cast<int>(shortAt(bytes, 0) % LongestSide);
  shape.rows = static_cast<int>(shortAt(bytes, 2) % LongestSide);
  shape.bitsAllocated = 8 << static_cast<unsigned char>(bytes[4]) / 2 % 3; // 1, 2 or 4 bytes
  if (shape.count() > 0)
  {
    unpack(bytes.substr(ShapeBytes), shape);
  }
}

void readSurface(const Bytes& bytes, const std::string& ending)
{
  const std::string path = fileOf(bytes, ending);
  Surface surface;
  std::vector<std::string> warnings;
  readSurfaceFiles({ path, { path }, {} }, GoOn, surface, warnings);
}

void readTracts(const std::string& path)
{
  Tracts tracts;
  std::vector<std::string> warnings;
  readTractFile({ path, {} }, GoOn, tracts, warnings);
}

/** Takes a point through the links and back: numbers of a file become indices there. */
void follow(const PointTransform& transform)
{
  mappedBack(transform, mapped(transform, { 1.0, -2.0, 3.0 }));
}

void readRecords(const std::vector<TransformRecord>& records)
{
  PointTransform transform;
  addRecords(records, transform);
  follow(transform);
}

void readWarp(const Bytes& bytes, bool isOfSPM)
{
  vtkObject::GlobalWarningDisplayOff();
  const std::string path = fileOf(bytes, niftiEnding(bytes));
  const std::optional<NIFTIWarpKind> kind = niftiWarpOf(path, isOfSPM);
  PointTransform transform;
  if (kind == NIFTIWarpKind::Positions)
  {
    addPositions(path, transform);
  }
  else if (kind)
  {
    addFSLWarp(path, *kind, { path, path }, transform);
  }
  follow(transform);
}

/** The checksum of OpenIGTLink: CRC-64 of ECMA-182. */
std::uint64_t checksumOf(const std::vector<unsigned char>& body)
{
  constexpr std::uint64_t Polynomial = 0x42F0E1EBA9EA3693ULL;
  std::uint64_t sum = 0;
  for (const unsigned char byte : body)
  {
    sum ^= static_cast<std::uint64_t>(byte) << 56U;
    for (int bit = 0; bit < 8; ++bit)
    {
      sum = (sum << 1U) ^ ((sum >> 63U) * Polynomial);
    }
  }
  return sum;
}
}

void dicom(const Bytes& bytes)
{
  readVolume("DICOM", fileOf(bytes, ".dcm"));
}

void metaimage(const Bytes& bytes)
{
  readVolume("MetaImage", fileOf(bytes, ".mha"));
}

void mgh(const Bytes& bytes)
{
  readVolume("MGH", fileOf(bytes, ".mgh"));
}

void minc1(const Bytes& bytes)
{
  readVolume("MINC1", fileOf(bytes, ".mnc"));
}

void minc2(const Bytes& bytes)
{
  readVolume("MINC", fileOf(bytes, ".mnc"));
}

void nifti(const Bytes& bytes)
{
  readVolume("NIFTI", fileOf(bytes, niftiEnding(bytes)));
}

void nrrd(const Bytes& bytes)
{
  readVolume("NRRD", fileOf(bytes, ".nrrd"));
}

void omezarr(const Bytes& bytes)
{
  readVolume("OMEZarr", folderOf(bytes, ".zarr"));
}

void metaimagefield(const Bytes& bytes)
{
  readField(bytes, ".mha");
}

void niftifield(const Bytes& bytes)
{
  readField(bytes, niftiEnding(bytes));
}

void nrrdfield(const Bytes& bytes)
{
  readField(bytes, ".nrrd");
}

void deflated(const Bytes& bytes)
{
  readFrame(bytes, unpackDeflated);
}

void jpeg(const Bytes& bytes)
{
  readFrame(bytes, unpackJPEG);
}

void jpeg2000(const Bytes& bytes)
{
  readFrame(bytes, unpackJPEG2000);
}

void jpegls(const Bytes& bytes)
{
  readFrame(bytes, unpackJPEGLS);
}

void rle(const Bytes& bytes)
{
  readFrame(bytes, unpackRunLengths);
}

void freesurfer(const Bytes& bytes)
{
  readSurface(bytes, ".pial");
}

void gifti(const Bytes& bytes)
{
  readSurface(bytes, ".gii");
}

void mrtrix(const Bytes& bytes)
{
  readTracts(fileOf(bytes, ".tck"));
}

void trackvis(const Bytes& bytes)
{
  readTracts(fileOf(bytes, ".trk"));
}

void trx(const Bytes& bytes)
{
  readTracts(folderOf(bytes, ".trx"));
}

void elastix(const Bytes& bytes)
{
  if (isElastixText(bytes))
  {
    PointTransform transform;
    const AddFile refuse = [](const std::string&, PointTransform&) { throw Problem("alone"); };
    addElastixText(bytes, "case.txt", refuse, transform);
    follow(transform);
  }
}

void fslwarp(const Bytes& bytes)
{
  readWarp(bytes, false);
}

void hdf5(const Bytes& bytes)
{
  const std::string path = fileOf(bytes, ".h5");
  if (isHDF5(path))
  {
    readRecords(readHDF5Records(path));
  }
}

void itktext(const Bytes& bytes)
{
  readRecords(readITKText(bytes));
}

void lta(const Bytes& bytes)
{
  if (isLTAText(bytes))
  {
    PointTransform transform;
    addLTAText(bytes, {}, transform);
    follow(transform);
  }
}

void matlab(const Bytes& bytes)
{
  readRecords(readMatlabRecords(bytes));
}

void spmwarp(const Bytes& bytes)
{
  readWarp(bytes, true);
}

void xfm(const Bytes& bytes)
{
  if (isXFMText(bytes))
  {
    PointTransform transform;
    addXFMText(bytes, "case.xfm", transform);
    follow(transform);
  }
}

void fcsv(const Bytes& bytes)
{
  readLandmarks(bytes, ".fcsv");
}

void markups(const Bytes& bytes)
{
  readLandmarks(bytes, ".json");
}

void table(const Bytes& bytes)
{
  readLandmarks(bytes, ".csv");
}

void tag(const Bytes& bytes)
{
  readLandmarks(bytes, ".tag");
}

void message(const Bytes& bytes)
{
  std::array<unsigned char, HeaderBytes> begin{};
  if (bytes.size() < begin.size())
  {
    return;
  }
  std::copy_n(bytes.begin(), begin.size(), begin.begin());
  MessageHeader header;
  if (readHeader(begin, header).empty() && header.hasPoses())
  {
    std::vector<unsigned char> body(bytes.begin() + HeaderBytes, bytes.end());
    header.checksum = checksumOf(body); // else no changed byte would be read
    readBody(header, std::move(body));
  }
}

void zip(const Bytes& bytes)
{
  const ZipFile file(fileOf(bytes, ".zip"));
  for (const std::string& name : file.names())
  {
    file.part(name, 0, *file.size(name));
  }
}

void session(const Bytes& bytes)
{
  Session read;
  readSession(fileOf(bytes, ".txt"), read);
}
}
