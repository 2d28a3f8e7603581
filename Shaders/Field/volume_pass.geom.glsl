// Render to a 3D texture: sends each triangle to its layer.

layout(triangles) in;
layout(triangle_strip, max_vertices = 3) out;

flat in int layerVSOut[];
flat out int layerGSOut;

void main()
{
  for (int i = 0; i < 3; ++i)
  {
    layerGSOut = layerVSOut[i];
    gl_Layer = layerVSOut[i];
    gl_Position = gl_in[i].gl_Position;
    EmitVertex();
  }
  EndPrimitive();
}
