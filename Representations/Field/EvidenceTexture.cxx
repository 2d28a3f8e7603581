// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Field/EvidenceTexture.h"

#include "Representations/Field/SceneDeformation.h"
#include "Representations/Gpu/OpenGL.h"
#include "Representations/Scene/FieldPlace.h"

#include "vtkOpenGLRenderWindow.h"

#include <algorithm>
#include <cmath>

namespace brainshift
{
namespace
{
// 0 times infinity, between two control points, would be no number.
constexpr float UnknownMm = 1e4f;

constexpr const char* NoEvidence =
  "Show Evidence is on, but the volume carries no uncertainty: its Lattice must be a Fit "
  "Deformation that has Evidence on and the same Lattice Dimensions, Kernel, Samples and mask. "
  "Nothing is marked";
}

bool EvidenceTexture::update(GpuTask& gpu, const SceneDeformation& deformation,
  const DrawnValues& values, SceneEvidence& evidence)
{
  evidence = SceneEvidence();
  if (!deformation.deformed || deformation.deviations.empty())
  {
    gpu.remarks.emplace_back(NoEvidence);
    return true;
  }
  const Grid& lattice = deformation.lattice.grid;
  if (!this->Texture || this->Uploaded != deformation.deviations)
  {
    std::vector<float> finite = deformation.deviations;
    std::transform(finite.begin(), finite.end(), finite.begin(),
      [](float mm) { return std::min(mm, UnknownMm); });
    this->Texture = vtkSmartPointer<vtkTextureObject>::New();
    this->Texture->SetContext(gpu.window);
    this->Texture->SetMinificationFilter(vtkTextureObject::Linear);
    this->Texture->SetMagnificationFilter(vtkTextureObject::Linear);
    this->Texture->SetInternalFormat(GL_R32F);
    this->Texture->SetWrapS(vtkTextureObject::ClampToEdge);
    this->Texture->SetWrapT(vtkTextureObject::ClampToEdge);
    this->Texture->SetWrapR(vtkTextureObject::ClampToEdge);
    const glm::ivec3& side = lattice.dimensions;
    if (!this->Texture->Create3DFromRaw(side.x, side.y, side.z, 1, VTK_FLOAT, finite.data()))
    {
      this->Texture = nullptr;
      return gpu.fail("The GPU refused a 3D texture for the uncertainty");
    }
    gpu.counters.evidenceUploads += 1;
    gpu.counters.bytesUploaded += static_cast<std::int64_t>(finite.size() * sizeof(float));
    this->Uploaded = deformation.deviations;
  }
  // Texture coordinates count from the outer faces of the first and the last value.
  const SceneField place = bentField(values, lattice, deformation.request.nodes);
  const glm::dvec3 count(lattice.dimensions);
  evidence.deviations = this->Texture;
  evidence.deviationFromTexture = place.latticeFromTexture / count;
  evidence.deviationOfTextureZero = (place.latticeOfTextureZero + 0.5) / count;
  evidence.stripesFromTexture =
    values.grid.spacing / values.layout.textureFromGrid / (std::sqrt(3.0) * EvidenceStripeMm);
  const glm::dvec3 beginsMm = place.latticeOfTextureZero * lattice.spacing;
  const double stripes =
    (beginsMm.x + beginsMm.y + beginsMm.z) / (std::sqrt(3.0) * EvidenceStripeMm);
  evidence.stripesOfTextureZero = stripes - std::floor(stripes);
  return true;
}

void EvidenceTexture::releaseGraphicsResources(vtkWindow* window)
{
  if (this->Texture)
  {
    this->Texture->ReleaseGraphicsResources(window);
  }
  this->Texture = nullptr;
  this->Uploaded.clear();
}
}
