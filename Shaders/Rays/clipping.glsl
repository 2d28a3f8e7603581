// What is cut away from the deformed frame. Clipping planes narrow a ray's span. Cropping regions
// drop single samples.

uniform int clipCount;
uniform vec4 clipPlanes[MAX_CLIP_PLANES]; // texture coordinates; kept: dot(xyz, p) + w >= 0

// First and last t on the kept side of every plane; last < first if there is none. Behind a cut,
// the first sample lies in the middle of its step. If samples were numbered from anywhere else, the
// cut face would show rings.
vec2 clippedSpan(Ray ray, vec2 span, float stepMm)
{
  for (int i = 0; i < clipCount; ++i)
  {
    float height = dot(clipPlanes[i].xyz, ray.start) + clipPlanes[i].w; // at the near plane
    float slope = dot(clipPlanes[i].xyz, ray.direction);                // for each mm
    if (slope > 0.0 && height < 0.0)
    {
      span.x = max(span.x, 0.5 * stepMm - height / slope);
    }
    else if (slope < 0.0)
    {
      span.y = min(span.y, -height / slope);
    }
    else if (height < 0.0)
    {
      span.y = -1.0; // the whole ray is cut away
    }
  }
  return span;
}

bool notClipped(vec3 deformed)
{
  bool kept = true;
  for (int i = 0; i < clipCount; ++i)
  {
    kept = kept && dot(clipPlanes[i].xyz, deformed) + clipPlanes[i].w >= 0.0;
  }
  return kept;
}

#ifdef REGIONS
uniform vec3 regionLow; // the planes between VTK's 27 cropping regions, texture coordinates
uniform vec3 regionHigh;
uniform int regionFlags; // bit x + 3 y + 9 z: the region is kept

bool inKeptRegion(vec3 deformed)
{
  ivec3 region =
    ivec3(greaterThanEqual(deformed, regionLow)) + ivec3(greaterThanEqual(deformed, regionHigh));
  return (regionFlags >> (region.x + 3 * region.y + 9 * region.z) & 1) == 1;
}
#else
bool inKeptRegion(vec3 deformed)
{
  return true;
}
#endif
