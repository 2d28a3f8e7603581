// SPDX-License-Identifier: BSD-3-Clause
#include "ShaderSource.h"

#include "OffsetField.h"

#include "shader_composite_frag.h"
#include "shader_cover_frag.h"
#include "shader_field.h"
#include "shader_fullscreen_vert.h"
#include "shader_gradient.h"
#include "shader_inversion.h"
#include "shader_invert_frag.h"
#include "shader_light.h"
#include "shader_nodes.h"
#include "shader_normals_frag.h"
#include "shader_presence_frag.h"
#include "shader_proxy_frag.h"
#include "shader_proxy_vert.h"
#include "shader_raycast_frag.h"
#include "shader_rays.h"
#include "shader_refine_frag.h"
#include "shader_skipping.h"
#include "shader_tissue.h"
#include "shader_volume_pass.h"
#include "shader_volume_pass_geom.h"
#include "shader_volume_pass_vert.h"

#include <initializer_list>

namespace brainshift
{
namespace
{
// VTK replaces this by the version line and, in fragment shaders, declares the outputs.
constexpr const char* Head = "//VTK::System::Dec\n";
constexpr const char* Outputs = "//VTK::Output::Dec\n";
// Marks functions that C++ shares; nothing in GLSL.
constexpr const char* Shared = "#define SHARED\n#define OUT(type) out type\n";

std::string assemble(std::initializer_list<std::string> parts)
{
  std::string source = Head;
  for (const std::string& part : parts)
  {
    source += part;
  }
  return source;
}

// A program for runVolumePass whose fragment stage ends with `body`.
ShaderSource volumePassSource(const std::string& body)
{
  return { assemble({ shader_volume_pass_vert }), assemble({ shader_volume_pass_geom }),
    assemble({ Outputs, Shared, shader_volume_pass, body }) };
}
}

ShaderSource refineSource()
{
  return volumePassSource("#define MAX_PER_CELL " + std::to_string(LargestSamples + 1) + "\n" +
    std::string(shader_refine_frag));
}

ShaderSource invertSource()
{
  return volumePassSource(std::string(shader_nodes) + shader_inversion + shader_invert_frag);
}

ShaderSource normalsSource(bool packed)
{
  return volumePassSource(std::string(packed ? "#define PACKED_GRADIENTS\n" : "") +
    shader_gradient + shader_normals_frag);
}

ShaderSource presenceSource(bool deformed)
{
  return volumePassSource(std::string(deformed ? "#define DEFORMED\n" : "") + shader_presence_frag);
}

ShaderSource proxySource()
{
  return { assemble({ shader_proxy_vert }), "",
    assemble({ Outputs, shader_rays, shader_proxy_frag }) };
}

ShaderSource rayCastSource(const RayCastVariant& variant)
{
  std::string defines = "#define MAX_LIGHTS " + std::to_string(MaxLights) + "\n";
  defines += variant.deformed ? "#define DEFORMED\n" : "";
  defines += variant.light != RayCastVariant::Unshaded ? "#define SHADED\n" : "";
  defines += variant.light == RayCastVariant::GradientTexture ? "#define GRADIENT_TEXTURE\n" : "";
  defines += variant.light == RayCastVariant::PackedGradients ? "#define PACKED_GRADIENTS\n" : "";
  return { assemble({ shader_fullscreen_vert }), "",
    assemble({ Outputs, defines, shader_rays, shader_skipping, shader_field, shader_gradient,
      shader_tissue, shader_light, shader_raycast_frag }) };
}

ShaderSource compositeSource()
{
  return { assemble({ shader_fullscreen_vert }), "", assemble({ Outputs, shader_composite_frag }) };
}

ShaderSource coverSource()
{
  return { assemble({ shader_fullscreen_vert }), "", assemble({ Outputs, shader_cover_frag }) };
}

std::vector<std::pair<std::string, ShaderSource>> allSources()
{
  std::vector<std::pair<std::string, ShaderSource>> sources{ { "refine", refineSource() },
    { "invert", invertSource() }, { "normals", normalsSource(false) },
    { "normals_packed", normalsSource(true) }, { "presence_rest", presenceSource(false) },
    { "presence_deformed", presenceSource(true) }, { "proxy", proxySource() },
    { "composite", compositeSource() }, { "cover", coverSource() } };
  const char* lights[] = { "_unshaded", "_gradients", "_gradient_texture", "_packed_gradients" };
  for (const bool deformed : { false, true })
  {
    for (int light = 0; light < RayCastVariant::LightCount; ++light)
    {
      sources.emplace_back(
        std::string("raycast") + (deformed ? "_deformed" : "_rest") + lights[light],
        rayCastSource({ deformed, static_cast<RayCastVariant::Light>(light) }));
    }
  }
  return sources;
}
}
