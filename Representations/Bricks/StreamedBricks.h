// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Bricks of a finer level of the volume that is drawn, on the GPU of one window: those that rays
/// or slices asked for, as far as memory goes.
#ifndef BrainShift_StreamedBricks_h
#define BrainShift_StreamedBricks_h

#include "Representations/Bricks/BrickLoader.h"
#include "Representations/Bricks/PageTable.h"
#include "Representations/Scene/SceneFrame.h"
#include "Representations/Tissue/TissueTextures.h"

#include <array>
#include <chrono>
#include <map>

namespace brainshift
{
/// The view that bricks are chosen for.
struct BrickView
{
  SceneFrame frame;
  glm::ivec2 pixels{ 0 }; ///< Of the picture, a side.
  double limitMiB = 0.0;  ///< For the bricks; 0: as much as is usual.
  double setMiB = 0.0;    ///< The limit of all memory that a user set; 0: none.
  bool asks = true;       ///< Rays ask for bricks.
  int eye = 0;            ///< 1: the right one of two.
  bool isOfBoth = false;  ///< The other eye is drawn into the same picture.

  /// Slices are drawn, not rays: a pixel reads one brick, and names it in the first picture.
  bool ofSlices = false;
  std::vector<glm::dvec3> corners; ///< Of what is drawn, texture coordinates; none: the volume's.
  std::int64_t mostBricks = 0;     ///< More are seldom asked for; 0: unknown.

  /// Takes so much from the limit, if there is one.
  void leaveRoomFor(std::int64_t bytes);
};

/// The view of the camera that draws now. `need`: the memory of all else. `limitMiB`: of all
/// memory; 0: none.
BrickView brickViewOf(
  const DrawnVolume& drawn, const DrawnValues& values, const MemoryNeed& need, double limitMiB);

/// Whether the camera draws the left one of two eyes.
bool isLeftEye(const DrawnVolume& drawn);

/// The level that suits a view: the coarsest whose voxels are no longer than a pixel is wide where
/// the view's corners are nearest to the eye, or else the finest. Rays take voxels of up to 1.41
/// pixels, as OpenGL takes the nearest of a texture's levels: what they see lies behind that
/// corner. None: the volume's own is fine enough, or no finer one has its axes.
/// `pixelsWide`: so many pixels count as one.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT std::optional<FineGrid> levelFor(const DrawnValues& values,
  const std::vector<Grid>& finer, const BrickView& view, double pixelsWide = 1.0);

/// What would bring bricks to a volume that is drawn coarser. `ofSlices`: see BrickView.
FinerBy finerVoxelsBy(vtkImageData* image, const TissueRequest& tissue, bool ofSlices);

/// Begins the counters of bricks anew, which StreamedBricks::count adds to.
inline void resetDetail(Counters& counters)
{
  counters.gpuLevel = -1;
  counters.gpuBricks = counters.gpuBricksWanted = counters.gpuBricksRead = 0;
  counters.gpuBricksLackRoom = counters.gpuBricksComing = 0;
}

/// Calls for one picture: plan, upload, and finish once it is cast. A picture without them, or one
/// that failed, calls rest.
class StreamedBricks
{
public:
  /// Chooses the level. If one is streamed, `tissue` is changed to be sampled as finely by rays.
  void plan(GpuTask& gpu, const BrickView& view, TissueRequest& tissue);

  /// Sends bricks that have arrived to the GPU and fills the scene's bricks. `textures` are up to
  /// date; the bricks' ranges widen theirs.
  void upload(GpuTask& gpu, TissueTextures& textures, SceneBricks& bricks);

  /// The view is another than that of the last picture of this eye. After upload.
  void beginView();

  /// Whether rays are to ask for bricks, after upload. `isChanged`: they may see other tissue than
  /// in the last picture of this eye.
  bool asks(bool isChanged) const;

  /// Orders what the pixels of a picture asked for: for each two bricks, one that is not there and
  /// one that is, or a number below 0. Empty: nothing was asked.
  void finish(const std::vector<glm::vec2>& wishes);

  /// The rays of the last picture are to ask once more, each for another brick.
  bool asksAgain() const { return this->AsksAgain; }

