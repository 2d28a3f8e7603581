// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkDICOMPatientReport
 * @brief   says whom a DICOM series shows, when a user asks
 *
 * Name and number of a patient must not get into states, traces, field data or pictures, so
 * vtkVolumeFileReader never reads them. This object lives beside the reader for the time of one
 * question, and the XML proxy of the same name brings the answer to the client.
 *
 * Set Source, call Read, then read the answers.
 */
#ifndef vtkDICOMPatientReport_h
#define vtkDICOMPatientReport_h

#include "vtkBrainShiftFormatsModule.h" // for the export macro
#include "vtkObject.h"
#include "vtkWeakPointer.h" // for what is asked

#include <string>

class vtkAlgorithm;

class VTKBRAINSHIFTFORMATS_EXPORT vtkDICOMPatientReport : public vtkObject
{
public:
  static vtkDICOMPatientReport* New();
  vtkTypeMacro(vtkDICOMPatientReport, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** The vtkVolumeFileReader of the series. Its headers must be read. Default: none. */
  void SetSource(vtkAlgorithm* source);

  /** Reads the first file of the series again, up to the pixels. */
  void Read();

  ///@{
  /** Texts of the file; empty before Read, and where the file says nothing. */
  const char* GetName() const { return this->Name.c_str(); }
  const char* GetNumber() const { return this->Number.c_str(); }
  const char* GetBirthDate() const { return this->BirthDate.c_str(); } // 1970-01-31
  const char* GetSex() const { return this->Sex.c_str(); }             // M, F or O
  ///@}

protected:
  vtkDICOMPatientReport();
  ~vtkDICOMPatientReport() override;

private:
  vtkDICOMPatientReport(const vtkDICOMPatientReport&) = delete;
  void operator=(const vtkDICOMPatientReport&) = delete;

  vtkWeakPointer<vtkAlgorithm> Source;
  std::string Name;
  std::string Number;
  std::string BirthDate;
  std::string Sex;
};

#endif
