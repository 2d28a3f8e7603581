// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/Transforms/FSLWarp.h"

#include "Common/Guard.h"
#include "Common/HostMemory.h"
#include "Common/Numbers.h"
#include "Common/Problem.h"
#include "Formats/Files/Text.h"
#include "Formats/NIFTI/NIFTIHeader.h"
#include "Formats/NIFTI/NIFTIVolume.h"
#include "Formats/Volumes/RasGrid.h"

#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkNIFTIImageHeader.h"
#include "vtkPointData.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace brainshift
{
namespace
{
constexpr double NearEnough = 1e-3; // mm and voxels: headers hold float32

// Millimetres of FSL to voxels: from the first voxel, by pixdim and not by the sform. x is reversed
// where the file is right-handed. One without sform and qform counts as left-handed.
glm::dmat4 voxelFromFSL(const FSLFrame& frame)
{
  glm::dmat4 result(1.0);
  for (int axis = 0; axis < 3; ++axis)
  {
    result[axis][axis] = 1.0 / frame.sizes[axis];
  }
  if (frame.isRightHanded)
  {
    result[0][0] = -result[0][0];
    result[3][0] = frame.dimensions.x - 1;
  }
  return result;
}

FSLFrame frameOf(const NIFTIVolume& file, const VolumeHeader& header)
{
  FSLFrame frame;
  frame.dimensions = header.dimensions;
  frame.worldFromVoxel = file.inFileOrder(header.worldFromVoxel, header.dimensions);
  const NIFTIPlacement placement = file.placement();
  for (int axis = 0; axis < 3; ++axis)
  {
    frame.sizes[axis] = std::abs(placement.pixelSize[axis]);
    if (!std::isfinite(frame.sizes[axis]) || frame.sizes[axis] == 0.0)
    {
      throw Problem(joined("has the pixdim[", axis + 1, "] ", placement.pixelSize[axis],
        ", by which FSL scales; name the image that flirt was given"));
    }
  }
  const bool isKnown = placement.sformCode > 0 || placement.qformCode > 0;
  frame.isRightHanded = isKnown && glm::determinant(glm::dmat3(frame.worldFromVoxel)) > 0.0;
  frame.worldFromFSL = frame.worldFromVoxel * voxelFromFSL(frame);
  return frame;
}

// Reports what a file says of its voxels' positions and does not count. Other warnings of its
// header are about times and numbers: of an image nothing else is used here, and of a map three
// volumes are no times.
void warnOfPlacement(
  const std::string& fileName, const NIFTIVolume& file, const VolumeHeader& header)
{
  std::vector<std::string> warnings;
  worldFromVoxel(file.placement(), warnings);
  if (!header.knowsSides)
  {
    warnings.emplace_back(UnknownSidesWarning);
  }
  const std::string name = file.noun() + " " + fileName + " ";
  for (const std::string& warning : warnings)
  {
    warn(nullptr, name + warning);
  }
}

// Three numbers at each voxel of a file.
struct Warp
{
  FSLFrame frame;
  NIFTIPlacement placement;
  glm::dvec3 intentNumbers{ 0.0 }; // intent_p1 to intent_p3
  std::vector<glm::dvec3> numbers; // in the file's order, x fastest
  bool knowsSides = true;
};

// Components of one volume, or three volumes.
void takeNumbers(NIFTIVolume& file, const VolumeHeader& header, Warp& warp)
{
  const glm::ivec3& sides = header.dimensions;
  const auto count = static_cast<std::size_t>(sides.x) * sides.y * sides.z;
  withBeginning("cannot be read: ", [&] {
    requireHostMemory("a field of " + sizeText(glm::dvec3(sides)) + " points",
      file.storedBytes(header) + 4.0 * sizeof(glm::dvec3) * static_cast<double>(count));
  });
  StoredVoxels voxels;
  voxels.wanted = { 0, sides.x - 1, 0, sides.y - 1, 0, sides.z - 1 };
  file.load(0, [](double) { return true; }, voxels);
  vtkDataArray* stored = voxels.image->GetPointData()->GetScalars();
  if (stored->GetNumberOfComponents() != 3 ||
    stored->GetNumberOfTuples() != static_cast<vtkIdType>(count))
  {
    throw Problem("ends before its last voxel");
  }
  const bool isReversed = file.inFileOrder(glm::dmat4(1.0), sides) != glm::dmat4(1.0);
  warp.numbers.resize(count);
  const std::size_t slice = static_cast<std::size_t>(sides.x) * sides.y;
  for (std::size_t i = 0; i < count; ++i)
  {
    const std::size_t k = i / slice;
    const std::size_t from = isReversed ? (sides.z - 1 - k) * slice + i % slice : i;
    double vector[3];
    stored->GetTuple(static_cast<vtkIdType>(from), vector);
    warp.numbers[i] = header.rescaling.slope * glm::dvec3(vector[0], vector[1], vector[2]) +
      header.rescaling.intercept;
  }
}

vtkSmartPointer<vtkNIFTIImageReader> headerReader(const std::string& fileName)
{
  auto reader = vtkSmartPointer<vtkNIFTIImageReader>::New();
  reader->SetFileName(fileName.c_str());
  vtkNew<vtkCallbackCommand> silent; // NIFTIVolume reports problems
  silent->SetCallback([](vtkObject*, unsigned long, void*, void*) {});
  reader->AddObserver(vtkCommand::WarningEvent, silent);
  reader->AddObserver(vtkCommand::ErrorEvent, silent);
  reader->UpdateInformation();
  return reader;
}

// `isPlaced`: whether the header places the numbers. That of coefficients holds other numbers.
Warp readWarp(const std::string& fileName, bool isPlaced)
{
  NIFTIVolume file;
  VolumeHeader header;
  file.readHeader(fileName, header);
  if (header.components * header.times.size() != 3)
  {
    throw Problem(joined("has ", header.components, " components and ", header.times.size(),
      " volumes; a map must have 3 numbers at each voxel (dim[4] or dim[5])"));
  }
  Warp warp;
  withBeginning("places nothing: ", [&] { requireAffine(header.worldFromVoxel); });
  warp.frame = frameOf(file, header);
  warp.placement = file.placement();
  if (warp.placement.mmPerUnit != 1.0)
  {
    throw Problem("has a unit of length that is not mm (xyzt_units); a map must be in mm");
  }
  warp.knowsSides = header.knowsSides;
  if (isPlaced)
  {
    warnOfPlacement(fileName, file, header);
  }
  const auto reader = headerReader(fileName); // which owns the header
  if (vtkNIFTIImageHeader* stored = reader->GetNIFTIHeader())
  {
    warp.intentNumbers =
      glm::dvec3(stored->GetIntentP1(), stored->GetIntentP2(), stored->GetIntentP3());
  }
  takeNumbers(file, header, warp);
  return warp;
}

LinkGrid gridOf(const glm::ivec3& dimensions, const glm::dmat4& worldFromGrid)
{
  LinkGrid grid;
  grid.dimensions = dimensions;
  grid.origin = glm::dvec3(worldFromGrid[3]);
  grid.worldFromGrid = glm::dmat3(worldFromGrid);
  grid.gridFromWorld = glm::inverse(grid.worldFromGrid);
  return grid;
}

glm::dvec3 indexOf(std::size_t i, const glm::ivec3& sides)
{
  const std::size_t row = i / sides.x;
  return { i % sides.x, row % sides.y, row / sides.y };
}

glm::dvec3 moved(const glm::dmat4& matrix, const glm::dvec3& point)
{
  return glm::dvec3(matrix * glm::dvec4(point, 1.0));
}

// The sum over axes of how widely finite numbers spread about their mean.
double spreadOf(const std::vector<glm::dvec3>& numbers)
{
  glm::dvec3 sum(0.0);
  glm::dvec3 squares(0.0);
  double count = 0.0;
  for (const glm::dvec3& number : numbers)
  {
    if (std::isfinite(glm::length(number)))
    {
      sum += number;
      squares += number * number;
      count += 1.0;
    }
  }
  const glm::dvec3 mean = sum / count;
  const glm::dvec3 deviation = glm::sqrt(glm::max(squares / count - mean * mean, glm::dvec3(0.0)));
  return deviation.x + deviation.y + deviation.z;
}

// Positions of the moving image at the voxels of a field, in the mm of FSL: FSL's own rule says
// whether a file holds these or displacements, for it does not name them.
void makePositions(Warp& warp)
{
  const glm::dmat4 fslFromVoxel = glm::inverse(voxelFromFSL(warp.frame));
  std::vector<glm::dvec3> places(warp.numbers.size());
  std::vector<glm::dvec3> differences(warp.numbers.size());
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    places[i] = moved(fslFromVoxel, indexOf(i, warp.frame.dimensions));
    differences[i] = warp.numbers[i] - places[i];
  }
  if (spreadOf(warp.numbers) > spreadOf(differences))
  {
    return;
  }
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    warp.numbers[i] += places[i];
  }
}

