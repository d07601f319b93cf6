#include "host/show/render/lighting.hpp"

#include <algorithm>
#include <cmath>

namespace verp::render {
namespace {

constexpr std::size_t kMostLights = 8;

std::string header_of(const scene::Scene& scene, const View& view, const Effects& effects,
                      bool of_floor, bool textured) {
  const std::size_t count = std::min<std::size_t>(scene.lights.size(), kMostLights);
  std::string kinds;
  for (std::size_t i = 0; i < count; ++i) {
    kinds += (i == 0 ? "" : ",") + std::to_string(static_cast<int>(scene.lights[i].kind));
  }
  std::string header = "#version 330 core\n#define LIGHTS " + std::to_string(count) +
                       "\n#define SHADOW " + std::to_string(view.shadow_light) + "\n#define TAPS " +
                       (effects.quick ? "4\n#define BIAS 3.0" : "12\n#define BIAS 1.0") +
                       "\nconst int kKind[" + std::to_string(std::max<std::size_t>(count, 1)) +
                       "] = int[](" + (count == 0 ? "0" : kinds) + ");\n";
  if (of_floor) header += "#define FLOOR\n";
  if (of_floor && effects.ground_grid) header += "#define TILED\n";
  if (textured) header += "#define TEXTURED\n";
  if (scene.fog.on && effects.fog) header += "#define FOG\n";
  return header;
}

void set_air(const scene::Scene& scene, Program& program) {
  program.set("ambient", Eigen::Vector3f(linear(scene.ambient) * scene.ambient_strength));
  program.set("zenith", linear(scene.sky.zenith));
  program.set("horizon", linear(scene.sky.horizon));
  program.set("fog_colour", linear(scene.fog.colour));
  glUniform2f(program.at("fog_range"), static_cast<float>(scene.fog.begin_m),
              static_cast<float>(std::max(scene.fog.end_m, scene.fog.begin_m + 0.01)));
  glUniform2f(program.at("fog_density"), static_cast<float>(scene.fog.density_1_m),
              scene.fog.squared ? 2.0F : 1.0F);
  program.set("floor_light", linear(scene.ground.light));
  program.set("floor_dark", linear(scene.ground.dark));
  program.set("floor_line", linear(scene.ground.line));
  program.set("floor_tile", static_cast<float>(scene.ground.tile_m));
  program.set("floor_fade", static_cast<float>(scene.ground.fade_m));
}

}  // namespace

Eigen::Vector3f linear(const scene::Colour& colour) {
  return {std::pow(colour.r, 2.2F), std::pow(colour.g, 2.2F), std::pow(colour.b, 2.2F)};
}

void Lighting::make_shadow_map(int texels) {
  if (texels == shadow_texels_) return;
  shadow_texels_ = texels;
  glBindTexture(GL_TEXTURE_2D, shadow_.id());
  glTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT24, texels, texels, 0, GL_DEPTH_COMPONENT,
               GL_FLOAT, nullptr);
  for (const int filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER}) {
    glTexParameteri(GL_TEXTURE_2D, static_cast<GLenum>(filter), GL_LINEAR);
  }
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  glBindFramebuffer(GL_FRAMEBUFFER, shadow_frame_.id());
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, shadow_.id(), 0);
  glDrawBuffer(GL_NONE);
  glReadBuffer(GL_NONE);
}

int Lighting::shadow_light(const scene::Scene& scene, const Effects& effects) {
  const auto& lights = scene.lights;
  for (std::size_t i = 0; effects.shadows && i < std::min(lights.size(), kMostLights); ++i) {
    if (lights[i].kind == scene::Light::Kind::kSun && lights[i].shadows) return static_cast<int>(i);
  }
  return -1;
}

void Lighting::draw_shadows(const std::vector<Placed>& placed, const Mat4& sun,
                            const Effects& effects) {
  make_shadow_map(effects.quick ? kQuickShadowTexels : kShadowTexels);
  glBindFramebuffer(GL_FRAMEBUFFER, shadow_frame_.id());
  glViewport(0, 0, shadow_texels_, shadow_texels_);
  glClear(GL_DEPTH_BUFFER_BIT);
  shade_.use();
  shade_.set("sun_world", sun);
  for (const Placed& item : placed) {
    if (item.item->material.colour.a < 0.99F || item.item->collision) continue;
    shade_.set("world_item", item.world);
    shade_.set("scale", item.scale);
    item.mesh->draw();
  }
}

Program& Lighting::program(const scene::Scene& scene, const View& view, const Effects& effects,
                           bool of_floor, bool textured) {
  const std::string header = header_of(scene, view, effects, of_floor, textured);
  auto found = lit_.find(header);
  if (found == lit_.end()) {
    found = lit_.emplace(header, Program(kSolidVertex, kLitFragment, header.c_str())).first;
  }
  set_common(scene, found->second, view);
  return found->second;
}

void Lighting::set_lights(const scene::Scene& scene, Program& program, double sun_radius_m) {
  const int count = static_cast<int>(std::min<std::size_t>(scene.lights.size(), kMostLights));
  for (int i = 0; i < count; ++i) {
    const scene::Light& light = scene.lights[static_cast<std::size_t>(i)];
    const auto name = [&](const char* array) {
      return std::string(array) + "[" + std::to_string(i) + "]";
    };
    Eigen::Vector4f at, colour;
    at << light.position_m.cast<float>(), static_cast<float>(light.kind);
    colour << linear(light.colour) * light.strength, static_cast<float>(light.range_m);
    program.set(name("light_at").c_str(), at);
    program.set(name("light_toward").c_str(),
                Eigen::Vector3f(light.direction.normalized().cast<float>()));
    program.set(name("light_colour").c_str(), colour);
    program.set(name("light_fading").c_str(), Eigen::Vector3f(light.fading.cast<float>()));
    glUniform2f(program.at(name("light_cone").c_str()),
                static_cast<float>(std::cos(light.inner_rad)),
                static_cast<float>(std::cos(light.outer_rad)));
  }
  program.set("shadow", 0);
  program.set("picture", 1);
  program.set("shadow_texel", 1.0F / static_cast<float>(shadow_texels_));
  constexpr double kSoft_m = 0.011;
  program.set("shadow_soft", static_cast<float>(std::clamp(
                                 kSoft_m * shadow_texels_ / (2 * sun_radius_m), 1.2, 14.0)));
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, shadow_.id());
}

void Lighting::set_common(const scene::Scene& scene, Program& program, const View& view) {
  program.use();
  program.set("clip_world", view.clip);
  program.set("sun_world", view.sun);
  program.set("eye", Eigen::Vector3f(view.eye_m.cast<float>()));
  set_lights(scene, program, view.sun_radius_m);
  set_air(scene, program);
}

}  // namespace verp::render
