// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Keeps C++ exceptions from crossing into VTK, which knows none: they would end ParaView, or the
/// server with the work of all who use it.
///
/// Every filter answers the pipeline's requests, and every prop is drawn, through this guard. The
/// check `every_boundary_is_guarded` of Testing/House finds those that are not.
#ifndef BrainShift_Guard_h
#define BrainShift_Guard_h

#include "vtkBrainShiftCommonModule.h" // for the export macro

#include <string>

class vtkInformationVector;
class vtkObject;

namespace brainshift
{
/** The reason of the exception that is being handled: the end of a sentence. Call it in a catch. */
VTKBRAINSHIFTCOMMON_EXPORT std::string thrownReason();

/**
 * The exception that is being handled as a sentence without a full stop: that of a Problem, or
 * `subject` and thrownReason. Call it in a catch.
 */
VTKBRAINSHIFTCOMMON_EXPORT std::string thrownSentence(const std::string& subject);

/** Reports an exception as an error of an object. Call it in a catch. */
VTKBRAINSHIFTCOMMON_EXPORT void reportThrown(vtkObject* object);

/**
 * Reports a warning of an object, or of none. All warnings go this way: the window knows them by
 * it, and shows them where they cover nothing (QuietMessages).
 *
 * @param sentence  without the last full stop
 */
VTKBRAINSHIFTCOMMON_EXPORT void warn(vtkObject* object, const std::string& sentence);

/**
 * Reports a warning of an object that runs again and again: not one that it gave the last time.
 *
 * @param sentence   without the last full stop; empty: there is none
 * @param last       that of the last run; becomes `sentence`
 */
VTKBRAINSHIFTCOMMON_EXPORT void warnAnew(
  vtkObject* object, const std::string& sentence, std::string& last);

/**
 * Lets the next request ask for its own extent after one that failed. VTK adds the extent of a
 * failed request to those that follow, so a filter that refused a size would refuse all smaller
 * ones, too.
 */
VTKBRAINSHIFTCOMMON_EXPORT void forgetExtents(vtkInformationVector* outputs);

/** Runs a step. Returns what it threw, the end of a sentence; empty if nothing. */
template <typename Step>
std::string thrownBy(const Step& step)
{
  try
  {
    step();
    return {};
  }
  catch (...)
  {
    return thrownReason();
  }
}

/** Runs a step. Returns what it threw as a sentence, see thrownSentence; empty if nothing. */
template <typename Step>
std::string sentenceThrownBy(const std::string& subject, const Step& step)
{
  try
  {
    step();
    return {};
  }
  catch (...)
  {
    return thrownSentence(subject);
  }
}

/** Runs a step. If it throws, this reports an error of `object` and returns `failed`. */
template <typename Result, typename Step>
Result guarded(vtkObject* object, Result failed, const Step& step)
{
  try
  {
    return step();
  }
  catch (...)
  {
    reportThrown(object);
    return failed;
  }
}

/** Runs a step that returns nothing. If it throws, this reports an error of `object`. */
template <typename Step>
void guarded(vtkObject* object, const Step& step)
{
  try
  {
    step();
  }
  catch (...)
  {
    reportThrown(object);
  }
}
}

/** Defines ProcessRequest of an algorithm: the superclass's, guarded. The header declares it. */
#define brainshiftGuardRequestsMacro(name)                                                         \
  vtkTypeBool name::ProcessRequest(                                                                \
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)         \
  {                                                                                                \
    const vtkTypeBool done = brainshift::guarded(this, vtkTypeBool(0),                             \
      [&] { return this->Superclass::ProcessRequest(request, inputs, outputs); });                 \
    if (!done)                                                                                     \
    {                                                                                              \
      brainshift::forgetExtents(outputs);                                                          \
    }                                                                                              \
    return done;                                                                                   \
  }

#endif