// How much of the spread of a warp's numbers an affine map of their voxels explains, 0 to 1:
// positions follow their voxels, velocities do not.
double explainedByVoxels(const Warp& warp)
{
  const glm::dvec3 middle = 0.5 * glm::dvec3(warp.frame.dimensions - 1);
  glm::dmat4 squares(0.0);    // sums of the products of (voxel, 1) with itself
  glm::dmat4x3 products(0.0); // and with the numbers
  glm::dvec3 sum(0.0);
  double all = 0.0;
  for (std::size_t i = 0; i < warp.numbers.size(); ++i)
  {
    const glm::dvec3& number = warp.numbers[i];
    if (std::isfinite(glm::length(number)))
    {
      const glm::dvec4 place(indexOf(i, warp.frame.dimensions) - middle, 1.0);
      squares += glm::outerProduct(place, place);
      products += glm::outerProduct(number, place);
      sum += number;
      all += glm::dot(number, number);
    }
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    squares[axis][axis] += squares[axis][axis] == 0.0 ? 1.0 : 0.0; // one voxel thick
  }
  const double count = squares[3][3];
  const double spread = all - glm::dot(sum, sum) / count;
  if (!(count > 0.0) || !(spread > 0.0) || glm::determinant(squares) == 0.0)
  {
    return 0.0;
  }
  const glm::dmat4x3 map = products * glm::inverse(squares);
  double explained = -glm::dot(sum, sum) / count;
  for (int column = 0; column < 4; ++column)
  {
    explained += glm::dot(map[column], products[column]);
  }
  return explained / spread;
}

