// SPDX-License-Identifier: BSD-3-Clause
// Assembles the files of Shaders/ into programs. From C++ come only #define lines.
#ifndef BrainShift_ShaderSource_h
#define BrainShift_ShaderSource_h

#include "vtkBrainShiftRepresentationsModule.h" // for the export macro

#include <string>
#include <utility>
#include <vector>

namespace brainshift
{
struct ShaderSource
{
  std::string vertex;
  std::string geometry; // empty: none
  std::string fragment;
};

constexpr int MaxLights = 8;

// Variants of the ray caster; each combination is a program of its own.
struct RayCastVariant
{
  bool deformed = false; // the volume carries a lattice
  enum Light
  {
    Unshaded = 0,
    GradientsOnTheFly = 1,
    GradientTexture = 2,
    PackedGradients = 3, // with the scalar, in one texture
    LightCount = 4,
  } light = Unshaded;
};

VTKBRAINSHIFTREPRESENTATIONS_EXPORT ShaderSource refineSource();
VTKBRAINSHIFTREPRESENTATIONS_EXPORT ShaderSource invertSource();
VTKBRAINSHIFTREPRESENTATIONS_EXPORT ShaderSource rayCastSource(const RayCastVariant& variant);
VTKBRAINSHIFTREPRESENTATIONS_EXPORT ShaderSource compositeSource();
VTKBRAINSHIFTREPRESENTATIONS_EXPORT ShaderSource coverSource();
VTKBRAINSHIFTREPRESENTATIONS_EXPORT ShaderSource normalsSource(bool packed);
VTKBRAINSHIFTREPRESENTATIONS_EXPORT ShaderSource presenceSource(bool deformed);
VTKBRAINSHIFTREPRESENTATIONS_EXPORT ShaderSource proxySource();

// Every program the product can draw with, by name: for an offline compiler.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT std::vector<std::pair<std::string, ShaderSource>> allSources();
}

#endif
