// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Bricks/StreamedBricks.h"

#include "Common/WorldAxes.h"
#include "Representations/Gpu/OpenGL.h"
#include "Representations/Gpu/VolumePass.h"
#include "Representations/Scene/Frustum.h"

#include "vtkCamera.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkTextureObject.h"
#include "vtkVolumeProperty.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace brainshift
{
namespace
{
constexpr double BytesInMiB = 1048576.0;
constexpr std::int64_t SlotVoxels = SlotSideVoxels * SlotSideVoxels * SlotSideVoxels;
constexpr double UsualLimitMiB = 1024.0; // where the user sets none
constexpr double LeastMiB = 1.0;
constexpr int LeastSlots = 8;
constexpr double MostBricks = 16777216.0;       // rays write their numbers as floats
constexpr double StaysFiner = 1.3;              // times a pixel
constexpr double WidestOfRays = 1.41421356;     // pixels; voxels are as near to one as levels allow
constexpr double MoreRoom = 1.5;                // times the former limit
constexpr std::chrono::seconds FileMendsIn(30); // a brick that failed is read again after that
constexpr int QuietPicturesOfRays = 2; // they ask for one brick each: two pictures are compared
constexpr int QuietPicturesOfSlices = 1;

std::vector<glm::dvec3> cornersOf(const ValueLayout& layout)
{
  std::vector<glm::dvec3> corners;
  for (int corner = 0; corner < 8; ++corner)
  {
    const glm::dvec3 side(corner & 1, corner >> 1 & 1, corner >> 2 & 1);
    corners.push_back(glm::mix(layout.low, layout.high, side));
  }
  return corners;
}

// mm, world. How wide a pixel is where what is drawn is nearest to the eye.
double pixelAt(const DrawnValues& values, const BrickView& view)
{
  const glm::dmat4& clipFromWorld = view.frame.clipFromWorld;
  const double nearW = frustumOf(clipFromWorld * view.frame.worldFromTexture).near.w;
  double w = 1e300;
  for (const glm::dvec3& corner : view.corners.empty() ? cornersOf(values.layout) : view.corners)
  {
    const glm::dvec4 world = view.frame.worldFromTexture * glm::dvec4(corner, 1.0);
    w = std::min(w, (clipFromWorld * world).w);
  }
  const glm::dvec3 up(clipFromWorld[0][1], clipFromWorld[1][1], clipFromWorld[2][1]);
  return 2.0 * std::max(w, nearW) / (glm::length(up) * std::max(view.pixels.y, 1));
}

// The voxels of a grid in the volume's texture. None if their axes are not the texture's, or if
// there are too many.
std::optional<FineGrid> placed(const DrawnValues& values, const Grid& grid, std::size_t level)
{
  const ValueLayout& layout = values.layout;
  const auto voxelOf = [&](const glm::dvec3& texture) {
    return grid.gridFromWorld(values.grid.worldFromGrid(
             (texture - layout.textureOfGridZero) / layout.textureFromGrid)) +
      0.5;
  };
  FineGrid fine;
  fine.level = level;
  fine.voxels = grid.dimensions;
  const glm::dvec3 bricks(fine.bricks());
  if (bricks.x * bricks.y * bricks.z > MostBricks)
  {
    return std::nullopt;
  }
  fine.voxelOfTextureZero = voxelOf(glm::dvec3(0.0));
  for (int axis = 0; axis < 3; ++axis)
  {
    glm::dvec3 unit(0.0);
    unit[axis] = 1.0;
    const glm::dvec3 along = voxelOf(unit) - fine.voxelOfTextureZero;
    fine.voxelFromTexture[axis] = along[axis];
    const glm::dvec3 across = glm::abs(along - along[axis] * unit);
    if (!(along[axis] > 0.0) || std::max({ across.x, across.y, across.z }) > 0.01)
    {
      return std::nullopt;
    }
  }
  return fine;
}
}

bool isLeftEye(const DrawnVolume& drawn)
{
  return drawn.renderer->GetActiveCamera()->GetLeftEye() != 0;
}

BrickView brickViewOf(
  const DrawnVolume& drawn, const DrawnValues& values, const MemoryNeed& need, double limitMiB)
{
  BrickView view;
  view.frame = frameOf(drawn, values);
  vtkRenderWindow* window = drawn.renderer->GetRenderWindow();
  const int type = window->GetStereoType();
  const bool isStereo = window->GetStereoRender() != 0;
  // ParaView saves the eyes one by one, and composes them.
  view.isOfBoth = isStereo && type != VTK_STEREO_LEFT && type != VTK_STEREO_RIGHT;
  view.eye = isStereo && !isLeftEye(drawn) ? 1 : 0;
  view.limitMiB = limitMiB;
  view.leaveRoomFor(need.total());
  view.setMiB = limitMiB;
  return view;
}

std::optional<FineGrid> levelFor(const DrawnValues& values, const std::vector<Grid>& finer,
  const BrickView& view, double pixelsWide)
{
  const double pixelMm = (view.ofSlices ? 1.0 : WidestOfRays) * pixelsWide * pixelAt(values, view);
  const auto sides = [&](const glm::dvec3& voxels) {
    glm::dvec3 mm;
    for (int axis = 0; axis < 3; ++axis)
    {
      mm[axis] = glm::length(glm::dvec3(view.frame.worldFromTexture[axis])) / voxels[axis];
    }
    return mm;
  };
  glm::dvec3 held = sides(glm::dvec3(values.layout.dimensions));
  std::optional<FineGrid> found;
  for (std::size_t level = finer.size(); level-- > 0;)
  {
    const std::optional<FineGrid> fine = placed(values, finer[level], level);
    const glm::dvec3 mm = fine ? sides(fine->voxelFromTexture) : held;
    const auto isSeen = glm::greaterThan(held, glm::dvec3(pixelMm));
    const auto isFiner = glm::lessThan(mm, 0.99 * held); // along one axis is enough
    if ((isSeen.x && isFiner.x) || (isSeen.y && isFiner.y) || (isSeen.z && isFiner.z))
    {
      found = fine;
      held = mm;
    }
  }
  return found;
}

void BrickView::leaveRoomFor(std::int64_t bytes)
{
  if (this->limitMiB > 0.0)
  {
    this->limitMiB = std::max(this->limitMiB - static_cast<double>(bytes) / BytesInMiB, LeastMiB);
  }
}

namespace
{
// Other choices are drawn from the volume's own level alone. Nearest does not stream: between two
// voxels, a brick may round to another one than the volume does.
bool accepts(const TissueRequest& tissue, bool ofSlices)
{
  const DrawnComponents drawn = drawnComponents(tissue.property, tissue.values.scalars);
  const bool isBlended = ofSlices || tissue.blend == Blend::Composite;
  return isBlended && !tissue.nearest && tissue.opacity == Opacity::Scalar && !tissue.compared &&
    !tissue.labels && !tissue.segment.segmentation.labels && drawn.coloring == Coloring::Mapped &&
    drawn.scalar >= 0 && !CategoryScalars::areWanted(tissue.property);
}
}

// A file with levels has numbers on points, in RAS.
FinerBy finerVoxelsBy(vtkImageData* image, const TissueRequest& tissue, bool ofSlices)
{
  const DrawnValues& values = tissue.values;
  if (!accepts(tissue, ofSlices) || values.layout.voxels != values.grid.dimensions ||
    worldAxesOf(image) == WorldAxes::LPS)
  {
    return FinerBy::Nothing;
  }
  return image->GetFieldData()->GetArray(LevelArray) ? FinerBy::Level : FinerBy::Pyramid;
}

// Whether the room for bricks suits the limit. What else is drawn takes more or less of it from
// picture to picture; bricks that fit are not read again for that.
bool StreamedBricks::hasRoomFor(const BrickView& view) const
{
  if (view.setMiB != this->SetMiB || // which a message may have asked for
    this->Growth * view.mostBricks > this->MostBricks)
  {
    return false;
  }
  if (view.limitMiB == this->LimitMiB)
  {
    return true;
  }
  const glm::dvec3 slots(this->Table.slots());
  const double held = slots.x * slots.y * slots.z * SlotVoxels * this->Bytes / BytesInMiB;
  return view.limitMiB > 0.0 && this->LimitMiB > 0.0 && held > 0.0 && held <= view.limitMiB &&
    view.limitMiB < MoreRoom * this->LimitMiB;
}

void StreamedBricks::chooseLevel(const BrickView& view, const TissueRequest& tissue)
{
  const std::vector<Grid> grids = this->Loader ? this->Loader->grids() : std::vector<Grid>();
  this->Accepted = this->Loader && accepts(tissue, view.ofSlices);
  this->KnewGrids = !grids.empty();
  std::optional<FineGrid> level;
  if (this->Accepted)
  {
    // A camera that moves a little at the border between two levels changes nothing.
    const std::optional<FineGrid> finer = levelFor(tissue.values, grids, view, 1.0 / StaysFiner);
    level = finer == this->Level ? finer : levelFor(tissue.values, grids, view);
  }
  const BrickOrder order{ level.value_or(FineGrid()), tissue.values.layout.dimensions,
    drawnComponents(tissue.property, tissue.values.scalars).scalar };
  const bool isSame = level == this->Level && order == this->Order && this->hasRoomFor(view);
  if (!isSame)
  {
    if (this->Loader)
    {
      this->Loader->order(order, {}); // bricks of the former order must not come
    }
    this->Table.reset(glm::ivec3(0), glm::ivec3(0));
    this->Pages = nullptr;
    this->Atlas = nullptr;
    this->IsRefused = false;
    this->LimitMiB = view.limitMiB;
    this->SetMiB = view.setMiB;
    this->MostBricks = this->Growth * view.mostBricks;
    this->Level = level;
    this->Order = order;
    this->forgetBricks();
  }
}

void StreamedBricks::forgetBricks()
{
  this->Failed.clear();
  this->Wanted.clear();
  this->Quiet = { 0, 0 };
  this->Full = { false, false };
  this->Lost = { 0, 0 };
  this->Changes += 1;
}

void StreamedBricks::plan(GpuTask& gpu, const BrickView& view, TissueRequest& tissue)
{
  std::optional<LevelSource> source = finerLevelsOf(tissue.values.scalars);
  if (source && !(source->grid == tissue.values.grid)) // a part, or placed anew by a filter
  {
    source = std::nullopt;
  }
  if (!(source == this->Source))
  {
    this->release(gpu.window);
    this->Source = source;
    this->Loader = source ? std::make_unique<BrickLoader>(*source) : nullptr;
  }
  gpu.remarks.push_back(this->problem());
  this->Asks = view.asks;
  this->Eye = view.eye;
  this->IsOfBoth = view.isOfBoth;
  this->QuietPictures = view.ofSlices ? QuietPicturesOfSlices : QuietPicturesOfRays;
  this->chooseLevel(view, tissue);
  this->Bytes = ScalarTexture::bytesOf(tissue.values.scalars, this->Order.component);
  if (!this->Level || (!this->Atlas && !this->allocate(gpu)))
  {
    return;
  }
  const ValueLayout& layout = tissue.values.layout;
  const glm::dvec3 finer =
    this->Level->voxelFromTexture / glm::dvec3(layout.dimensions * layout.perTexel);
  const glm::dvec3 sides = tissue.values.grid.spacing * glm::dvec3(tissue.values.grid.dimensions);
  if (tissue.usualStep)
  {
    tissue.stepMm = std::max(tissue.stepMm / std::max({ finer.x, finer.y, finer.z }),
      glm::length(sides) / MostSamplesOfRay);
  }
  tissue.gradients = GradientSource::OnTheFly;
}

namespace
{

std::int64_t countOf(const glm::ivec3& side)
{
  return static_cast<std::int64_t>(side.x) * side.y * side.z;
}

// So many slots, some less or, if `orMore`, some more, in a block as nearly a cube as is simple.
glm::ivec3 slotsASide(std::int64_t slots, int most, bool orMore)
{
  const auto within = [most](double side) { return std::clamp(static_cast<int>(side), 1, most); };
  glm::ivec3 side(1);
  side.x = within(std::cbrt(static_cast<double>(slots)));
  side.y = within(std::sqrt(static_cast<double>(slots) / side.x));
  const double layers = static_cast<double>(slots) / (side.x * side.y);
  side.z = within(orMore ? std::ceil(layers) : layers);
  return side;
}
}

// Half of what is asked for, and so on, where the GPU refuses.
bool StreamedBricks::allocate(GpuTask& gpu)
{
  if (this->IsRefused)
  {
    return false;
  }
  const bool isSixteenBits = this->Bytes == 2;
  const double freeMiB = freeMemoryMiB(gpu.window);
  const double usualMiB =
    freeMiB == UnknownMemory ? UsualLimitMiB : std::min(UsualLimitMiB, 0.5 * freeMiB);
  const double allowed = this->LimitMiB > 0.0 ? this->LimitMiB : usualMiB;
  const glm::ivec3 bricks = this->Order.fine.bricks();
  const std::int64_t inLevel = countOf(bricks);
  const std::int64_t all = this->MostBricks > 0 ? std::min(inLevel, this->MostBricks) : inLevel;
  const int longest = vtkTextureObject::GetMaximumTextureSize3D(gpu.window) / SlotSideVoxels;
  const auto most = static_cast<std::int64_t>(allowed * BytesInMiB / (this->Bytes * SlotVoxels));
  std::int64_t slots = std::min(all, most);
  for (; slots >= std::min<std::int64_t>(LeastSlots, all); slots /= 2)
  {
    const int mostASide = std::min(longest, static_cast<int>(PageTable::MostSlotsASide));
    glm::ivec3 side = slotsASide(slots, mostASide, slots == all);
    if (countOf(side) > most)
    {
      side = slotsASide(slots, mostASide, false);
    }
    const glm::ivec3 texels = side * SlotSideVoxels;
    this->Atlas =
      makeTexture(gpu.window, isSixteenBits ? GL_R16 : GL_R32F, vtkTextureObject::Linear);
    this->Pages = makeTexture(gpu.window, GL_RGBA8, vtkTextureObject::Nearest);
    this->Table.reset(bricks, side);
    std::vector<std::uint8_t> pages = this->Table.texels();
    if (textureProblem(gpu.window, texels).empty() && textureProblem(gpu.window, bricks).empty() &&
      this->Atlas->Create3DFromRaw(
        texels.x, texels.y, texels.z, 1, isSixteenBits ? VTK_UNSIGNED_SHORT : VTK_FLOAT, nullptr) &&
      this->Pages->Create3DFromRaw(
        bricks.x, bricks.y, bricks.z, 4, VTK_UNSIGNED_CHAR, pages.data()) &&
      !takeOutOfMemory())
    {
      this->IsCapped = slots == all && all < inLevel;
      return true;
    }
    takeOutOfMemory();
    this->Atlas = nullptr;
    this->Pages = nullptr;
  }
  this->IsRefused = true;
  this->Table.reset(glm::ivec3(0), glm::ivec3(0));
  gpu.remarks.push_back("Finer voxels are not drawn: the graphics card has no memory for bricks of "
                        "them; " +
    std::to_string(static_cast<int>(allowed)) + " MiB are allowed");
  return false;
}

// A brick that this view has used stays; where the view changes, others may take its place.
void StreamedBricks::beginView()
{
  this->View += 1;
  this->Quiet[this->Eye] = 0;
  this->Full[this->Eye] = false;
  this->Lost[this->Eye] = 0;
  this->Wanted.clear();
}

// What could not be read is asked for again after a while.
bool StreamedBricks::asks(bool isChanged) const
{
  const Clock::time_point now = Clock::now();
  const bool mayBeMended = std::any_of(this->Failed.begin(), this->Failed.end(),
    [now](const auto& failed) { return failed.second <= now; });
  return this->Asks && (isChanged || mayBeMended || !this->isQuiet(this->Eye));
}

// Each kind once: where the file is damaged, and where nothing of it can be read.
void StreamedBricks::report(GpuTask& gpu, const ReadBrick& read)
{
  bool& isReported = read.numbers.empty() ? this->ReportedLoss : this->ReportedDamage;
  if (!read.remark.empty() && !std::exchange(isReported, true))
  {
    gpu.remarks.push_back(read.remark);
  }
}

// Only the part of the picture where a brick came is cast again, unless another one had to go.
void StreamedBricks::place(const ReadBrick& read, TissueTextures& textures, SceneBricks& bricks)
{
  if (read.numbers.empty())
  {
    this->Failed[read.brick] = Clock::now() + FileMendsIn;
    this->Changes += 1; // its rays name others
    return;
  }
  const bool isFull = this->Table.count() == this->Table.capacity();
  // A brick that an earlier view asked for is the first to go.
  const bool isWanted =
    std::find(this->Wanted.begin(), this->Wanted.end(), read.brick) != this->Wanted.end();
  const int slot = this->Table.slotOf(read.brick) == PageTable::None
    ? this->Table.take(read.brick, isWanted ? this->View : this->View - 1)
    : PageTable::None;
  if (slot == PageTable::None)
  {
    return; // it is there already, or there is no room any more
  }
  const glm::ivec3 first = this->Table.positionOf(slot) * SlotSideVoxels;
  const IndexBox box{ first, first + SlotSideVoxels - 1 };
  const bool floats = !read.numbers.floats.empty();
  replaceTexels(this->Atlas,
    { box, GL_RED, static_cast<unsigned int>(floats ? GL_FLOAT : GL_UNSIGNED_SHORT),
      floats ? static_cast<const void*>(read.numbers.floats.data())
             : read.numbers.sixteenBits.data() });
  textures.widenRanges(read.ranges.first, read.ranges.found);
  this->Changes += isFull ? 1 : 0;
  bricks.arrived.push_back(read.brick);
}

void StreamedBricks::uploadPages()
{
  const glm::ivec2 layers = this->Table.takeChangedLayers();
  if (layers.x < layers.y)
  {
    const glm::ivec3 side = this->Table.bricks();
    const std::size_t first = 4 * static_cast<std::size_t>(layers.x) * side.x * side.y;
    replaceTexels(this->Pages,
      { { glm::ivec3(0, 0, layers.x), glm::ivec3(side.x, side.y, layers.y) - 1 }, GL_RGBA,
        GL_UNSIGNED_BYTE, &this->Table.texels()[first] });
  }
}

void StreamedBricks::upload(GpuTask& gpu, TissueTextures& textures, SceneBricks& bricks)
{
  bricks = SceneBricks();
  if (!this->Level || !this->Atlas)
  {
    return;
  }
  if (this->RangesOf != textures.scalars()) // its ranges are as they were read
  {
    this->RangesOf = textures.scalars();
    this->Table.reset(glm::ivec3(this->Table.bricks()), glm::ivec3(this->Table.slots()));
    this->forgetBricks();
  }
  for (const ReadBrick& read :
    this->Loader->take(gpu.moving ? MostBricksInPicture / 16 : MostBricksInPicture))
  {
    this->place(read, textures, bricks);
    this->report(gpu, read);
  }
  this->uploadPages();
  this->Stored = textures.stored();
  bricks.pages = this->Pages;
  bricks.atlas = this->Atlas;
  bricks.voxels = glm::dvec3(this->Level->voxels);
  bricks.voxelFromTexture = this->Level->voxelFromTexture;
  bricks.voxelOfTextureZero = this->Level->voxelOfTextureZero;
  bricks.seed = { 7 * this->Pictures, 3 * this->Pictures };
  bricks.changes = this->Changes;
}

std::optional<double> StreamedBricks::numberAt(vtkWindow* window, const glm::dvec3& place) const
{
  auto drawn = vtkOpenGLRenderWindow::SafeDownCast(window);
  if (!drawn || !this->Level || !this->Atlas || !this->Source)
  {
    return std::nullopt;
  }
  const FineGrid& fine = *this->Level;
  const glm::ivec3 voxel =
    glm::clamp(glm::ivec3(glm::floor(place * fine.voxelFromTexture + fine.voxelOfTextureZero)),
      glm::ivec3(0), fine.voxels - 1);
  const glm::ivec3 brick = voxel / StreamedSide;
  const glm::ivec3 bricks = fine.bricks();
  const int slot = this->Table.slotOf((brick.z * bricks.y + brick.y) * bricks.x + brick.x);
  if (slot == PageTable::None)
  {
    return std::nullopt;
  }
  drawn->MakeCurrent();
  const glm::ivec3 texel =
    this->Table.positionOf(slot) * SlotSideVoxels + SlotBorder + voxel - brick * StreamedSide;
  const double stored = readVolume(drawn, this->Atlas, texel, glm::ivec3(1)).front().x;
  const double number = stored * this->Stored.scale + this->Stored.shift;
  const bool isWhole = this->Source->type != VTK_FLOAT && this->Source->type != VTK_DOUBLE;
  return isWhole ? std::round(number) : number; // the texture holds fractions of the range
}

void StreamedBricks::finish(const std::vector<glm::vec2>& wishes)
{
  this->AsksAgain = false;
  if (!this->Level || !this->Atlas)
  {
    return;
  }
  if (wishes.empty()) // nothing was cast: the picture before is shown, and asks for nothing more
  {
    this->Quiet[this->Eye] += this->Asks && this->Wanted.empty() ? 1 : 0;
    return;
  }
  this->Pictures += 1;
  std::map<int, int> pixels; // of each brick that is missing
  glm::vec2 last(-1.0f);     // neighbours often name the same
  int* count = nullptr;
  for (const glm::vec2& wish : wishes)
  {
    if (wish.x >= 0.0f)
    {
      count = wish.x == last.x ? count : &pixels[static_cast<int>(wish.x)];
      *count += 1;
      last.x = wish.x;
    }
    if (wish.y >= 0.0f && wish.y != last.y)
    {
      this->Table.use(static_cast<int>(wish.y), this->View);
      last.y = wish.y;
    }
  }
  for (const int brick : this->Wanted) // of the same view, and not there yet
  {
    pixels.emplace(brick, 0);
  }
  this->Wanted = this->inOrder(pixels);
  this->Loader->order(this->Order, this->Wanted);
  const bool grows = this->IsCapped && this->Full[this->Eye];
  if (grows) // the next picture has room for twice as many
  {
    this->Growth *= 2;
    this->Full[this->Eye] = false;
  }
  if (!this->Wanted.empty() || grows)
  {
    this->Quiet[this->Eye] = 0;
    return;
  }
  this->Quiet[this->Eye] += 1;
  this->AsksAgain = this->Quiet[this->Eye] == 1;
}

namespace
{
// The place of a brick along a Z-order curve (Morton, A computer oriented geodetic data base,
// 1966), which leads through each block of 2, 4, 8 ... bricks a side before the next.
std::uint64_t alongCurve(const glm::ivec3& position)
{
  constexpr int Bits = 20;
  std::uint64_t place = 0;
  for (int bit = Bits - 1; bit >= 0; --bit)
  {
    for (int axis = 2; axis >= 0; --axis)
    {
      place = 2 * place + (position[axis] >> bit & 1);
    }
  }
  return place;
}

// Bricks in the order in which they are read: those of one cube together, because they share chunks
// of the file. `asked`: with minus the number of pixels that ask for each; the cube of most is
// first.
std::vector<int> inCubes(const FineGrid& fine, const std::vector<std::pair<int, int>>& asked)
{
  constexpr int CubeBits = 9; // of a place: eight bricks a side
  std::map<std::uint64_t, int> ofCubes;
  std::vector<std::pair<std::uint64_t, int>> places;
  places.reserve(asked.size());
  for (const auto& [pixels, brick] : asked)
  {
    places.emplace_back(alongCurve(fine.positionOf(brick)), brick);
    ofCubes[places.back().first >> CubeBits] += pixels;
  }
  std::sort(places.begin(), places.end(), [&](const auto& a, const auto& b) {
    const int pixelsOfA = ofCubes[a.first >> CubeBits];
    const int pixelsOfB = ofCubes[b.first >> CubeBits];
    return pixelsOfA != pixelsOfB ? pixelsOfA < pixelsOfB : a.first < b.first;
  });
  std::vector<int> bricks;
  bricks.reserve(places.size());
  for (const auto& [place, brick] : places)
  {
    bricks.push_back(brick);
  }
  return bricks;
}
}

// Those that can come, if there is no room for all: the bricks of most pixels.
std::vector<int> StreamedBricks::inOrder(const std::map<int, int>& pixels)
{
  const Clock::time_point now = Clock::now();
  for (auto failed = this->Failed.begin(); failed != this->Failed.end();)
  {
    failed = failed->second <= now ? this->Failed.erase(failed) : std::next(failed);
  }
  std::vector<std::pair<int, int>> sorted;
  this->Lost[this->Eye] = 0;
  for (const auto& [brick, count] : pixels)
  {
    if (this->Failed.count(brick) > 0)
    {
      this->Lost[this->Eye] += 1;
    }
    else if (this->Table.slotOf(brick) == PageTable::None)
    {
      sorted.emplace_back(-count, brick);
    }
  }
  std::sort(sorted.begin(), sorted.end());
  const std::size_t room = this->Table.room(this->View);
  this->Full[this->Eye] = sorted.size() > room;
  sorted.resize(std::min(sorted.size(), room));
  return inCubes(this->Order.fine, sorted);
}

// Each eye has rays of its own.
std::int64_t StreamedBricks::wanted() const
{
  const int other = this->IsOfBoth ? 1 - this->Eye : this->Eye;
  return this->wantedUntil(this->isQuiet(this->Eye) && this->isQuiet(other));
}

std::int64_t StreamedBricks::wantedByEye() const
{
  return this->wantedUntil(this->isQuiet(this->Eye));
}

std::int64_t StreamedBricks::wantedUntil(bool isQuiet) const
{
  if (!this->Asks || !this->Loader || !this->Accepted || !this->Loader->problem().empty())
  {
    return 0;
  }
  if (!this->KnewGrids)
  {
    return 1; // a picture that knows them is to come
  }
  const std::int64_t waiting = this->Level && this->Atlas ? this->Loader->waiting() : 0;
  const bool isSure = !this->Level || !this->Atlas || isQuiet;
  return waiting > 0 ? waiting : isSure ? 0 : 1;
}

bool StreamedBricks::isQuiet(int eye) const
{
  return this->Quiet[eye] >= this->QuietPictures;
}

std::string StreamedBricks::problem() const
{
  return this->Loader ? this->Loader->problem() : std::string();
}

bool StreamedBricks::lacksRoom() const
{
  return this->Asks && this->Level && this->Atlas &&
    (this->Full[this->Eye] || (this->IsOfBoth && this->Full[1 - this->Eye]));
}

bool StreamedBricks::isWorthAPicture() const
{
  return this->wanted() > 0 && this->Loader->isDone();
}

bool StreamedBricks::waitForMore(const Clock::time_point& end) const
{
  while (this->wantedByEye() > 0 && !this->Loader->isDone() && Clock::now() < end)
  {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return this->wantedByEye() > 0 && (Clock::now() < end || this->Loader->countRead() > 0);
}

void StreamedBricks::count(Counters& counters) const
{
  if (this->Level && this->Atlas)
  {
    counters.gpuLevel = static_cast<std::int64_t>(this->Level->level);
    counters.gpuBricks += this->Table.count();
    counters.gpuBricksLackRoom += this->lacksRoom() ? 1 : 0;
  }
  counters.gpuBricksWanted += this->wanted();
  counters.gpuBricksComing += this->wanted() > 0 && !this->isWorthAPicture() ? 1 : 0;
  counters.gpuBricksRead += this->Loader ? this->Loader->countRead() : 0;
}

void StreamedBricks::release(vtkWindow* window)
{
  for (vtkTextureObject* texture : { this->Atlas.Get(), this->Pages.Get() })
  {
    if (texture)
    {
      texture->ReleaseGraphicsResources(window);
    }
  }
  *this = StreamedBricks();
}
}
