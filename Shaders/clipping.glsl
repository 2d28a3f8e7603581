// What is cut away of the deformed frame: clipping planes narrow a ray's samples, cropping regions
// drop samples one by one.

uniform int clipCount;
uniform vec4 clipPlanes[MAX_CLIP_PLANES]; // texture coordinates: kept where dot(xyz, p) + w >= 0

// Samples on the kept side of every plane. They keep their numbers, so that skipping stays exact.
ivec2 clippedSamples(Ray ray, vec2 span, float stepMm, ivec2 samples)
{
  for (int i = 0; i < clipCount; ++i)
  {
    float height = dot(clipPlanes[i].xyz, ray.start) + clipPlanes[i].w; // at the near plane
    float slope = dot(clipPlanes[i].xyz, ray.direction);                // for each mm
    float crossing = clamp((-height / slope - span.x) / stepMm, -1e6, 1e6);
    if (slope > 0.0)
    {
      samples.x = max(samples.x, int(ceil(crossing)));
    }
    else if (slope < 0.0)
    {
      samples.y = min(samples.y, int(floor(crossing)) + 1);
    }
    else if (height < 0.0)
    {
      samples.y = samples.x; // all of the ray lies on the side that goes
    }
  }
  return samples;
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
uniform int regionFlags; // bit x + 3 y + 9 z: the region is shown

bool inShownRegion(vec3 deformed)
{
  ivec3 region =
    ivec3(greaterThanEqual(deformed, regionLow)) + ivec3(greaterThanEqual(deformed, regionHigh));
  return (regionFlags >> (region.x + 3 * region.y + 9 * region.z) & 1) == 1;
}
#else
bool inShownRegion(vec3 deformed)
{
  return true;
}
#endif