bool isNear(const glm::dmat4& one, const glm::dmat4& other)
{
  double most = 0.0;
  for (int i = 0; i < 16; ++i)
  {
    most = std::max(most, std::abs(one[i / 4][i % 4] - other[i / 4][i % 4]));
  }
  return most <= NearEnough;
}

// Displacements to positions in the world of the moving image.
FieldLink linkOf(const Warp& warp, const glm::dmat4& worldFromNumbers)
{
  FieldLink link;
  link.grid = gridOf(warp.frame.dimensions, warp.frame.worldFromVoxel);
  link.displacements.resize(warp.numbers.size());
  for (std::size_t i = 0; i < warp.numbers.size(); ++i)
  {
    const glm::dvec3 from = moved(warp.frame.worldFromVoxel, indexOf(i, warp.frame.dimensions));
    link.displacements[i] = glm::vec3(moved(worldFromNumbers, warp.numbers[i]) - from);
  }
  return link;
}

FieldLink fieldOf(Warp& warp, const NamedImages& images, bool& knowsSides)
{
  constexpr const char* Field = "a warp of FSL, whose numbers count from the moving image";
  const FSLFrame moving = readFSLFrame({ "moving", Field }, images.moving, knowsSides);
  if (!images.fixed.empty())
  {
    const FSLFrame fixed = readFSLFrame({ "fixed", Field }, images.fixed, knowsSides);
    if (fixed.dimensions != warp.frame.dimensions ||
      !isNear(fixed.worldFromVoxel, warp.frame.worldFromVoxel))
    {
      throw Problem("has " + sizeText(glm::dvec3(warp.frame.dimensions)) +
        " points that are not the voxels of the fixed image " + images.fixed + ", which has " +
        sizeText(glm::dvec3(fixed.dimensions)) + "; name the image of fnirt's --ref, or none");
    }
  }
  makePositions(warp);
  return linkOf(warp, moving.worldFromFSL);
}

