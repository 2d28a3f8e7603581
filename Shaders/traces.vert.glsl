// A traced point as a ball: where its middle is seen, and how large.

in vec3 position; // the points' own coordinates, mm
in vec4 color;    // opacity not multiplied in

uniform mat4 worldFromPoint;
uniform mat4 clipFromWorld;
uniform vec3 ahead;        // unit vector the way the camera looks, world axes
uniform float radius;      // mm
uniform float pixelsForMm; // where the homogeneous w is 1

flat out vec4 ballColor;
flat out float ballDepth; // of the middle, mm ahead
flat out float ballRadius;

const float LeastRadius = 1.5; // pixels; smaller balls are lost to the eye

void main()
{
  vec4 world = worldFromPoint * vec4(position, 1.0);
  gl_Position = clipFromWorld * world;
  float scale = pixelsForMm / gl_Position.w;
  float pixels = max(radius * scale, LeastRadius);
  gl_PointSize = 2.0 * pixels;
  ballColor = color;
  ballDepth = dot(ahead, world.xyz);
  ballRadius = pixels / scale;
}
