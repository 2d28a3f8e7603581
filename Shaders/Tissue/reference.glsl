// A reference volume beside the bent one, on a grid of its own. It is not bent and not resampled.
// One matrix leads from a sample to its place in the reference.

uniform sampler3D reference;       // red: the scalar, as stored
uniform mat4 referenceFromTexture; // its texture coordinates from the volume's
uniform vec3 referenceLow;         // its box, in its texture coordinates
uniform vec3 referenceHigh;
uniform vec3 cropLow; // what cropping leaves of it, the volume's texture coordinates
uniform vec3 cropHigh;
uniform sampler2D referenceTransfer; // colour map of the reference, see `transfer` in tissue.glsl
uniform vec2 transferFromReference; // stored scalar to the colour map's coordinate: scale, shift
uniform vec2 visibleReference;      // stored scalars beyond which nothing is visible
uniform mat3 worldFromReferenceGradient; // world axes, from a gradient for its texture units

TissueTable referenceTable()
{
  return TissueTable(referenceLow, referenceHigh, transferFromReference, visibleReference);
}

vec3 referenceFromDeformed(vec3 deformed)
{
  return (referenceFromTexture * vec4(deformed, 1.0)).xyz;
}

float referenceScalarAt(vec3 place)
{
  return textureLod(reference, place, 0.0).r;
}

// Opacity of one step: 0 outside the reference or if the scalar is not a number.
float referenceOpacityAt(TissueTable table, vec3 place, float scalar)
{
  float entry = scalar * table.transferFromScalar.x + table.transferFromScalar.y;
  bool there = insideVolume(table, place) && isNumber(scalar);
  return there ? textureLod(referenceTransfer, vec2(entry, transferRow), 0.0).a : 0.0;
}

// A ray and its samples in the reference's texture coordinates; t stays the same.
Ray referenceRay(Ray ray)
{
  return Ray(referenceFromDeformed(ray.start), mat3(referenceFromTexture) * ray.direction,
    ray.lengthMm);
}

Track referenceTrack(Track deformed)
{
  return Track(referenceFromDeformed(deformed.first), mat3(referenceFromTexture) * deformed.stride);
}

// First and last t at which the reference is drawn; last < first if there is none.
vec2 referenceSpan(Ray ray)
{
  vec2 inBox = boxSpan(referenceRay(ray), referenceLow, referenceHigh);
  vec2 inCrop = boxSpan(ray, cropLow, cropHigh);
  return vec2(max(inBox.x, inCrop.x), min(inBox.y, inCrop.y));
}

// The reference's gradient, of any length.
#ifdef GRADIENT_TEXTURE
uniform sampler3D referenceNormals; // see normals.frag.glsl

vec3 referenceGradientAt(vec3 place)
{
  return textureLod(referenceNormals, place, 0.0).xyz - ZeroGradient;
}
#else
uniform vec3 referenceVoxel; // one voxel, in its texture coordinates

vec3 referenceGradientAt(vec3 place)
{
  return centralDifferences(reference, place, referenceVoxel);
}
#endif
