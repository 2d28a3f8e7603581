// Gradients for light, computed once when the volume is loaded (paper, section 2). They keep their
// length: long ones count more where the filter blends neighbours. Ten bits a component.

uniform sampler3D scalars;
uniform vec3 texel;          // one texel of the target, texture coordinates
uniform vec3 voxel;          // one voxel, texture coordinates
uniform float gradientScale; // gradients longer than 1, once scaled, are cut

void main()
{
  vec3 middle = (targetTexel() + 0.5) * texel;
  vec3 gradient = centralDifferences(scalars, middle, voxel) * gradientScale;
  gradient = all(areNumbers(gradient)) ? gradient : vec3(0.0);
  gradient /= max(length(gradient), 1.0); // keeps the direction
  gl_FragData[0] = vec4(511.0 / 1023.0 * gradient + ZeroGradient, 0.0);
}
