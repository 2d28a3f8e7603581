// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTransformReader
 * @brief   reads the transforms of registration programs as displacement fields
 *
 * TransformFile.h lists the formats. Output: an image with the point array Displacement as its
 * vectors (float32 x 3, mm, world axes) and a field array that names the direction.
 *
 * Input (optional): the volume to bend. With it, the points of the output are the control points of
 * a lattice over the volume. Without it, they are those of the file's own B-spline or field.
 *
 * Kind, Matrix and MappedPoints need no pipeline: they read the files by themselves.
 */
#ifndef vtkTransformReader_h
#define vtkTransformReader_h

#include "vtkBrainShiftFiltersModule.h" // for the export macro
#include "vtkImageAlgorithm.h"

#include <memory> // for the private part
#include <string>

class vtkDoubleArray;
class vtkImageData;

namespace brainshift
{
struct Lattice;
struct PointTransform;
}

class VTKBRAINSHIFTFILTERS_EXPORT vtkTransformReader : public vtkImageAlgorithm
{
public:
  static vtkTransformReader* New();
  vtkTypeMacro(vtkTransformReader, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;
  vtkTypeBool ProcessRequest(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

  enum WorldType
  {
    RAS = 0, ///< x to the right, y to the front: the world of NIFTI Volume Reader
    LPS = 1, ///< x to the left, y to the back: the world of ITK and of ParaView's own readers
  };

  enum DirectionType
  {
    Forward = 0,  ///< deformedFromRest: where tissue goes
    Backward = 1, ///< restFromDeformed: which tissue is seen
  };

  ///@{
  /** The file. Default: none, which is an error. */
  vtkSetMacro(FileName, std::string);
  vtkGetMacro(FileName, std::string);
  ///@}

  ///@{
  /** Files that points of the fixed image pass after FileName. Default: none. */
  void AddLaterFileName(const char* fileName);
  void ClearLaterFileNames();
  ///@}

  ///@{
  /**
   * The NIfTI files that FSL's flirt or fnirt was given. Its matrices and warps need them; of an
   * LTA they say which end they are. Default: none.
   */
  vtkSetMacro(FixedImage, std::string);
  vtkGetMacro(FixedImage, std::string);
  vtkSetMacro(MovingImage, std::string);
  vtkGetMacro(MovingImage, std::string);
  ///@}

  enum FieldsBetweenType
  {
    Linear = 0, ///< as in ITK; half a cell outside its points a field moves nothing
    Held = 1, ///< as 3D Slicer shows them: cubic; outside its points a field moves as at its edge,
              ///< and B-splines fade to zero within two cells
  };

  ///@{
  /** How displacements between the points of a field are found. Default Linear. */
  vtkSetClampMacro(FieldsBetween, int, Linear, Held);
  vtkGetMacro(FieldsBetween, int);
  ///@}

  enum MatrixProgramType
  {
    UnknownProgram = 0, ///< FSL if an image is named; else such a file is an error
    FSL = 1,            ///< flirt's own millimetres, moving image to fixed image; needs both images
    NiftyReg = 2,       ///< RAS to RAS, fixed image to moving image
    SPM = 3,            ///< NIfTI files without an intent hold positions in RAS
  };

  ///@{
  /**
   * The program that wrote a text of 16 numbers, or a NIfTI file without an intent. Other files do
   * not need it. Default unknown.
   */
  vtkSetClampMacro(MatrixProgram, int, UnknownProgram, SPM);
  vtkGetMacro(MatrixProgram, int);
  ///@}

  ///@{
  /** The world in which the volumes to bend lie: RAS (default) or LPS. */
  vtkSetClampMacro(World, int, RAS, LPS);
  vtkGetMacro(World, int);
  ///@}

  ///@{
  /**
   * What the file's map from the fixed to the moving image is to the volume. Backward (default):
   * the volume was the moving image. Forward: it was the fixed image.
   */
  vtkSetClampMacro(Direction, int, Forward, Backward);
  vtkGetMacro(Direction, int);
  ///@}

  ///@{
  /** The direction of the output. Default Forward, which Free-Form Deformation needs. */
  vtkSetClampMacro(OutputDirection, int, Forward, Backward);
  vtkGetMacro(OutputDirection, int);
  ///@}

  ///@{
  /** With an input: control points along each axis, 4 to 257. Default 19 19 19. */
  vtkSetVector3Macro(LatticeDimensions, int);
  vtkGetVector3Macro(LatticeDimensions, int);
  ///@}

  ///@{
  /**
   * With an input, and forward: the kernel of the Free-Form Deformation (Kernels.h). For B-spline
   * the output holds coefficients whose cubic passes through the displacements. Default 0.
   */
  vtkSetClampMacro(Kernel, int, 0, 1);
  vtkGetMacro(Kernel, int);
  ///@}

  ///@{
  /** Points (mm, world) for GetMappedPoints. */
  void AddPoint(double x, double y, double z);
  void ClearPoints();
  ///@}

  /**
   * Where the file's own map takes the points (mm, world), and how far a position that had to be
   * solved misses (mm): four numbers each. Owned by this.
   */
  vtkDoubleArray* GetMappedPoints();

  /** Which points the file's own map takes to the points, likewise. */
  vtkDoubleArray* GetMappedBackPoints();

  /**
   * The ends along x, y and z of the points of the file's own B-spline or field (mm, world); empty
   * if it has none. Owned by this.
   */
  vtkDoubleArray* GetOwnBounds();

  /** What each file says and leads to, one line each: the ends of sentences after its name. */
  std::string GetStories();

  /** The file's own map (mm, world); the identity after a problem. */
  const brainshift::PointTransform& GetChain();

  /** "identity", "rigid", "affine" or "nonlinear"; empty after a problem. */
  std::string GetKind();

  /** False if World is a guess, as the file or the images that it counts from do not know it. */
  bool GetKnowsSides();

  /**
   * The rows of the 4 x 4 matrix that takes points of the fixed image to the moving one (mm,
   * world); empty if the map bends. Owned by this.
   */
  vtkDoubleArray* GetMatrix();

  /**
   * Why the files cannot be read, or the last run made no field: one sentence, without a full stop.
   * Empty if neither failed.
   */
  std::string GetProblem();

  /**
   * With an input, and forward: the largest distance (mm) between the lattice and the transform at
   * the middles of up to 20 x 20 x 20 cells, as of the last run. Else 0.
   */
  vtkGetMacro(LargestError, double);

  /** 1 if the file is a transform that is no displacement field. */
  static int CanReadFile(const char* fileName);

protected:
  vtkTransformReader();
  ~vtkTransformReader() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestUpdateExtent(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkTransformReader(const vtkTransformReader&) = delete;
  void operator=(const vtkTransformReader&) = delete;

  // Reads the files again if a property has changed since. Returns why it cannot.
  const std::string& Load();
  // Maps the points, or maps them back.
  vtkDoubleArray* MapPoints(bool isBack, vtkDoubleArray* to);
  // Takes the grid of the output: of the volume, or of the field in the files.
  void ChooseGrid(vtkInformation* volume);
  void FillField(vtkImageData* field, vtkInformation* volume);
  // Throws a Problem about displacements without a number. Those of an inverse become 0, with a
  // warning.
  void RequireNumbers(bool isOwnDirection, brainshift::Lattice& lattice);

  std::string FileName;
  std::string FixedImage;
  std::string MovingImage;
  int MatrixProgram = UnknownProgram;
  int FieldsBetween = Linear;
  int World = RAS;
  int Direction = Backward;
  int OutputDirection = Forward;
  int LatticeDimensions[3] = { 19, 19, 19 };
  int Kernel = 0;
  double LargestError = 0.0;
  struct State; // the transform as read
  std::unique_ptr<State> Internal;
};

#endif
