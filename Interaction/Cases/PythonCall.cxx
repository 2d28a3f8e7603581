// SPDX-License-Identifier: BSD-3-Clause
#include "Interaction/Cases/PythonCall.h"

#include <vtkPython.h>
#include <vtkPythonInterpreter.h>
#include <vtkPythonUtil.h>
#include <vtkSmartPyObject.h>

namespace brainshift
{
std::optional<std::string> callPython(
  const char* module, const char* function, const std::string& text)
{
  vtkPythonInterpreter::Initialize();
  const vtkPythonScopeGilEnsurer lock;
  const vtkSmartPyObject found(PyImport_ImportModule(module));
  const vtkSmartPyObject answer(
    found ? PyObject_CallMethod(found, function, "s", text.c_str()) : nullptr);
  const char* told = answer ? PyUnicode_AsUTF8(answer) : nullptr;
  if (!told)
  {
    PyErr_Print();
    return std::nullopt;
  }
  return std::string(told);
}
}
