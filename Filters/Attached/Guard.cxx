// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Attached/Guard.h"

#include "vtkObject.h"

#include <exception>
#include <new>
#include <stdexcept>

namespace brainshift
{
std::string thrownReason()
{
  try
  {
    throw;
  }
  catch (const std::bad_alloc&)
  {
    return "needs more memory than this machine has left";
  }
  catch (const std::length_error&)
  {
    return "needs more memory than any machine has";
  }
  catch (const std::exception& thrown)
  {
    return std::string("failed: ") + thrown.what();
  }
  catch (...)
  {
    return "failed for a reason it does not know";
  }
}

void reportThrown(vtkObject* object)
{
  vtkErrorWithObjectMacro(object, << object->GetClassName() << " " << thrownReason() << ".");
}
}
