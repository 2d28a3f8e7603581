// Phong's model (paper, section 2) with ParaView's lights, two-sided as its volumes are.

#ifdef SHADED
uniform int lightCount;
uniform vec4 lightPosition[MAX_LIGHTS]; // world; w 0: direction towards the light, unit length
uniform vec3 lightColor[MAX_LIGHTS];    // times intensity
uniform vec3 lightSpecular[MAX_LIGHTS];
uniform int headlight;                  // 1: one light, at the eye
uniform vec4 material;                  // ambient, diffuse, specular, specular power

// `normal`, `towardsEye`: unit length, world axes; `position`: mm, world.
vec3 lit(vec3 color, vec3 normal, vec3 towardsEye, vec3 position)
{
  vec3 diffuse = vec3(0.0);
  vec3 specular = vec3(0.0);
  for (int i = 0; i < lightCount; ++i)
  {
    vec3 towardsLight = headlight == 1 ? towardsEye
                                       : normalize(lightPosition[i].xyz - position * lightPosition[i].w);
    float facing = dot(normal, towardsLight);
    vec3 mirrored = 2.0 * facing * normal - towardsLight;
    float glint = max(dot(mirrored, towardsEye), 0.0);
    diffuse += abs(facing) * lightColor[i];
    specular += pow(glint, material.w) * lightSpecular[i];
  }
  return material.x * color + material.y * diffuse * color + material.z * specular;
}
#endif