// FNIRT's coefficients: pixdim holds the knots' distance in voxels of the fixed image, the qform's
// offset its sides, intent_p1 to p3 the sizes of its voxels, and the sform flirt's matrix from the
// moving to the fixed image, in the mm of FSL.
void requireFixed(const Warp& warp, const FSLFrame& fixed, const std::string& image)
{
  const glm::dvec3 sides = warp.placement.qformOffset;
  const bool isOfIt = glm::distance(sides, glm::dvec3(fixed.dimensions)) <= NearEnough &&
    glm::distance(glm::abs(warp.intentNumbers), fixed.sizes) <= NearEnough;
  if (!isOfIt)
  {
    throw Problem(joined("was made for a fixed image of ", listText(sides, " x "), " voxels of ",
      listText(warp.intentNumbers, " x "), " mm (qoffset, intent_p); ", image, " has ",
      listText(glm::dvec3(fixed.dimensions), " x "), " of ", listText(fixed.sizes, " x "),
      ". Name the image of fnirt's --ref"));
  }
  if (fixed.isRightHanded)
  {
    throw Problem("holds coefficients of FNIRT for the fixed image " + image +
      ", which is right-handed (neurological), and nothing says whether they count from its left "
      "or its right; let fnirtfileutils --ref --out make a field of it");
  }
}

SplineLink splineOf(const Warp& warp, const NamedImages& images, bool& knowsSides)
{
  constexpr const char* Knots = "coefficients of FNIRT, whose places depend on both images";
  const FSLFrame fixed = readFSLFrame({ "fixed", Knots }, images.fixed, knowsSides);
  const FSLFrame moving = readFSLFrame({ "moving", Knots }, images.moving, knowsSides);
  requireFixed(warp, fixed, images.fixed);
  constexpr int FewestCoefficients = 3; // of an image that is thinner than from knot to knot
  if (glm::any(glm::lessThan(warp.frame.dimensions, glm::ivec3(FewestCoefficients))))
  {
    throw Problem("has " + sizeText(glm::dvec3(warp.frame.dimensions)) +
      " coefficients; FNIRT writes 3 or more along each axis");
  }
  glm::dmat4 fixedFromMoving(1.0); // mm of FSL
  for (int row = 0; row < 3 && warp.placement.sformCode > 0; ++row)
  {
    for (int column = 0; column < 4; ++column)
    {
      fixedFromMoving[column][row] = warp.placement.sformRows[row][column];
    }
  }
  withBeginning("holds a matrix (sform) that is none: ", [&] { requireAffine(fixedFromMoving); });
  glm::dmat4 fixedVoxelFromKnot(1.0); // the first knot is one cell before the first voxel
  for (int axis = 0; axis < 3; ++axis)
  {
    fixedVoxelFromKnot[axis][axis] = warp.frame.sizes[axis];
    fixedVoxelFromKnot[3][axis] = -warp.frame.sizes[axis];
  }
  SplineLink link;
  link.grid = gridOf(warp.frame.dimensions, fixed.worldFromVoxel * fixedVoxelFromKnot);
  link.fades = true; // behind the last coefficients FNIRT counts 0
  const glm::dmat4 base =
    moving.worldFromFSL * glm::inverse(fixedFromMoving) * glm::inverse(fixed.worldFromFSL);
  link.base = { glm::dmat3(base), glm::dvec3(base[3]) };
  for (const glm::dvec3& coefficient : warp.numbers)
  {
    link.coefficients.push_back(glm::dmat3(moving.worldFromFSL) * coefficient);
  }
  return link;
}

