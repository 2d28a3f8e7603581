// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Tissue/ColorTexture.h"

#include "vtkDataArray.h"
#include "vtkDataArrayRange.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkSMPTools.h"
#include "vtkTextureObject.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace brainshift
{
namespace
{
constexpr int Channels = 4; // the fourth unused: rows of three bytes are misaligned

bool isReal(vtkDataArray* array)
{
  return array->GetDataType() == VTK_FLOAT || array->GetDataType() == VTK_DOUBLE;
}

std::vector<std::uint8_t> bytesOf(vtkDataArray* array)
{
  const double scale = isReal(array) ? 255.0 : 1.0;
  std::vector<std::uint8_t> bytes(Channels * array->GetNumberOfTuples());
  vtkSMPTools::For(0, array->GetNumberOfTuples(), [&](vtkIdType first, vtkIdType end) {
    std::uint8_t* out = &bytes[Channels * first];
    for (const auto tuple : vtk::DataArrayTupleRange(array, first, end))
    {
      for (int c = 0; c < Channels; ++c, ++out)
      {
        const double level = static_cast<double>(tuple[c]) * scale + 0.5;
        *out = level >= 0.0 ? static_cast<std::uint8_t>(std::min(level, 255.0)) : 0; // NaN: 0
      }
    }
  });
  return bytes;
}
}

ColorTexture::ColorTexture() = default;
ColorTexture::~ColorTexture() = default;

bool ColorTexture::update(vtkOpenGLRenderWindow* window, vtkDataArray* array,
  const glm::ivec3& dimensions, Counters& counters)
{
  if (this->Texture && this->Uploaded == array && this->UploadedTime == array->GetMTime())
  {
    return true;
  }
  std::vector<std::uint8_t> bytes = bytesOf(array);
  this->Texture = vtkSmartPointer<vtkTextureObject>::New();
  this->Texture->SetContext(window);
  this->Texture->SetWrapS(vtkTextureObject::ClampToEdge);
  this->Texture->SetWrapT(vtkTextureObject::ClampToEdge);
  this->Texture->SetWrapR(vtkTextureObject::ClampToEdge);
  counters.bytesUploaded += static_cast<std::int64_t>(bytes.size());
  if (!this->Texture->Create3DFromRaw(
        dimensions.x, dimensions.y, dimensions.z, Channels, VTK_UNSIGNED_CHAR, bytes.data()))
  {
    this->Texture = nullptr;
    return false;
  }
  this->Uploaded = array;
  this->UploadedTime = array->GetMTime();
  return true;
}

void ColorTexture::releaseGraphicsResources(vtkWindow* window)
{
  if (this->Texture)
  {
    this->Texture->ReleaseGraphicsResources(window);
  }
  this->Texture = nullptr;
  this->Uploaded = nullptr;
}
}
