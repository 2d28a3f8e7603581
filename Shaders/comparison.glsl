// A reference volume beside the bent one, in one picture. The reference is not bent: it is read
// where the fragment lies, not where its tissue came from.

#ifdef COMPARED
uniform sampler3D reference;       // red: the scalar, as stored
uniform mat4 referenceFromTexture; // its texture coordinates from the volume's
uniform vec3 referenceLow;         // its box, in its texture coordinates
uniform vec3 referenceHigh;
uniform vec2 shareFromReference;  // stored scalar to its share of the shown range: scale, shift
uniform vec2 shareFromScalar;     // the same of the volume
uniform vec2 transferFromShare;   // share to the colour map's coordinate: scale, shift
uniform int comparison;           // as vtkDeformedSlicesMapper numbers them
uniform vec3 checkersFromTexture; // checker fields for a texture unit

// The reference's share of its range, and whether there is one here.
float referenceShareAt(vec3 deformed, out bool known)
{
  vec3 place = (referenceFromTexture * vec4(deformed, 1.0)).xyz;
  float scalar = textureLod(reference, place, 0.0).r;
  known = all(greaterThanEqual(place, referenceLow)) && all(lessThanEqual(place, referenceHigh)) &&
    !isnan(scalar);
  return known ? clamp(scalar * shareFromReference.x + shareFromReference.y, 0.0, 1.0) : 0.0;
}

bool inEvenField(vec3 deformed)
{
  ivec3 field = ivec3(floor(deformed * checkersFromTexture));
  return ((field.x + field.y + field.z) & 1) == 0;
}

vec3 compared(vec3 color, float scalar, vec3 deformed)
{
  bool known;
  float other = referenceShareAt(deformed, known);
  float own = clamp(scalar * shareFromScalar.x + shareFromScalar.y, 0.0, 1.0);
  if (comparison == 1)
  {
    return vec3(own, other, 0.0);
  }
  if (comparison == 2)
  {
    return known && !inEvenField(deformed)
      ? textureLod(transfer, vec2(other * transferFromShare.x + transferFromShare.y, transferRow), 0.0).rgb
      : color;
  }
  return known ? vec3(0.5 + 0.5 * (own - other)) : vec3(0.5);
}
#else
vec3 compared(vec3 color, float scalar, vec3 deformed)
{
  return color;
}
#endif
