// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Picture/CastImages.h"

#include "Representations/Picture/ImageScope.h"
#include "Representations/Scene/RayCastScene.h"

#include "vtkOpenGLRenderWindow.h"

#include <utility>

namespace brainshift
{
vtkSmartPointer<vtkTextureObject> makeImage(
  vtkOpenGLRenderWindow* window, const glm::ivec2& size, unsigned int format, int filter)
{
  auto image = vtkSmartPointer<vtkTextureObject>::New();
  image->SetContext(window);
  image->SetInternalFormat(format);
  image->SetMinificationFilter(filter);
  image->SetMagnificationFilter(filter);
  image->SetWrapS(vtkTextureObject::ClampToEdge);
  image->SetWrapT(vtkTextureObject::ClampToEdge);
  return image->Allocate2D(size.x, size.y, 4, VTK_FLOAT) ? image : nullptr;
}

namespace
{
bool sameSize(vtkTextureObject* image, const glm::ivec2& size)
{
  return image->GetWidth() == static_cast<unsigned int>(size.x) &&
    image->GetHeight() == static_cast<unsigned int>(size.y);
}
}

bool CastImages::prepare(vtkOpenGLRenderWindow* window, const RayCastScene& scene)
{
  const ImageArea area = areaAround(this->Area, scene.image.size, scene.image.part.box);
  const PixelBox anything{ glm::ivec2(-1), scene.image.size + 1 }; // the memory is not cleared yet
  if (!this->Image || area != this->Area)
  {
    this->Filled = anything;
  }
  this->Area = area;
  const auto make = [&](vtkSmartPointer<vtkTextureObject>& image, int format, int filter) {
    if (!image || !sameSize(image, this->Area.size))
    {
      image = makeImage(window, this->Area.size, format, filter);
    }
    return image != nullptr;
  };
  FirstHits& hits = this->Hits[scene.frame.tile];
  if (!hits.texture || hits.area != this->Area)
  {
    this->HitsFilled[scene.frame.tile] = anything;
  }
  hits.area = this->Area;
  if (!make(this->Image, GL_RGBA8, vtkTextureObject::Linear) ||
    !make(hits.texture, GL_R32F, vtkTextureObject::Nearest) ||
    !make(this->Spans, GL_RG16, vtkTextureObject::Nearest))
  {
    return false;
  }
  float none[4] = { -1.0f, -1.0f, -1.0f, -1.0f };
  hits.texture->SetWrapS(vtkTextureObject::ClampToBorder);
  hits.texture->SetWrapT(vtkTextureObject::ClampToBorder);
  hits.texture->SetBorderColor(none);
  return true;
}

void CastImages::attach(
  ImageScope& scope, const RayCastScene& scene, bool part, const RayCastVariant& variant)
{
  FirstHits& hits = this->Hits[scene.frame.tile];
  scope.attach(0, this->Image);
  scope.attach(1, hits.texture);
  if (!part)
  {
    this->clearStale(scene);
    hits.frustum = frustumOf(scene.frame.clipFromWorld);
    this->DrewTile = scene.frame.tile;
  }
  if (variant.counted)
  {
    scope.attach(2, this->Count);
  }
  if (variant.asks)
  {
    scope.attach(2, this->Wishes);
    this->clear(2);
    this->HasWishes = true;
  }
  this->Filled = part ? enclosing(this->Filled, scene.image.part.box) : scene.image.part.box;
  this->HitsFilled[scene.frame.tile] = this->Filled;
}

void CastImages::drawPart(Program& program, const PixelPart& part) const
{
  std::vector<glm::vec2> corners;
  for (const glm::dvec2& corner : stripOf(part))
  {
    corners.emplace_back(2.0 * corner / glm::dvec2(this->Area.picture) - 1.0);
  }
  if (isDrawnAsBox(part))
  {
    // The scissors cut the box out of one large triangle. So no edge lies within the box, along
    // which software drivers would draw blocks of pixels twice.
    corners = { { -1.0f, -1.0f }, { 3.0f, -1.0f }, { -1.0f, 3.0f } };
  }
  program.set("corners", corners.data(), corners.size());
  drawStrip(static_cast<int>(corners.size()));
}

// Nothing of an earlier picture may stay outside the part that is cast now.
void CastImages::clearStale(const RayCastScene& scene)
{
  if (!contains(scene.image.part.box, this->Filled))
  {
    this->clear(0);
  }
  if (!contains(scene.image.part.box, this->HitsFilled[scene.frame.tile]))
  {
    this->clear(1);
  }
}

// Clears all of the attached picture (0), hits (1) or wishes (2).
void CastImages::clear(unsigned int target)
{
  const float nothing = target == 0 ? 0.0f : -1.0f;
  const float values[4] = { nothing, nothing, nothing, nothing };
  glDisable(GL_SCISSOR_TEST);
  glClearBufferfv(GL_COLOR, static_cast<GLint>(target), values);
  glEnable(GL_SCISSOR_TEST);
}

bool CastImages::hold(const RayCastScene& scene) const
{
  const FirstHits& hits = this->Hits[false];
  return this->Image && hits.texture && !this->DrewTile && !scene.frame.tile &&
    this->Area.picture == scene.image.size && hits.area == this->Area;
}

bool CastImages::grow(vtkOpenGLRenderWindow* window, const RayCastScene& scene, Counters& counters)
{
  const CastImages old = *this;
  FirstHits& hits = this->Hits[false];
  this->Image = nullptr;
  hits.texture = nullptr;
  RayCastScene roomy = scene;
  roomy.image.part.box = enclosing(scene.image.part.box, old.Filled);
  if (!this->prepare(window, roomy))
  {
    return false;
  }
  {
    ImageScope scope(window->GetState(), this->Area.box(), this->Area);
    scope.attach(0, this->Image);
    scope.attach(1, hits.texture);
    this->clear(0);
    this->clear(1);
  }
  this->Filled = this->HitsFilled[false] = PixelBox();
  return this->enlarge(window, old, partOf(old.Filled), counters);
}

glm::dvec2 CastImages::hitFromFraction(const RayCastScene& scene) const
{
  return fractionFromFraction(this->Hits[false].frustum, frustumOf(scene.frame.clipFromWorld));
}

void CastImages::trimTile(int margin, const glm::dmat4& clipFromWorld)
{
  FirstHits& hits = this->Hits[true];
  hits.area.picture -= 2 * margin;
  hits.area.low -= margin;
  hits.frustum = frustumOf(clipFromWorld);
}

bool CastImages::prepareCount(vtkOpenGLRenderWindow* window)
{
  const glm::ivec2& size = this->Area.size;
  this->Count = vtkSmartPointer<vtkTextureObject>::New();
  this->Count->SetContext(window);
  std::vector<float> zeros(static_cast<std::size_t>(size.x) * size.y * 4, 0.0f);
  return this->Count->Create2DFromRaw(size.x, size.y, 4, VTK_FLOAT, zeros.data());
}

bool CastImages::prepareWishes(vtkOpenGLRenderWindow* window)
{
  if (!this->Wishes || !sameSize(this->Wishes, this->Area.size))
  {
    this->Wishes = makeImage(window, this->Area.size, GL_RG32F, vtkTextureObject::Nearest);
  }
  return this->Wishes != nullptr;
}

std::vector<glm::vec2> CastImages::takeWishes()
{
  std::vector<glm::vec2> wishes;
  if (std::exchange(this->HasWishes, false) && this->Wishes)
  {
    wishes.resize(static_cast<std::size_t>(this->Wishes->GetWidth()) * this->Wishes->GetHeight());
    this->Wishes->Activate();
    glGetTexImage(GL_TEXTURE_2D, 0, GL_RG, GL_FLOAT, wishes.data());
    this->Wishes->Deactivate();
  }
  return wishes;
}

void CastImages::readCount(Counters& counters)
{
  std::vector<float> counted(
    static_cast<std::size_t>(this->Count->GetWidth()) * this->Count->GetHeight() * 4);
  this->Count->Activate();
  glGetTexImage(GL_TEXTURE_2D, 0, GL_RGBA, GL_FLOAT, counted.data());
  this->Count->Deactivate();
  for (std::size_t i = 0; i < counted.size(); i += 4)
  {
    counters.samplesTaken += static_cast<std::int64_t>(counted[i]);
    counters.samplesSkipped += static_cast<std::int64_t>(counted[i + 1]);
  }
}

bool CastImages::hitAt(vtkOpenGLRenderWindow* window, const glm::dvec2& place, glm::dvec4& hit)
{
  const FirstHits& hits = this->Hits[false];
  if (!hits.texture)
  {
    return false;
  }
  const glm::dvec2 size(hits.area.picture);
  const glm::ivec2 pixel(place * size);
  if (glm::any(glm::lessThan(pixel, hits.area.low)) ||
    glm::any(glm::greaterThanEqual(pixel, hits.area.high())))
  {
    return false;
  }
  vtkOpenGLState* state = window->GetState();
  FramebufferScope framebuffer(state);
  glFramebufferTexture2D(
    GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, hits.texture->GetHandle(), 0);
  state->vtkglReadBuffer(GL_COLOR_ATTACHMENT0);
  float fraction = -1.0f;
  const glm::ivec2 texel = pixel - hits.area.low;
  glReadPixels(texel.x, texel.y, 1, 1, GL_RED, GL_FLOAT, &fraction);
  const glm::dvec2 ndc = 2.0 * (glm::dvec2(pixel) + 0.5) / size - 1.0; // of the pixel's own ray
  const glm::dvec3 near = hits.frustum.near.at(ndc);
  const glm::dvec3 way = static_cast<double>(fraction) * (hits.frustum.far.at(ndc) - near);
  hit = glm::dvec4(near + way, glm::length(way));
  return fraction >= 0.0f;
}

bool CastImages::composite(vtkOpenGLRenderWindow* window, const PixelBox& rectangle,
  const PictureShade& shade, Counters& counters)
{
  const bool occluded = shade.occlusion != nullptr;
  Program& program = this->CompositePrograms[occluded];
  if (!program.use(window, compositeSource(occluded), counters))
  {
    return false;
  }
  const glm::ivec2 origin = rectangle.low - shade.margin;
  const glm::ivec2 size = rectangle.size() + 2 * shade.margin;
  vtkOpenGLState* state = window->GetState();
  vtkOpenGLState::ScopedglViewport viewport(state);
  vtkOpenGLState::ScopedglBlendFuncSeparate blendFunction(state);
  vtkOpenGLState::ScopedglEnableDisable blend(state, GL_BLEND);
  vtkOpenGLState::ScopedglEnableDisable depthTest(state, GL_DEPTH_TEST);
  vtkOpenGLState::ScopedglEnableDisable cull(state, GL_CULL_FACE);
  vtkOpenGLState::ScopedglScissor scissorBox(state);
  vtkOpenGLState::ScopedglEnableDisable scissor(state, GL_SCISSOR_TEST);
  if (shade.margin > 0)
  {
    state->vtkglEnable(GL_SCISSOR_TEST);
    const glm::ivec2 shown = rectangle.size();
    state->vtkglScissor(rectangle.low.x, rectangle.low.y, shown.x, shown.y);
  }
  state->vtkglEnable(GL_BLEND);
  state->vtkglBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  state->vtkglDisable(GL_DEPTH_TEST);
  state->vtkglDisable(GL_CULL_FACE);
  const glm::ivec2& end = this->Area.picture;
  const glm::dvec2 scale = glm::dvec2(size) / glm::dvec2(end);
  const glm::ivec2 low(glm::floor(glm::dvec2(this->Filled.low) * scale));
  const glm::ivec2 filled(
    glm::max(glm::ceil(glm::dvec2(this->Filled.high) * scale) - glm::dvec2(low), 0.0));
  state->vtkglViewport(origin.x + low.x, origin.y + low.y, filled.x, filled.y);
  const int filter =
    scale == glm::dvec2(1.0) ? vtkTextureObject::Nearest : vtkTextureObject::Linear;
  this->Image->SetMinificationFilter(filter);
  this->Image->SetMagnificationFilter(filter);
  program.set("image", this->Image.Get());
  program.set("origin", glm::vec2(origin));
  program.set("textureFromPixel", glm::vec2(this->Area.textureFromFraction() / glm::dvec2(size)));
  program.set("textureOfOrigin", glm::vec2(this->Area.textureOfFractionZero()));
  if (occluded)
  {
    program.set("occlusion", shade.occlusion);
    program.set("darkness", static_cast<float>(shade.darkness));
  }
  drawTriangles(1);
  this->Image->Deactivate();
  if (occluded)
  {
    shade.occlusion->Deactivate();
  }
  return true;
}

bool CastImages::enlarge(
  vtkOpenGLRenderWindow* window, const CastImages& other, const PixelPart& part, Counters& counters)
{
  if (!this->EnlargeProgram.use(window, enlargeSource(), counters))
  {
    return false;
  }
  ImageScope images(window->GetState(), part.box, this->Area);
  images.attach(0, this->Image);
  images.attach(1, this->Hits[false].texture);
  vtkTextureObject* picture = other.Image;
  vtkTextureObject* hits = other.Hits[false].texture;
  const int filter =
    other.Area.picture == this->Area.picture ? vtkTextureObject::Nearest : vtkTextureObject::Linear;
  picture->SetMinificationFilter(filter);
  picture->SetMagnificationFilter(filter);
  this->EnlargeProgram.set("image", picture);
  this->EnlargeProgram.set("hits", hits);
  this->EnlargeProgram.set("textureFromFraction", glm::vec2(other.Area.textureFromFraction()));
  this->EnlargeProgram.set("textureOfFractionZero", glm::vec2(other.Area.textureOfFractionZero()));
  this->drawPart(this->EnlargeProgram, part);
  picture->Deactivate();
  hits->Deactivate();
  this->Filled = this->HitsFilled[false] = enclosing(this->Filled, part.box);
  return true;
}

void CastImages::releaseGraphicsResources(vtkWindow* window)
{
  for (auto* image : { &this->Image, &this->Hits[0].texture, &this->Hits[1].texture, &this->Count,
         &this->Spans, &this->Wishes })
  {
    if (*image)
    {
      (*image)->ReleaseGraphicsResources(window);
    }
    *image = nullptr;
  }
  this->Area = ImageArea();
  for (Program& program : this->CompositePrograms)
  {
    program.forget();
  }
  this->EnlargeProgram.forget();
}
}
