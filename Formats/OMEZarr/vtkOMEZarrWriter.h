// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkOMEZarrWriter
 * @brief   writes a volume as an OME-Zarr image with all its levels, piece by piece
 *
 * The input is asked for one piece after the other, so that memory holds a volume of any size whose
 * source streams. The store is a folder: chunks of 64 x 64 x 64 voxels, packed with blosc and zstd.
 * Each coarser level has means of up to 2 x 2 x 2 voxels, whole numbers rounded; labels have the
 * most frequent one. PyramidPlan.h says which axes are halved, and what our own metadata
 * hold: the direction matrix, the world's axes, and least and greatest values of the chunks.
 *
 * Input: an image whose point array is written, one time of it; a warning says so. Integers
 * of 8 bytes become those of 4. World is RAS: an input in LPS is turned.
 *
 * A folder that is not empty is refused, unless it is a store that was not finished. If that has
 * the same grid and type, the chunks of it that have the same voxels are kept. After an error or a
 * stop the folder remains, to be continued.
 *
 * On several MPI ranks each asks for all pieces, and the first one writes. If that fails, all stop.
 */
#ifndef vtkOMEZarrWriter_h
#define vtkOMEZarrWriter_h

#include "vtkBrainShiftFormatsModule.h" // for the export macro
#include "vtkWriter.h"

#include <memory> // for the private part
#include <string>

namespace brainshift
{
struct OutgoingVolume;
}

class VTKBRAINSHIFTFORMATS_EXPORT vtkOMEZarrWriter : public vtkWriter
{
public:
  static vtkOMEZarrWriter* New();
  vtkTypeMacro(vtkOMEZarrWriter, vtkWriter);
  void PrintSelf(ostream& os, vtkIndent indent) override;
  vtkTypeBool ProcessRequest(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int ModifyRequest(vtkInformation* request, int when) override;
  int Write() override;

  ///@{
  /** The folder to write, whose name ends in .zarr. Default: none, which is an error. */
  vtkSetMacro(FileName, std::string);
  vtkGetMacro(FileName, std::string);
  ///@}

  ///@{
  /** The point array to write. Default: none, which takes the active scalars. */
  vtkSetMacro(PointArray, std::string);
  vtkGetMacro(PointArray, std::string);
  ///@}

  ///@{
  /** The world of the input: 0 as the volume says (default), 1 RAS, 2 LPS. */
  vtkSetClampMacro(World, int, 0, 2);
  vtkGetMacro(World, int);
  ///@}

  ///@{
  /**
   * The most MiB that the voxels of one piece may take, at least those of one row of chunks.
   * Default: 512.
   */
  vtkSetClampMacro(MemoryLimit, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(MemoryLimit, double);
  ///@}

  ///@{
  /** 0: NGFF 0.4 on zarr 2 (default), 1: NGFF 0.5 on zarr 3. */
  vtkSetClampMacro(Version, int, 0, 1);
  vtkGetMacro(Version, int);
  ///@}

  ///@{
  /** Whether the values are labels: 0 as the volume says (default), 1 yes, 2 no. */
  vtkSetClampMacro(Labels, int, 0, 2);
  vtkGetMacro(Labels, int);
  ///@}

  /** Why the last run wrote no image: a sentence without a full stop. Empty if it wrote one. */
  vtkGetMacro(Problem, std::string);

  /** Pieces of the input whose voxels the last run found written, all of them. */
  vtkGetMacro(PiecesKept, int);

protected:
  vtkOMEZarrWriter();
  ~vtkOMEZarrWriter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  void WriteData() override {} // RequestData writes

private:
  vtkOMEZarrWriter(const vtkOMEZarrWriter&) = delete;
  void operator=(const vtkOMEZarrWriter&) = delete;

  struct Run;

  void AskForFirstPiece();
  bool TakePiece();
  void TakeVoxels(brainshift::OutgoingVolume& volume);
  void Begin(const brainshift::OutgoingVolume& volume);
  bool Go(double fraction);
  void RequireGoing(bool goes) const;
  bool FirstRankGoes(bool goes);

  std::string FileName;
  std::string PointArray;
  int World = 0;
  int Version = 0;
  int Labels = 0;
  double MemoryLimit = 512.0; // MiB
  std::string Problem = "Nothing was written";
  int PiecesKept = 0;
  bool HasEnded = false;     // the first rank has reported it
  std::unique_ptr<Run> Work; // while it runs
};

#endif
