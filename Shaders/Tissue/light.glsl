// Phong's model (paper, section 2; Communications of the ACM 18(6), 1975) with ParaView's lights,
// two-sided as its volumes are.

// How light changes a colour.
struct Shine
{
  vec3 factor;
  vec3 added;
};

vec3 shone(Shine shine, vec3 color)
{
  return color * shine.factor + shine.added;
}

#ifdef SHADED
uniform int lightCount;
uniform vec4 lightPosition[MAX_LIGHTS]; // world; w 0: direction towards the light, unit length
uniform vec3 lightColor[MAX_LIGHTS];    // times intensity
uniform vec3 lightSpecular[MAX_LIGHTS];
uniform int headlight; // 1: the only light is at the eye
uniform vec4 material; // ambient, diffuse, specular, specular power

// `normal`, `towardsEye`: unit length, world axes; `position`: mm, world.
Shine shineOn(vec3 normal, vec3 towardsEye, vec3 position)
{
  Shine shine = Shine(vec3(material.x), vec3(0.0));
  if (headlight == 1)
  {
    // The most common case: the light is at the eye.
    float facing = dot(normal, towardsEye);
    shine.factor += material.y * abs(facing) * lightColor[0];
    if (material.z > 0.0)
    {
      float glint = max(2.0 * facing * facing - 1.0, 0.0);
      shine.added = material.z * pow(glint, material.w) * lightSpecular[0];
    }
    return shine;
  }
  for (int i = 0; i < lightCount; ++i)
  {
    vec3 towardsLight = normalize(lightPosition[i].xyz - position * lightPosition[i].w);
    float facing = dot(normal, towardsLight);
    shine.factor += material.y * abs(facing) * lightColor[i];
    if (material.z > 0.0)
    {
      vec3 mirrored = 2.0 * facing * normal - towardsLight;
      float glint = max(dot(mirrored, towardsEye), 0.0);
      shine.added += material.z * pow(glint, material.w) * lightSpecular[i];
    }
  }
  return shine;
}
#endif
