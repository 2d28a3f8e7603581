// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The defaults that an XML file of the repository gives to properties.
#ifndef BrainShift_TestDefaults_h
#define BrainShift_TestDefaults_h

#include <vtkXMLDataElement.h>
#include <vtkXMLUtilities.h>

#include <gtest/gtest.h>

#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace brainshift::testing
{
using Defaults = std::map<std::string, std::vector<double>>; // by property name

inline void collect(vtkXMLDataElement* element, Defaults& defaults)
{
  if (element->GetAttribute("name") && element->GetAttribute("default_values"))
  {
    std::istringstream text(element->GetAttribute("default_values"));
    std::vector<double>& values = defaults[element->GetAttribute("name")];
    for (double value; text >> value;)
    {
      values.push_back(value);
    }
  }
  for (int i = 0; i < element->GetNumberOfNestedElements(); ++i)
  {
    collect(element->GetNestedElement(i), defaults);
  }
}

// Every default that a file of the repository gives to a property.
inline Defaults defaultsIn(const std::string& file)
{
  Defaults defaults;
  const std::string path = std::string(BRAINSHIFT_SOURCE_DIR) + "/" + file;
  if (vtkXMLDataElement* root = vtkXMLUtilities::ReadElementFromFile(path.c_str()))
  {
    collect(root, defaults);
    root->Delete();
  }
  else
  {
    ADD_FAILURE() << path << " is no XML";
  }
  return defaults;
}
}

#endif
