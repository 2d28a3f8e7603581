// Gradients for light, found once when the volume is loaded (paper, section 2: half resolution,
// 16-bit floats). Not of unit length: long ones count more where the filter blends neighbours.
// Packed: 16-bit whole numbers, from -0.5 to 0.5 about PackedZero, and the scalar in alpha, so that
// a sample needs one read instead of two.

uniform sampler3D scalars;
uniform vec3 texel;          // one texel of the target, texture coordinates
uniform vec3 voxel;          // one voxel, texture coordinates
uniform float gradientScale; // keeps gradients within what 16 bits hold

void main()
{
  vec3 middle = (vec3(targetTexel()) + 0.5) * texel;
  vec3 gradient = centralDifferences(scalars, middle, voxel) * gradientScale;
  bool unknown = any(isnan(gradient)) || any(isinf(gradient));
  gradient = unknown ? vec3(0.0) : gradient;
#ifdef PACKED_GRADIENTS
  gl_FragData[0] = vec4(0.5 * gradient + PackedZero, textureLod(scalars, middle, 0.0).r);
#else
  gl_FragData[0] = vec4(gradient, 0.0);
#endif
}
