// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Gpu/ShaderSource.h"

#include "Filters/Deformation/FieldChange.h"
#include "Filters/Deformation/SegmentFractions.h"

#include "shader_averaged.h"
#include "shader_blocks_frag.h"
#include "shader_both_paths.h"
#include "shader_bricks.h"
#include "shader_cavity.h"
#include "shader_clipping.h"
#include "shader_comparison.h"
#include "shader_components.h"
#include "shader_composite_frag.h"
#include "shader_compositing.h"
#include "shader_compositing_frag.h"
#include "shader_counting.h"
#include "shader_cover_frag.h"
#include "shader_crosshair.h"
#include "shader_cubic.h"
#include "shader_cut.h"
#include "shader_enlarge_frag.h"
#include "shader_evidence.h"
#include "shader_field.h"
#include "shader_fullscreen_vert.h"
#include "shader_gradient.h"
#include "shader_inversion.h"
#include "shader_invert_frag.h"
#include "shader_isosurface_frag.h"
#include "shader_layers.h"
#include "shader_light.h"
#include "shader_march.h"
#include "shader_nodes.h"
#include "shader_normals_frag.h"
#include "shader_occlusion_frag.h"
#include "shader_outline_vert.h"
#include "shader_part.h"
#include "shader_pointwise.h"
#include "shader_presence_frag.h"
#include "shader_projection_frag.h"
#include "shader_proxy_frag.h"
#include "shader_proxy_vert.h"
#include "shader_raycast.h"
#include "shader_rays.h"
#include "shader_reference.h"
#include "shader_refine_frag.h"
#include "shader_resection.h"
#include "shader_segment.h"
#include "shader_similarity.h"
#include "shader_skipping.h"
#include "shader_slice_bricks_frag.h"
#include "shader_slice_frag.h"
#include "shader_slices_frag.h"
#include "shader_slices_vert.h"
#include "shader_smooth_occlusion_frag.h"
#include "shader_steepness.h"
#include "shader_streamed.h"
#include "shader_tissue.h"
#include "shader_traces_frag.h"
#include "shader_traces_over_frag.h"
#include "shader_traces_vert.h"
#include "shader_two_colors_frag.h"
#include "shader_two_samples.h"
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
constexpr const char* Shared = "#define SHARED\n";

// VTK declares an output for each one that the source names. So the source must not name unused
// ones.
constexpr const char* NotCounted =
  "const bool CountsSamples = false;\nvoid countSamples(float taken, float skipped) {}\n";

std::string assemble(std::initializer_list<std::string> parts)
{
  std::string source = Head;
  for (const std::string& part : parts)
  {
    source += part;
  }
  return source;
}

// A vertex stage that draws a part of a picture.
std::string outlineStage()
{
  return assemble(
    { "#define MAX_CORNERS " + std::to_string(MaxCorners) + "\n", shader_outline_vert });
}

std::string blockDefine()
{
  return "#define BRICKS_IN_BLOCK " + std::to_string(BricksInBlock) + "\n";
}

// A program for runVolumePass whose fragment stage ends with `body`.
ShaderSource volumePassSource(const std::string& body)
{
  return { assemble({ shader_volume_pass_vert }), assemble({ shader_volume_pass_geom }),
    assemble({ Outputs, Shared, shader_volume_pass, body }) };
}

constexpr const char* BlendDefines[BlendCount] = { "COMPOSITE", "MAXIMUM", "MINIMUM", "AVERAGE",
  "ADDITIVE", "ISOSURFACE", "SLICE" };

// The loop of a variant; it follows raycast.glsl.
std::string loopSource(const RayCastVariant& variant)
{
  if (variant.compared)
  {
    return std::string(shader_cavity) + shader_reference + shader_layers + shader_both_paths +
      shader_two_colors_frag;
  }
  switch (variant.blend)
  {
    case Blend::Composite:
      return std::string(shader_steepness) + shader_compositing +
        (variant.averaged ? shader_averaged : shader_pointwise) + shader_two_samples +
        shader_compositing_frag;
    case Blend::Isosurface:
      return std::string(shader_march) + shader_isosurface_frag;
    case Blend::Slice:
      return std::string(shader_march) + shader_slice_frag;
    default:
      return std::string(shader_march) + shader_projection_frag;
  }
}