void append(TransformLink link, PointTransform& transform)
{
  PointTransform ras{ { std::move(link) } };
  reverseXY(ras); // the chain is LPS
  transform.links.push_back(std::move(ras.links.front()));
}
}

FSLFrame readFSLFrame(const FSLNeed& need, const std::string& image, bool& knowsSides)
{
  if (image.empty())
  {
    throw Problem("holds " + need.thing + ": name the " + need.role +
      " image too, the NIfTI file that FSL was given (" +
      (need.role == "fixed" ? "--ref" : "--in") + ")");
  }
  NIFTIVolume file;
  VolumeHeader header;
  const FSLFrame frame =
    withBeginning("needs the " + need.role + " image " + image + ", which ", [&] {
      file.readHeader(image, header);
      withBeginning("places nothing: ", [&] { requireAffine(header.worldFromVoxel); });
      return frameOf(file, header);
    });
  warnOfPlacement(image, file, header);
  knowsSides = knowsSides && header.knowsSides;
  return frame;
}

std::optional<NIFTIWarpKind> niftiWarpOf(const std::string& fileName, bool isOfSPM)
{
  constexpr int None = 0;
  constexpr int Vector = 1007;
  constexpr int Field = 2006;
  constexpr int CubicSpline = 2007;
  if (!isNIFTIFile(fileName))
  {
    return {};
  }
  requireNIFTIFile(fileName);
  const auto reader = headerReader(fileName); // which owns the header
  vtkNIFTIImageHeader* header = reader->GetNIFTIHeader();
  const int intent = header ? header->GetIntentCode() : None;
  if (isOfSPM && intent != None && intent != Vector)
  {
    throw Problem("has the intent " + std::to_string(intent) +
      ", and SPM's deformations have 1007 or none; leave out the program SPM");
  }
  const std::string name =
    trimmed(header && header->GetIntentName() ? header->GetIntentName() : "");
  if (isOfSPM && intent == Vector && name != "Mapping")
  {
    throw Problem("has the intent 1007 with the name '" + shownWords(name) +
      "', and SPM's deformations have the name Mapping; leave out the program SPM");
  }
  return isOfSPM            ? std::optional(NIFTIWarpKind::Positions)
    : intent == Field       ? std::optional(NIFTIWarpKind::FSLField)
    : intent == CubicSpline ? std::optional(NIFTIWarpKind::FSLSpline)
                            : std::nullopt;
}

void addFSLWarp(const std::string& fileName, NIFTIWarpKind kind, const NamedImages& images,
  PointTransform& transform)
{
  const bool isField = kind == NIFTIWarpKind::FSLField;
  Warp warp = readWarp(fileName, isField);
  for (const glm::dvec3& number : warp.numbers)
  {
    if (!isField && !std::isfinite(glm::length(number)))
    {
      throw Problem("holds a coefficient that is not finite");
    }
  }
  if (isField)
  {
    transform.knowsSides = transform.knowsSides && warp.knowsSides;
    append(fieldOf(warp, images, transform.knowsSides), transform);
  }
  else
  {
    append(splineOf(warp, images, transform.knowsSides), transform);
  }
}

void addPositions(const std::string& fileName, PointTransform& transform)
{
  constexpr double LeastOfPositions = 0.5; // those of a bent head have 0.98 and more
  const Warp warp = readWarp(fileName, true);
  if (explainedByVoxels(warp) < LeastOfPositions)
  {
    throw Problem("holds numbers that do not grow along its voxels, as positions do; a flow field "
                  "of DARTEL or Shoot (u_, v_) has velocities: let SPM write a deformation (y_) "
                  "of it");
  }
  transform.knowsSides = transform.knowsSides && warp.knowsSides;
  append(linkOf(warp, glm::dmat4(1.0)), transform);
}
}
