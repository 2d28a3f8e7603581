// Which tissue is drawn if a segment is drawn alone.

#ifdef SEGMENTED
uniform sampler3D segment; // red: how much of a place belongs to the segment; 0.5: the edge

float segmentFractionAt(vec3 rest)
{
  return textureLod(segment, rest, 0.0).r;
}

// Factor on opacity. It rises across the edge, so that the edge shows no steps.
float segmentOpacityAt(vec3 rest)
{
  return clamp((segmentFractionAt(rest) - LEAST_FRACTION) / (1.0 - 2.0 * LEAST_FRACTION), 0.0, 1.0);
}

bool inSegment(vec3 rest)
{
  return segmentFractionAt(rest) >= 0.5;
}
#else
float segmentOpacityAt(vec3 rest)
{
  return 1.0;
}

bool inSegment(vec3 rest)
{
  return true;
}
#endif