std::string floatDefine(const std::string& name, int value)
{
  return "#define " + name + " " + std::to_string(value) + ".0\n";
}

std::string coloringDefine(Coloring coloring)
{
  return coloring == Coloring::Direct   ? "#define DIRECT_COLORS\n"
    : coloring == Coloring::OtherScalar ? "#define COLOR_SCALARS\n"
                                        : "";
}

std::string opacityDefines(Opacity opacity)
{
  return std::string(opacity != Opacity::Scalar ? "#define STEEPNESS\n" : "") +
    (opacity == Opacity::Table ? "#define STEEPNESS_TABLE\n" : "");
}

// `removed`, `tumour`: see RayCastVariant.
std::string resectionDefines(bool removed, bool tumour)
{
  return "#define LEAST_FRACTION " + std::to_string(LeastFraction) + "\n" +
    (removed ? "#define REMOVED\n" : "") + (tumour ? "#define TUMOUR\n" : "");
}

const char* const LightNames[RayCastVariant::LightCount] = { "_unshaded", "_gradients",
  "_gradient_texture" };

std::string nameOf(const RayCastVariant& variant)
{
  static const char* const blends[BlendCount] = { "", "_maximum", "_minimum", "_average",
    "_additive", "_isosurface", "_slice" };
  static const char* const colorings[] = { "", "_direct", "_other_scalar" };
  static const char* const opacities[] = { "", "_gradient_opacity", "_table" };
  return std::string("raycast") + (variant.deformed ? "_deformed" : "_rest") +
    LightNames[variant.light] + blends[static_cast<int>(variant.blend)] +
    colorings[static_cast<int>(variant.coloring)] + (variant.regions ? "_regions" : "") +
    (variant.segmented ? "_segment" : "") + (variant.counted ? "_counted" : "") +
    (variant.sharedLight ? "_shared_light" : "") + (variant.averaged ? "_averaged" : "") +
    (variant.compared ? "_compared" : "") + (variant.cavity ? "_cavity" : "") +
    opacities[static_cast<int>(variant.opacity)] + (variant.evidence ? "_evidence" : "") +
    (variant.removed ? "_removed" : "") + (variant.tumour ? "_tumour" : "") +
    (variant.streamed ? "_streamed" : "") + (variant.asks ? "_asks" : "");
}

std::string brickDefines()
{
  return "#define STREAMED\n" + floatDefine("BRICK_SIDE", StreamedSide) +
    floatDefine("BRICK_BORDER", SlotBorder);
}

// Where bricks of a finer level are drawn, rays ask for others in the target that counts samples.
std::string streamedDefines(const RayCastVariant& variant)
{
  return !variant.streamed ? "" : brickDefines() + (variant.asks ? "#define WISHES\n" : "");
}
}

std::string fieldDefines()
{
  return "#define SLAB_DIRECTIONS " + std::to_string(SlabDirections) + "\n" +
    floatDefine("SLOT_SIDE", SlotSide) + floatDefine("SLOTS_IN_ROW", SlotsInRow) +
    floatDefine("ROWS_IN_LAYER", RowsInLayer) + floatDefine("CODE_OF_SLOT", CodeOfSlot);
}

ShaderSource refineSource(bool masked)
{
  return volumePassSource((masked ? "#define MASKED\n" : "") + std::string(shader_refine_frag));
}

ShaderSource invertSource()
{
  return volumePassSource(std::string(shader_nodes) + shader_inversion + shader_invert_frag);
}

ShaderSource normalsSource()
{
  return volumePassSource(std::string(shader_gradient) + shader_normals_frag);
}

ShaderSource blocksSource()
{
  return volumePassSource(
    blockDefine() + "#define DEFORMED\n" + shader_bricks + shader_blocks_frag);
}

ShaderSource presenceSource(bool deformed)
{
  return volumePassSource(
    blockDefine() + (deformed ? "#define DEFORMED\n" : "") + shader_bricks + shader_presence_frag);
}

