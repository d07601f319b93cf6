#include "host/show/render/shaders.hpp"

namespace verp::render {

const char* const kSolidVertex = R"(#version 330 core
layout(location = 0) in vec3 point;
layout(location = 1) in vec3 normal_in;
layout(location = 2) in vec2 texture_in;
uniform mat4 world_item, clip_world, sun_world;
uniform vec3 scale;
out vec3 at, normal;
out vec4 at_sun;
out vec2 texture_at;
void main() {
  vec4 world = world_item * vec4(point * scale, 1.0);
  at = world.xyz;
  normal = mat3(world_item) * (normal_in / scale);
  at_sun = sun_world * world;
  texture_at = texture_in;
  gl_Position = clip_world * world;
}
)";

const char* const kLitFragment = R"(
in vec3 at, normal;
in vec4 at_sun;
in vec2 texture_at;
uniform vec3 eye;
uniform vec4 colour;
uniform vec3 glow, ambient;
uniform float roughness, metallic;
uniform vec4 light_at[8];      // w: of the kind
uniform vec3 light_toward[8];  // in which it shines
uniform vec4 light_colour[8];  // w: range
uniform vec2 light_cone[8];    // cosines of the inner and outer angle
uniform vec3 light_fading[8];
uniform sampler2DShadow shadow;
uniform float shadow_texel, shadow_soft;
uniform sampler2D picture;
uniform vec3 zenith, horizon;
uniform vec3 fog_colour;
uniform vec2 fog_range;
uniform vec2 fog_density;
uniform vec3 floor_light, floor_dark, floor_line;
uniform float floor_tile, floor_fade;
out vec4 out_colour;

const float kPi = 3.14159265;

float power5(float x) {
  float y = x * x;
  return y * y * x;
}

vec3 sky(vec3 direction) {
  float up = clamp(direction.z, 0.0, 1.0);
  return mix(horizon, zenith, sqrt(up));
}

// The spiral's points.
const vec2 kTap[12] = vec2[](
  vec2(0.2041, 0.0), vec2(-0.2607, 0.2388), vec2(0.0399, -0.4547), vec2(0.3287, 0.4287),
  vec2(-0.6031, -0.1067), vec2(0.5715, -0.3640), vec2(-0.1888, 0.7115), vec2(-0.3666, -0.6994),
  vec2(0.7800, 0.3084), vec2(-0.8179, 0.3459), vec2(0.3993, -0.8459), vec2(0.3020, 0.9313));

float lit(float slope) {
  vec3 p = at_sun.xyz / at_sun.w * 0.5 + 0.5;
  vec2 edge = abs(p.xy - 0.5);
  float bias = BIAS * (0.0006 + 0.0016 * slope), sum = 0.0;
  // A spiral, turned by a per-pixel angle: soft without bands.
  float turn = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715)))) * 6.2831853;
  mat2 turned = shadow_texel * shadow_soft * mat2(cos(turn), sin(turn), -sin(turn), cos(turn));
  for (int i = 0; i < TAPS; ++i) {
    sum += texture(shadow, vec3(p.xy + turned * kTap[i * 12 / TAPS], p.z - bias));
  }
  float share = sum / float(TAPS);
  return p.z > 1.0 ? 1.0 : mix(share, 1.0, smoothstep(0.40, 0.49, max(edge.x, edge.y)));
}

#ifdef FLOOR
float grid(vec2 p, float spacing, float width) {
  vec2 q = abs(fract(p / spacing - 0.5) - 0.5) * spacing;
  vec2 w = fwidth(p);
  vec2 line = 1.0 - smoothstep(vec2(0.0), w * 1.2, q - width);
  vec2 thin = clamp(width / (w * 0.6 + 1e-6), 0.0, 1.0);  // far away, lines melt into the floor
  return max(line.x * thin.x, line.y * thin.y);
}

vec3 floor_colour() {
#ifndef TILED
  return floor_light;
#else
  vec2 cell = at.xy / (2.0 * floor_tile);
  vec2 w = max(fwidth(cell), 1e-5);
  // A checker, integrated over the pixel.
  vec2 i = 2.0 * (abs(fract((cell - 0.5 * w) * 1.0) - 0.5) - abs(fract((cell + 0.5 * w) * 1.0) - 0.5)) / w;
  float checker = 0.5 - 0.5 * i.x * i.y;
  vec3 base = mix(floor_light, floor_dark, checker);
  base = mix(base, floor_line, 0.55 * grid(at.xy, floor_tile, 0.0006));
  return mix(base, floor_line, 0.9 * grid(at.xy, 10.0 * floor_tile, 0.0014));
#endif
}

#endif

vec3 finished(vec3 light) {
  light = light / (1.0 + 0.16 * light);  // bright parts keep their colour
#ifdef FLOOR
  float far = length(at.xy - eye.xy) / floor_fade;
  light = mix(light, horizon, 1.0 - exp(-0.7 * far * far));
#endif
#ifdef FOG
  float fog_way = length(eye - at);
  float fog_part = fog_density.x > 0.0 ? 1.0 - exp(-pow(fog_density.x * fog_way, fog_density.y))
                                       : (fog_way - fog_range.x) / (fog_range.y - fog_range.x);
  light = mix(light, fog_colour, clamp(fog_part, 0.0, 1.0));
#endif
  // The power 1 / 2.2 as a sum of roots, within a quarter of one of 255 steps: the power itself is
  // dear where a processor draws.
  vec3 x = clamp(light, 0.0, 1.0), a = sqrt(x), b = sqrt(a);
  return -0.054262 * x + 0.945703 * a + 0.127781 * b - 0.020092 * sqrt(b);
}

