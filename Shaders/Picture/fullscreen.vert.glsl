// One triangle that covers the viewport: three vertices without a buffer.

out vec2 ndc; // -1 to 1 across the viewport

void main()
{
  ndc = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  gl_Position = vec4(ndc, 0.0, 1.0);
}