ShaderSource proxySource()
{
  return { assemble({ shader_proxy_vert }), "", assemble({ Outputs, shader_proxy_frag }) };
}

ShaderSource rayCastSource(const RayCastVariant& variant)
{
  std::string defines = "#define MAX_LIGHTS " + std::to_string(MaxLights) + "\n";
  defines += "#define MAX_CLIP_PLANES " + std::to_string(MaxClipPlanes) + "\n";
  defines += fieldDefines();
  defines += "#define MAX_ISOVALUES " + std::to_string(MaxIsovalues) + "\n";
  defines += std::string("#define ") + BlendDefines[static_cast<int>(variant.blend)] + "\n";
  defines += variant.deformed ? "#define DEFORMED\n" : "";
  defines += variant.light != RayCastVariant::Unshaded ? "#define SHADED\n" : "";
  defines += variant.light == RayCastVariant::GradientTexture ? "#define GRADIENT_TEXTURE\n" : "";
  defines += coloringDefine(variant.coloring);
  defines += variant.regions ? "#define REGIONS\n" : "";
  defines += variant.segmented ? "#define SEGMENTED\n" : "";
  defines += variant.sharedLight ? "#define SHARED_LIGHT\n" : "";
  defines += "#define TRANSFER_ENTRIES " + std::to_string(TransferEntries) + "\n";
  defines += variant.compared ? "#define COMPARED\n" : "";
  defines += variant.cavity ? "#define CAVITY\n" : "";
  defines += opacityDefines(variant.opacity);
  defines += variant.evidence ? "#define EVIDENCE\n" : "";
  defines += resectionDefines(variant.removed, variant.tumour);
  defines += streamedDefines(variant);
  return { outlineStage(), "",
    assemble({ Outputs, defines, shader_rays, shader_skipping, shader_clipping, shader_field,
      shader_gradient, shader_segment, shader_tissue,
      variant.streamed ? std::string(shader_streamed) : "", shader_cut, shader_resection,
      shader_components, shader_evidence, shader_light,
      variant.counted ? std::string(shader_counting) : NotCounted, shader_raycast,
      loopSource(variant) }) };
}

ShaderSource compositeSource(bool occluded)
{
  return { assemble({ shader_fullscreen_vert }), "",
    assemble({ Outputs, occluded ? "#define OCCLUDED\n" : "", shader_composite_frag }) };
}

ShaderSource occlusionSource()
{
  return { assemble({ shader_fullscreen_vert }), "",
    assemble({ Outputs, floatDefine("MOST_PIXELS", MostOcclusionPixels), shader_occlusion_frag }) };
}

ShaderSource smoothOcclusionSource()
{
  return { assemble({ shader_fullscreen_vert }), "",
    assemble({ Outputs, shader_smooth_occlusion_frag }) };
}

ShaderSource enlargeSource()
{
  return { outlineStage(), "", assemble({ Outputs, shader_enlarge_frag }) };
}

ShaderSource coverSource()
{
  return { assemble({ shader_fullscreen_vert }), "", assemble({ Outputs, shader_cover_frag }) };
}

ShaderSource slicesSource(const SlicesVariant& variant)
{
  const std::string defines = fieldDefines() + (variant.deformed ? "#define DEFORMED\n" : "") +
    coloringDefine(variant.coloring) + (variant.compared ? "#define COMPARED\n" : "") +
    (variant.cavity ? "#define CAVITY\n" : "") + (variant.evidence ? "#define EVIDENCE\n" : "") +
    resectionDefines(variant.removed, variant.tumour) + (variant.streamed ? brickDefines() : "");
  return { assemble({ shader_slices_vert }), "",
    assemble({ Outputs, defines, shader_rays, shader_field, shader_gradient, shader_segment,
      shader_tissue, variant.streamed ? std::string(shader_streamed) : "", shader_resection,
      shader_components, shader_evidence, shader_cubic, shader_cavity, shader_part,
      shader_crosshair, shader_comparison, shader_similarity, shader_slices_frag }) };
}