// How strongly a light shines here, and from where.
float power_of(int i, out vec3 to) {
  to = -light_toward[i];
  if (kKind[i] == 0) return 1.0;
  to = light_at[i].xyz - at;
  float d = length(to), far = d / light_colour[i].w;
  to /= max(d, 1e-4);
  float part = clamp(1.0 - far * far * far * far, 0.0, 1.0);
  float power = part * part / max(dot(light_fading[i], vec3(1.0, d, d * d)), 1e-4);
  if (kKind[i] == 1) return power;
  return power * smoothstep(light_cone[i].y, light_cone[i].x, dot(-to, light_toward[i]));
}

#ifdef FLOOR
// Dull and level: no shine, no mirror.
void main() {
  vec3 sum = ambient * mix(horizon, zenith, 0.5);
  for (int i = 0; i < LIGHTS; ++i) {
    vec3 to;
    float power = power_of(i, to) * max(to.z, 0.0);
    if (i == SHADOW) power *= lit(sqrt(1.0 - to.z * to.z) / max(to.z, 0.1));
    sum += light_colour[i].rgb * power;
  }
  out_colour = vec4(finished(sum * floor_colour()), 1.0);
}
#else
void main() {
  vec3 n = normalize(normal), v = normalize(eye - at);
  if (dot(n, v) < 0.0) n = -n;
  vec4 base = colour;
#ifdef TEXTURED
  base *= texture(picture, texture_at);
#endif
  float rough = clamp(roughness, 0.05, 1.0), alpha = rough * rough;
  vec3 f0 = mix(vec3(0.04), base.rgb, metallic), diffuse = base.rgb * (1.0 - metallic);
  float nv = max(dot(n, v), 1e-3);
  vec3 sum = vec3(0.0);
  for (int i = 0; i < LIGHTS; ++i) {
    vec3 to;
    float power = power_of(i, to);
    float nl = max(dot(n, to), 0.0);
    if (i == SHADOW) power *= lit(sqrt(1.0 - nl * nl) / max(nl, 0.1));
    vec3 h = normalize(to + v);
    float nh = max(dot(n, h), 0.0), vh = max(dot(v, h), 0.0);
    float d = nh * nh * (alpha * alpha - 1.0) + 1.0;
    float spread = alpha * alpha / (kPi * d * d), k = (rough + 1.0) * (rough + 1.0) / 8.0;
    float hidden = 1.0 / ((nl * (1.0 - k) + k) * (nv * (1.0 - k) + k) * 4.0);
    vec3 fresnel = f0 + (1.0 - f0) * power5(1.0 - vh);
    sum += light_colour[i].rgb * power * nl * (diffuse * (1.0 - fresnel) + fresnel * spread * hidden * kPi);
  }
  // What comes from all around: the sky above, the floor's glow below, and a mirrored horizon.
  vec3 below = 0.55 * floor_light;
  vec3 around = mix(below, mix(horizon, zenith, 0.5), 0.5 + 0.5 * n.z);
  vec3 mirror = reflect(-v, n);
  vec3 seen = mirror.z < 0.0 ? mix(horizon, below, clamp(-3.0 * mirror.z, 0.0, 1.0)) : sky(mirror);
  vec3 fresnel = f0 + (max(vec3(1.0 - rough), f0) - f0) * power5(1.0 - nv);
  vec3 light = sum + ambient * (diffuse * around + fresnel * seen * mix(1.0, 0.4, rough)) + glow;
  out_colour = vec4(finished(light), base.a);
}
#endif
)";

const char* const kShadowVertex = R"(#version 330 core
layout(location = 0) in vec3 point;
uniform mat4 world_item, sun_world;
uniform vec3 scale;
void main() { gl_Position = sun_world * world_item * vec4(point * scale, 1.0); }
)";

const char* const kShadowFragment = R"(#version 330 core
void main() {}
)";

const char* const kSkyVertex = R"(#version 330 core
uniform mat4 world_clip;
uniform vec3 eye;
out vec3 direction;
void main() {
  vec2 p = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  vec4 far = world_clip * vec4(p, 1.0, 1.0);
  direction = far.xyz / far.w - eye;
  gl_Position = vec4(p, 1.0, 1.0);
}
)";

const char* const kSkyFragment = R"(#version 330 core
in vec3 direction;
uniform vec3 zenith, horizon;
out vec4 out_colour;
void main() {
  float up = clamp(normalize(direction).z, 0.0, 1.0);
  vec3 light = mix(horizon, zenith, sqrt(up));
  // Half a step of noise hides the steps of 8 bits.
  float noise = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715)))) - 0.5;
  out_colour = vec4(pow(light, vec3(1.0 / 2.2)) + noise / 255.0, 1.0);
}
)";

const char* const kMeasureFragment = R"(#version 330 core
in vec3 at;
uniform vec3 eye, ahead;
uniform float label;
out vec4 out_colour;
void main() { out_colour = vec4(dot(at - eye, ahead), label, 0.0, 1.0); }
)";

const char* const kMarkVertex = R"(#version 330 core
layout(location = 0) in vec3 point;
layout(location = 1) in vec3 normal_in;
layout(location = 2) in vec4 colour_in;
uniform mat4 clip_world;
out vec3 normal;
out vec4 colour;
void main() {
  normal = normal_in;
  colour = colour_in;
  gl_Position = clip_world * vec4(point, 1.0);
}
)";

const char* const kMarkFragment = R"(#version 330 core
in vec3 normal;
in vec4 colour;
uniform float opacity;
out vec4 out_colour;
void main() {
  float light = 0.78 + 0.22 * normalize(normal).z;
  out_colour = vec4(colour.rgb * light, colour.a * opacity);
}
)";

}  // namespace verp::render