  /// Nothing more is wanted until the next plan.
  void rest() { this->Asks = false; }

  /// Bricks that this view waits for, with both eyes; 1 where only another picture can tell.
  std::int64_t wanted() const;

  /// The same of the eye of the last picture alone.
  std::int64_t wantedByEye() const;

  /// The eye of the last picture: 1 for the right one of two, else 0.
  int eye() const { return this->Eye; }

  /// A sentence if the finer levels cannot be read; else empty.
  std::string problem() const;

  /// Whether the next picture shows more, or tells more, than one a little later would not.
  bool isWorthAPicture() const;

  using Clock = std::chrono::steady_clock;

  /// Waits until the next picture of this eye is worth it, but not longer than until `end`. False:
  /// nothing more is wanted, or nothing was read until then.
  bool waitForMore(const Clock::time_point& end) const;

  /// The view asks for more than there is room for.
  bool lacksRoom() const;

  /// Bricks that the view asks for and that cannot be read now.
  int lost() const { return this->Lost[this->Eye]; }

  /// Whether bricks of a finer level suit what is drawn.
  bool isStreamed() const { return this->Level && this->Atlas; }

  /// The number of the voxel of the finer level that is drawn at a place of the volume (texture
  /// coordinates), which the GPU is asked for. None: its brick is not there.
  std::optional<double> numberAt(vtkWindow* window, const glm::dvec3& place) const;

  /// Adds the present state to the counters. The GPU is not asked.
  void count(Counters& counters) const;

  /// All textures; some may be null.
  std::vector<vtkTextureObject*> textures() const { return { this->Atlas, this->Pages }; }

  void release(vtkWindow* window);

private:
  bool hasRoomFor(const BrickView& view) const;
  void chooseLevel(const BrickView& view, const TissueRequest& tissue);
  bool allocate(GpuTask& gpu);
  void forgetBricks();
  void place(const ReadBrick& read, TissueTextures& textures, SceneBricks& bricks);
  std::vector<int> inOrder(const std::map<int, int>& pixels);
  void report(GpuTask& gpu, const ReadBrick& read);
  void uploadPages();
  bool isQuiet(int eye) const;
  std::int64_t wantedUntil(bool isQuiet) const;

  std::optional<LevelSource> Source;
  std::unique_ptr<BrickLoader> Loader; // null: there are no finer levels
  bool Asks = false;                   // the last picture was one that asks
  int QuietPictures = 2;               // without a wish, until nothing is missing
  bool Accepted = false;               // by what is drawn
  bool KnewGrids = false;              // at the last plan
  std::optional<FineGrid> Level;       // that is streamed now
  BrickOrder Order;
  StoredScalar Stored; // of the numbers in the atlas
  PageTable Table;
  vtkSmartPointer<vtkTextureObject> Atlas;
  vtkSmartPointer<vtkTextureObject> Pages;
  int Bytes = 4;                             // of a voxel
  double LimitMiB = 0.0;                     // see BrickView
  double SetMiB = 0.0;                       // see BrickView
  std::int64_t MostBricks = 0;               // see BrickView, times Growth
  std::int64_t Growth = 1;                   // where a view sees more bricks than it says
  bool IsCapped = false;                     // by MostBricks, and not by the memory
  bool IsRefused = false;                    // the memory for it
  vtkWeakPointer<vtkTextureObject> RangesOf; // whose ranges were widened
  std::map<int, Clock::time_point> Failed;   // bricks that cannot be read until then
  std::vector<int> Wanted;                   // as ordered last
  bool ReportedDamage = false;               // of this source: coarser voxels are in its place
  bool ReportedLoss = false;                 // of this source: there are none
  int Eye = 0;                               // of the last picture
  bool IsOfBoth = false;
  std::int64_t View = 0;    // counts views
  std::int64_t Changes = 0; // counts changes of what is there, but for bricks that came
  bool AsksAgain = false;
  int Pictures = 0;
  std::array<int, 2> Quiet{ 0, 0 };         // pictures of each eye in a row without a wish
  std::array<bool, 2> Full{ false, false }; // its view asks for more than there is room for
  std::array<int, 2> Lost{ 0, 0 };          // bricks that it asks for and that cannot be read
};
}

#endif
