// A convex part of a picture as a strip of triangles, without a buffer.

uniform vec2 corners[MAX_CORNERS]; // ndc of the picture

out vec2 ndc;

void main()
{
  ndc = corners[gl_VertexID];
  gl_Position = vec4(ndc, 0.0, 1.0);
}
