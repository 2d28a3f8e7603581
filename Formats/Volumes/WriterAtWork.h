// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The writer of volumes that is at work in this process, so that the window can stop it.
#ifndef BrainShift_WriterAtWork_h
#define BrainShift_WriterAtWork_h

#include "vtkBrainShiftFormatsModule.h" // for the export macro

class vtkAlgorithm;

namespace brainshift
{
/** While it lives, a writer is at work. One at a time. */
class VTKBRAINSHIFTFORMATS_EXPORT WriterAtWork
{
public:
  explicit WriterAtWork(vtkAlgorithm* writer);
  ~WriterAtWork();
  WriterAtWork(const WriterAtWork&) = delete;
  WriterAtWork& operator=(const WriterAtWork&) = delete;

  /** Null: none is at work. It stops when its AbortExecute is set. */
  static vtkAlgorithm* find();

  /**
   * Lets the writer at work, if there is one, report its progress while its input is read. False:
   * it is to stop, so nobody waits for what is read.
   */
  static bool goesOn();
};
}

#endif