ShaderSource sliceBricksSource(bool deformed)
{
  const std::string defines =
    fieldDefines() + (deformed ? "#define DEFORMED\n" : "") + brickDefines();
  return { assemble({ shader_slices_vert }), "",
    assemble({ Outputs, defines, shader_rays, shader_field, shader_gradient, shader_segment,
      shader_tissue, shader_streamed, shader_slice_bricks_frag }) };
}

ShaderSource tracesSource(int tissues)
{
  return { assemble({ "#define TISSUES " + std::to_string(tissues) + "\n", shader_traces_vert }),
    "", assemble({ Outputs, shader_traces_frag }) };
}

ShaderSource tracesOverSource()
{
  return { assemble({ shader_fullscreen_vert }), "",
    assemble({ Outputs, shader_traces_over_frag }) };
}

namespace
{
using NamedSources = std::vector<std::pair<std::string, ShaderSource>>;

void add(NamedSources& sources, const RayCastVariant& variant)
{
  sources.emplace_back(nameOf(variant), rayCastSource(variant));
}

// The ray caster of a volume alone.
void addAlone(NamedSources& sources, bool deformed)
{
  for (int light = 0; light < RayCastVariant::LightCount; ++light)
  {
    for (const Blend blend : { Blend::Composite, Blend::Isosurface, Blend::Slice })
    {
      add(sources, { deformed, static_cast<RayCastVariant::Light>(light), blend });
    }
  }
  for (const Blend blend : { Blend::Maximum, Blend::Minimum, Blend::Average, Blend::Additive })
  {
    add(sources, { deformed, RayCastVariant::Unshaded, blend });
  }
  for (const Coloring coloring : { Coloring::Direct, Coloring::OtherScalar })
  {
    add(sources, { deformed, RayCastVariant::GradientTexture, Blend::Composite, coloring });
    add(sources, { deformed, RayCastVariant::Unshaded, Blend::Maximum, coloring, true });
  }
  add(sources,
    { deformed, RayCastVariant::GradientTexture, Blend::Composite, Coloring::Mapped, true });
  add(sources,
    { deformed, RayCastVariant::GradientTexture, Blend::Composite, Coloring::Mapped, false, false,
      true, true });
  for (int light = 0; light < RayCastVariant::LightCount; ++light)
  {
    RayCastVariant averaged{ deformed, static_cast<RayCastVariant::Light>(light) };
    averaged.averaged = averaged.segmented = averaged.counted = true;
    add(sources, averaged);
  }
  for (const Blend blend : { Blend::Composite, Blend::Isosurface, Blend::Average })
  {
    const bool lit = blend != Blend::Average;
    add(sources,
      { deformed, lit ? RayCastVariant::GradientTexture : RayCastVariant::Unshaded, blend,
        Coloring::Mapped, false, true });
  }
}

// The ray caster of a volume whose opacity depends on gradients, too.
void addSteep(NamedSources& sources, bool deformed)
{
  for (const Opacity opacity : { Opacity::Gradient, Opacity::Table })
  {
    for (const auto light : { RayCastVariant::Unshaded, RayCastVariant::GradientsOnTheFly })
    {
      RayCastVariant steep{ deformed, light };
      steep.opacity = opacity;
      add(sources, steep);
      steep.averaged = opacity == Opacity::Gradient;
      steep.segmented = true;
      add(sources, steep);
    }
    RayCastVariant shared{ deformed, RayCastVariant::GradientsOnTheFly };
    shared.opacity = opacity;
    shared.sharedLight = true;
    add(sources, shared);
  }
}

// The ray caster of a volume of which bricks of a finer level are drawn.
void addStreamed(NamedSources& sources, bool deformed)
{
  for (const auto light : { RayCastVariant::Unshaded, RayCastVariant::GradientsOnTheFly })
  {
    RayCastVariant streamed{ deformed, light };
    streamed.streamed = true;
    add(sources, streamed);
    streamed.asks = true;
    add(sources, streamed);
    streamed.asks = false;
    streamed.averaged = streamed.counted = true;
    add(sources, streamed);
  }
}

// Slices of such a volume, and which bricks they ask for.
void addStreamedSlices(NamedSources& sources, bool deformed)
{
  const std::string frame = deformed ? "_deformed" : "_rest";
  SlicesVariant streamed{ deformed };
  streamed.streamed = true;
  sources.emplace_back("slices" + frame + "_streamed", slicesSource(streamed));
  sources.emplace_back("slice_bricks" + frame, sliceBricksSource(deformed));
}

// The ray caster of a volume whose fit has an uncertainty.
void addEvidence(NamedSources& sources)
{
  for (const Blend blend : { Blend::Composite, Blend::Isosurface, Blend::Slice })
  {
    RayCastVariant variant{ true, RayCastVariant::GradientTexture, blend };
    variant.evidence = true;
    add(sources, variant);
  }
  RayCastVariant averaged{ true, RayCastVariant::GradientTexture };
  averaged.averaged = averaged.evidence = true;
  add(sources, averaged);
  RayCastVariant compared{ true, RayCastVariant::GradientTexture };
  compared.compared = compared.evidence = true;
  add(sources, compared);
}

// The ray caster of a volume after a resection.
void addResected(NamedSources& sources)
{
  for (const Blend blend : { Blend::Composite, Blend::Isosurface, Blend::Slice, Blend::Maximum })
  {
    const bool lit = blend != Blend::Maximum;
    RayCastVariant variant{ true, lit ? RayCastVariant::GradientTexture : RayCastVariant::Unshaded,
      blend };
    variant.removed = variant.tumour = true;
    add(sources, variant);
  }
  RayCastVariant averaged{ true, RayCastVariant::GradientsOnTheFly };
  averaged.averaged = averaged.segmented = averaged.removed = averaged.tumour = true;
  add(sources, averaged);
  RayCastVariant compared{ true, RayCastVariant::GradientTexture };
  compared.compared = compared.removed = true;
  add(sources, compared);
}

// The ray caster of a volume and a reference.
void addCompared(NamedSources& sources, bool deformed)
{
  for (int light = 0; light < RayCastVariant::LightCount; ++light)
  {
    RayCastVariant compared{ deformed, static_cast<RayCastVariant::Light>(light) };
    compared.compared = true;
    add(sources, compared);
    compared.cavity = compared.regions = compared.counted = true;
    add(sources, compared);
  }
}
}

