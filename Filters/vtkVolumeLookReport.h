// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkVolumeLookReport
 * @brief   makes looks for a volume where its data is
 *
 * A look is colours, opacities and whether a segmentation is drawn alone, made from the histogram
 * of an array. The volume may lie on a server, in parts on several processes. This object lives
 * beside it, and the XML proxy of the same name brings its answers to the client.
 *
 * Set what is asked, call Measure or MeasureWindow in all processes, then read the answers.
 */
#ifndef vtkVolumeLookReport_h
#define vtkVolumeLookReport_h

#include "vtkBrainShiftFiltersModule.h" // for the export macro
#include "vtkNew.h"                     // for answers
#include "vtkObject.h"
#include "vtkWeakPointer.h" // for what is asked

#include <glm/vec3.hpp> // for points

#include <string> // for names
#include <vector> // for points

class vtkAlgorithm;
class vtkDoubleArray;
class vtkImageData;

class VTKBRAINSHIFTFILTERS_EXPORT vtkVolumeLookReport : public vtkObject
{
public:
  static vtkVolumeLookReport* New();
  vtkTypeMacro(vtkVolumeLookReport, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** The source whose output is the volume. It must be up to date. */
  void SetSource(vtkAlgorithm* source);

  ///@{
  /** Which output of the source. Default 0. */
  vtkSetMacro(Port, int);
  vtkGetMacro(Port, int);
  ///@}

  ///@{
  /** Whether the array has values of points (0, default) or cells (1). */
  vtkSetMacro(Association, int);
  vtkGetMacro(Association, int);
  ///@}

  ///@{
  /** The array that colours the volume. Default: none. */
  vtkSetMacro(ArrayName, std::string);
  vtkGetMacro(ArrayName, std::string);
  ///@}

  ///@{
  /** Which look to make. Empty (default): the first of the volume's looks. */
  vtkSetMacro(Look, std::string);
  vtkGetMacro(Look, std::string);
  ///@}

  ///@{
  /** Shares (%) of the tissue that are darker than the ends of Window, 0 to 100. Default 1, 99. */
  vtkSetVector2Macro(Percentiles, double);
  vtkGetVector2Macro(Percentiles, double);
  ///@}

  ///@{
  /** Width of the view for Camera as a fraction of its height. Default 1. */
  vtkSetMacro(ViewAspect, double);
  vtkGetMacro(ViewAspect, double);
  /** Angle of the height of the view for Camera, degrees. Default 30. */
  vtkSetMacro(ViewAngle, double);
  vtkGetMacro(ViewAngle, double);
  ///@}

  ///@{
  /** Reads the volume and makes the look. All processes of a server must call it. */
  void Measure();
  /** Reads the volume and finds Window, nothing else. All processes of a server must call it. */
  void MeasureWindow();
  ///@}

  ///@{
  /** "MR", "CT", "Ultrasound" or "Labels", guessed from the histogram. Empty without a volume. */
  const char* GetKind() const { return this->Kind.c_str(); }
  /** Names of the volume's looks, one in each line. */
  const char* GetNames() const { return this->Names.c_str(); }
  /** Value, red, green and blue (0 to 1) of each colour, rising. Empty if there is no such look. */
  vtkDoubleArray* GetColors() { return this->Colors; }
  /** Value and opacity (0 to 1), rising. */
  vtkDoubleArray* GetOpacities() { return this->Opacities; }
  /** Whether the look draws the attached segmentation alone. */
  bool GetDrawsSegment() const { return this->DrawsSegment; }
  /** x, y, z (mm, world, rest frame) of what the look shows farthest out. Empty: nothing. */
  vtkDoubleArray* GetTissuePoints() { return this->TissuePoints; }
  /**
   * A camera at which the tissue fills a view of ViewAspect: position, focal point, up (mm, world)
   * and parallel scale (mm). Empty if the look shows nothing.
   */
  vtkDoubleArray* GetCamera();
  /**
   * The values between which the tissue lies, without a dark background: see Percentiles. Empty if
   * the array has no two such values.
   */
  vtkDoubleArray* GetWindow() { return this->Window; }
  ///@}

  /** How often this process read a volume so far, for tests. */
  static int GetReadings();

protected:
  vtkVolumeLookReport();
  ~vtkVolumeLookReport() override;

private:
  vtkVolumeLookReport(const vtkVolumeLookReport&) = delete;
  void operator=(const vtkVolumeLookReport&) = delete;

  vtkImageData* ReadVolume() const;
  void MakeLook();
  void FindWindow();

  vtkWeakPointer<vtkAlgorithm> Source;
  int Port = 0;
  int Association = 0;
  std::string ArrayName;
  std::string Look;
  std::string Kind;
  std::string Names;
  vtkNew<vtkDoubleArray> Colors;
  vtkNew<vtkDoubleArray> Opacities;
  vtkNew<vtkDoubleArray> Window;
  vtkNew<vtkDoubleArray> Camera;
  vtkNew<vtkDoubleArray> TissuePoints;
  double Percentiles[2] = { 1.0, 99.0 };
  double ViewAspect = 1.0;
  double ViewAngle = 30.0;
  bool DrawsSegment = false;
  std::vector<glm::dvec3> Tissue; // mm, world, rest frame: its farthest points
};

#endif
