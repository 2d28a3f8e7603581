// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkWholeVolumeRepresentation
 * @brief   a volume that MPI ranks draw bent
 *
 * Data delivery, colour maps and transforms are those of ParaView's "Volume", with one difference.
 * On several MPI ranks, ParaView gives each rank a block of the volume at rest. Bent tissue crosses
 * the borders of such blocks, and bent blocks have no order in depth. So each rank draws a box of
 * the *deformed* frame. It gets the voxels whose tissue can come into that box from the ranks that
 * hold them (Window/RankParts.h, Common/SharedVolume.h). What cannot be drawn so is drawn by the
 * first rank alone: surfaces in the view follow it there.
 */
#ifndef vtkWholeVolumeRepresentation_h
#define vtkWholeVolumeRepresentation_h

#include "vtkBrainShiftRepresentationsModule.h" // for the export macro
#include "vtkImageVolumeRepresentation.h"
#include "vtkNew.h" // for the legend

#include <array>  // for extents
#include <memory> // for what ranks share
#include <string> // for its sentences
#include <vector> // for the volumes of a view

class vtkImageData;
class vtkPVRenderView;

namespace brainshift
{
class EvidenceLegend;
class ReferencePart;
class SharedVolume;
class WindowText;
struct DrawnPart;
struct Lattice;
struct TissueCounts;
struct WholeVolume;
}

class VTKBRAINSHIFTREPRESENTATIONS_EXPORT vtkWholeVolumeRepresentation
  : public vtkImageVolumeRepresentation
{
public:
  vtkAbstractTypeMacro(vtkWholeVolumeRepresentation, vtkImageVolumeRepresentation);
  void PrintSelf(ostream& os, vtkIndent indent) override;
  vtkTypeBool ProcessRequest(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

  /** Shown or not, and the legend with it. */
  void SetVisibility(bool visible) override;

  /** Text in the upper left corner of the view, for example which of two volumes has which colour.
   * Empty (default) or null: none. */
  void SetLegend(const char* text);

  /** Whether tissue is tinted by the uncertainty of its position (one standard deviation, mm), with
   * a legend in the upper right corner of the view. Default false. */
  virtual void SetShowEvidence(bool show);

  int ProcessViewRequest(
    vtkInformationRequestKey* request, vtkInformation* input, vtkInformation* output) override;

  ///@{
  /** How far beyond what it needs a rank has voxels (mm), so that strokes to come ask for none.
   * Default 10. Only several MPI ranks use it. */
  void SetRankHalo(double halo);
  vtkGetMacro(RankHalo, double);
  ///@}

  /** Bytes of the voxels that this process has in memory: those of its pipeline, and on several MPI
   * ranks those beyond them that it draws. */
  long long GetVoxelBytes() const;

protected:
  vtkWholeVolumeRepresentation();
  ~vtkWholeVolumeRepresentation() override;

  int RequestData(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

  bool AddToView(vtkView* view) override;
  bool RemoveFromView(vtkView* view) override;
  void UpdateMapperParameters() override;

  /** Marks the volume modified if several MPI ranks may draw: they may need other voxels then. */
  void MarkModifiedOnRanks();

  /** Whether the data carries a reference that is shown beside the volume. */
  bool CarriesComparison() const;

private:
  vtkWholeVolumeRepresentation(const vtkWholeVolumeRepresentation&) = delete;
  void operator=(const vtkWholeVolumeRepresentation&) = delete;

  /** Whether colours distinguish a volume and a reference, so that stripes show the uncertainty. */
  virtual bool ComparesInColors() const = 0;

  /** Why parts of the volume cannot be drawn by themselves; empty: they can. */
  virtual std::string WhyWhole() const { return {}; }
  /** The same, where the data of this process gives the reason. */
  virtual std::string WhyDataIsWhole() const { return {}; }
  /** Widens bounds (mm; x, y, z, least and greatest each) by where the volume's tissue can go. */
  virtual void WidenByTissue(vtkImageData*, double[6]) = 0;
  /** The lattice that bends the data of a volume; null: nothing moves. */
  virtual const brainshift::Lattice* LatticeOf(vtkImageData*) = 0;
  /** How far (mm) beside a place of the picture voxels are read for it. */
  virtual double ReadsBesideMm(vtkImageData*) const { return 0.0; }
  /** Adds the visible voxels of a part of the volume to those of a view. None (default): ranks that
   * draw nothing else get boxes of one size. */
  virtual void CountVisible(vtkImageData*, brainshift::TissueCounts&) {}
  /** Draws only a part of the deformed frame. Null: all of it. */
  virtual void SetDrawnPart(const brainshift::DrawnPart*) = 0;

  using Group = std::vector<vtkWholeVolumeRepresentation*>; // what a view shows, one or more
  struct Taken;

  static bool AreBehind(const Group& group);
  static void Overtake(const Group& group, vtkInformation* input);
  Group GroupIn(vtkPVRenderView* view);
  static std::string WhyWholeIn(vtkPVRenderView* view, const Group& group);
  static void ChooseWhoDraws(vtkPVRenderView* view, const Group& group);
  static void ShareOut(const Group& group, vtkInformation* input, vtkInformation* output);
  static void Bring(const Group& group, vtkInformation* input, vtkInformation* output);
  static void TakeVoxels(const Group& all);
  static std::string WhyBentUnlike(const Group& group);
  static std::string TakeExtents(const Group& group, bool drawsParts);
  static std::array<double, 6> ShareWork(
    const Group& group, const std::array<double, 6>& bounds, bool drawsParts, std::string& problem);
  static void KeepPicture(const Group& group, const std::string& sentence);
  std::string WhyPartIsWhole();
  Taken Measure(bool drawsParts, std::string& problem);
  void Want(
    const brainshift::WholeVolume& whole, const brainshift::DrawnPart* part, std::string& problem);
  void WantVoxelsOf(const brainshift::WholeVolume& whole, const std::array<double, 6>& part);
  std::array<double, 6> ReadFor(const std::array<double, 6>& part) const;
  void Draw(vtkImageData* volume);
  void WarnOfFirstRank(const std::string& reason);
  void ReportOnce(const std::string& sentence);
  void WidenBounds();

  vtkNew<brainshift::WindowText> Legend;
  vtkSmartPointer<brainshift::EvidenceLegend> Evidence;
  bool ShowEvidence = false;
  std::unique_ptr<brainshift::SharedVolume> Shared;
  std::unique_ptr<brainshift::ReferencePart> Reference; // of several ranks
  vtkSmartPointer<vtkImageData> Part;                   // of this process
  vtkSmartPointer<vtkImageData> Drawn; // on several ranks: the voxels of the last picture
  std::string Problem;                 // why this rank's part did not come
  std::string Reported;                // why a rank could not take part
  std::string WhyDrawnWhole;           // if the settings and the view say so
  std::string WarnedOf;                // why the first rank draws all
  bool PartsRefused = false;           // so the first rank draws all
  bool TriesParts = false;             // again
  Group Beside;                        // the view's volumes as last shared out, to compare only
  bool IsNew = false;                  // the part, since voxels were shared out
  bool IsDrawnElsewhere = false;
  bool MayDrawPart = false;  // as far as settings and the view say
  bool DrawsPart = false;    // of several ranks
  bool KeepsBoxes = false;   // also if their work is out of balance
  double RankHalo = 10.0;    // mm
  std::array<int, 6> Wanted; // extent of voxels to draw

  // Of its view, the same on all ranks.
  std::vector<std::array<double, 6>> RankBoxes;
  std::array<double, 6> AllBoxes{}; // that these are parts of
};

#endif