std::vector<std::pair<std::string, ShaderSource>> allSources()
{
  NamedSources sources{ { "refine", refineSource(false) }, { "refine_masked", refineSource(true) },
    { "invert", invertSource() }, { "normals", normalsSource() }, { "blocks", blocksSource() },
    { "presence_rest", presenceSource(false) }, { "presence_deformed", presenceSource(true) },
    { "proxy", proxySource() }, { "composite", compositeSource(false) },
    { "composite_occluded", compositeSource(true) }, { "occlusion", occlusionSource() },
    { "smooth_occlusion", smoothOcclusionSource() }, { "enlarge", enlargeSource() },
    { "cover", coverSource() }, { "traces_over", tracesOverSource() } };
  for (const bool deformed : { false, true })
  {
    addAlone(sources, deformed);
    addSteep(sources, deformed);
    addCompared(sources, deformed);
    addStreamed(sources, deformed);
    addStreamedSlices(sources, deformed);
  }
  addEvidence(sources);
  addResected(sources);
  sources.emplace_back("traces", tracesSource(0));
  sources.emplace_back("traces_hidden", tracesSource(MaxTissues));
  sources.emplace_back("slices_rest", slicesSource({}));
  sources.emplace_back("slices_deformed", slicesSource({ true }));
  sources.emplace_back("slices_direct", slicesSource({ true, Coloring::Direct }));
  sources.emplace_back("slices_compared", slicesSource({ true, Coloring::OtherScalar, true }));
  sources.emplace_back("slices_cavity", slicesSource({ true, Coloring::Mapped, true, true }));
  sources.emplace_back(
    "slices_evidence", slicesSource({ true, Coloring::Mapped, false, false, true }));
  sources.emplace_back(
    "slices_compared_evidence", slicesSource({ true, Coloring::Mapped, true, false, true }));
  sources.emplace_back(
    "slices_resected", slicesSource({ true, Coloring::Mapped, false, false, false, true, true }));
  return sources;
}
}
