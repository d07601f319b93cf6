#include "host/render/renderer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>

#include "host/render/marks.hpp"
#include "host/render/shaders.hpp"
#include "host/render/shapes.hpp"
#include "host/render/stage.hpp"
#include "host/scene/build.hpp"
#include "host/sim/body.hpp"

namespace verp::render {

using scene::Colour;
using scene::Vec2;
using scene::Vec3;
using Area = Eigen::AlignedBox2d;

namespace {

constexpr int kShadowTexels = 2048, kQuickShadowTexels = 1024;
constexpr int kSamples = 4;
constexpr std::size_t kMostLights = 8;
constexpr double kFloor_m = 120;  // edges; what is further away is horizon anyway

Eigen::Vector3f linear(const Colour& colour) {
  return {std::pow(colour.r, 2.2F), std::pow(colour.g, 2.2F), std::pow(colour.b, 2.2F)};
}

Mat4 look_at(const Vec3& eye_m, const Vec3& target_m, const Vec3& up) {
  const Vec3 back = (eye_m - target_m).normalized();
  Vec3 right = up.cross(back);
  if (right.norm() < 1e-6) right = back.unitOrthogonal();
  right.normalize();
  Eigen::Matrix4d view = Eigen::Matrix4d::Identity();
  view.block<1, 3>(0, 0) = right.transpose();
  view.block<1, 3>(1, 0) = back.cross(right).transpose();
  view.block<1, 3>(2, 0) = back.transpose();
  view.block<3, 1>(0, 3) = -view.block<3, 3>(0, 0) * eye_m;
  return view.cast<float>();
}

Mat4 perspective(const scene::Camera& camera, Size size) {
  const auto near_m = static_cast<float>(camera.near_m), far_m = static_cast<float>(camera.far_m);
  const auto scale = static_cast<float>(1 / std::tan(camera.vertical_fov_rad / 2));
  Mat4 clip = Mat4::Zero();
  clip(0, 0) = scale * static_cast<float>(size.height) / static_cast<float>(size.width);
  clip(1, 1) = scale;
  clip(2, 2) = (far_m + near_m) / (near_m - far_m);
  clip(2, 3) = 2 * far_m * near_m / (near_m - far_m);
  clip(3, 2) = -1;
  return clip;
}

Mat4 clip_of(const scene::Camera& camera, Size size) {
  return perspective(camera, size) * look_at(camera.eye_m, camera.target_m, camera.up);
}

/// Parallel light over a ball.
Mat4 sun_of(const Vec3& direction, const Stage::Ball& ball) {
  const Vec3 toward = direction.normalized();
  const Mat4 view = look_at(ball.centre_m - 2 * ball.radius_m * toward, ball.centre_m,
                            std::abs(toward.z()) > 0.99 ? Vec3::UnitX() : Vec3::UnitZ());
  const auto radius_m = static_cast<float>(ball.radius_m);
  Mat4 clip = Mat4::Identity();
  clip(0, 0) = clip(1, 1) = 1 / radius_m;
  clip(2, 2) = -1 / (2 * radius_m);
  clip(2, 3) = -1;
  return clip * view;
}

/// What a picture's passes have in common.
struct View {
  Vec3 eye_m = Vec3::Zero();
  Mat4 clip = Mat4::Identity(), sun = Mat4::Identity();
  int shadow_light = -1;  ///< of the scene's; -1: none
  double sun_radius_m = 1;
  Area shaded;  ///< of the floor: what the shadow map covers
};

/// What parallel light that passes the ball's box meets on the floor.
Area shaded_by(const Mat4& sun, const Vec3& direction, const Stage::Ball& ball) {
  Area area;
  const Vec3 toward = direction.normalized();
  if (toward.z() > -0.05) return {Vec2(-kFloor_m, -kFloor_m), Vec2(kFloor_m, kFloor_m)};
  for (const double x : {-1.0, 1.0}) {
    for (const double y : {-1.0, 1.0}) {
      const Vec3 across = sun.block<1, 3>(0, 0).transpose().cast<double>().normalized(),
                 up = sun.block<1, 3>(1, 0).transpose().cast<double>().normalized();
      const Vec3 corner = ball.centre_m + ball.radius_m * (x * across + y * up);
      area.extend((corner - corner.z() / toward.z() * toward).head<2>());
    }
  }
  return area;
}

scene::Snapshot at_goals(const scene::Scene& scene, const scene::Snapshot& now) {
  scene::Snapshot out;
  for (std::size_t r = 0; r < std::min(scene.robots.size(), now.robots.size()); ++r) {
    const scene::RobotView& robot = now.robots[r];
    const auto& entity = *scene.robots[r].entity;
    const bool known = robot.goal_rad.size() == entity.joints.size() && !robot.link_world.empty();
    out.robots.push_back(known ? scene::posed(entity, robot.link_world.front(), robot.goal_rad)
                               : scene::RobotView());
  }
  return out;
}

}  // namespace

struct Renderer::Impl {
  std::map<std::string, Program> lit;            ///< by their headers
  Program *plain = nullptr, *painted = nullptr;  ///< of the picture that is being drawn
  Program shade{kShadowVertex, kShadowFragment};
  Program backdrop{kSkyVertex, kSkyFragment};
  Program meter{kSolidVertex, kMeasureFragment};
  Program mark{kMarkVertex, kMarkFragment};
  GpuMesh floor{plane(1, 1)};
  VertexArray nothing = new_vertices(), mark_vertices = new_vertices();
  Buffer mark_buffer = new_buffer();
  Texture shadow = new_texture();
  int shadow_texels = 0;
  FrameBuffer shadow_frame = new_frame();
  Canvas canvas, resolved, measured;
  Stage stage;

  Impl() {
    make_shadow_map(kShadowTexels);
    glBindVertexArray(mark_vertices.id());
    glBindBuffer(GL_ARRAY_BUFFER, mark_buffer.id());
    const GLint sizes[] = {3, 3, 4};
    std::size_t offset = 0;
    for (GLuint i = 0; i < 3; ++i) {
      glEnableVertexAttribArray(i);
      glVertexAttribPointer(i, sizes[i], GL_FLOAT, GL_FALSE, sizeof(Marks::Vertex),
                            reinterpret_cast<const void*>(offset * sizeof(float)));
      offset += static_cast<std::size_t>(sizes[i]);
    }
  }

  void make_shadow_map(int texels) {
    if (texels == shadow_texels) return;
    shadow_texels = texels;
    glBindTexture(GL_TEXTURE_2D, shadow.id());
    glTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT24, texels, texels, 0, GL_DEPTH_COMPONENT,
                 GL_FLOAT, nullptr);
    for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER}) {
      glTexParameteri(GL_TEXTURE_2D, filter, GL_LINEAR);
    }
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    glBindFramebuffer(GL_FRAMEBUFFER, shadow_frame.id());
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, shadow.id(), 0);
    glDrawBuffer(GL_NONE);
    glReadBuffer(GL_NONE);
  }

  int shadow_light(const Effects& effects) const {
    const auto& lights = stage.scene().lights;
    for (std::size_t i = 0; effects.shadows && i < std::min<std::size_t>(lights.size(), 8); ++i) {
      if (lights[i].kind == scene::Light::Kind::kSun && lights[i].shadows)
        return static_cast<int>(i);
    }
    return -1;
  }

  void draw_shadows(const std::vector<Placed>& placed, const Mat4& sun) {
    glBindFramebuffer(GL_FRAMEBUFFER, shadow_frame.id());
    glViewport(0, 0, shadow_texels, shadow_texels);
    glClear(GL_DEPTH_BUFFER_BIT);
    shade.use();
    shade.set("sun_world", sun);
    for (const Placed& item : placed) {
      if (item.item->material.colour.a < 0.99F || item.item->collision) continue;
      shade.set("world_item", item.world);
      shade.set("scale", item.scale);
      item.mesh->draw();
    }
  }

  /// What the shader of a lit thing is compiled for.
  std::string lit_header(const View& view, const Effects& effects, bool of_floor, bool textured) {
    const scene::Scene& scene = stage.scene();
    const std::size_t count = std::min<std::size_t>(scene.lights.size(), kMostLights);
    std::string kinds;
    for (std::size_t i = 0; i < count; ++i) {
      kinds += (i == 0 ? "" : ",") + std::to_string(static_cast<int>(scene.lights[i].kind));
    }
    std::string header = "#version 330 core\n#define LIGHTS " + std::to_string(count) +
                         "\n#define SHADOW " + std::to_string(view.shadow_light) +
                         "\n#define TAPS " +
                         (effects.quick ? "4\n#define BIAS 3.0" : "12\n#define BIAS 1.0") +
                         "\nconst int kKind[" + std::to_string(std::max<std::size_t>(count, 1)) +
                         "] = int[](" + (count == 0 ? "0" : kinds) + ");\n";
    if (of_floor) header += "#define FLOOR\n";
    if (of_floor && effects.ground_grid) header += "#define TILED\n";
    if (textured) header += "#define TEXTURED\n";
    if (scene.fog.on && effects.fog) header += "#define FOG\n";
    return header;
  }

  Program& lit_program(const View& view, const Effects& effects, bool of_floor, bool textured) {
    const std::string header = lit_header(view, effects, of_floor, textured);
    auto found = lit.find(header);
    if (found == lit.end()) {
      found = lit.emplace(header, Program(kSolidVertex, kLitFragment, header.c_str())).first;
    }
    set_common(found->second, view);
    return found->second;
  }

  void set_lights(Program& program, double sun_radius_m) {
    const scene::Scene& scene = stage.scene();
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
    program.set("shadow_texel", 1.0F / static_cast<float>(shadow_texels));
    constexpr double kSoft_m = 0.011;
    program.set("shadow_soft", static_cast<float>(std::clamp(
                                   kSoft_m * shadow_texels / (2 * sun_radius_m), 1.2, 14.0)));
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, shadow.id());
  }

  /// All that a picture's things have in common.
  void set_common(Program& program, const View& view) {
    program.use();
    program.set("clip_world", view.clip);
    program.set("sun_world", view.sun);
    program.set("eye", Eigen::Vector3f(view.eye_m.cast<float>()));
    set_lights(program, view.sun_radius_m);
    set_air(program);
  }

  void set_air(Program& program) {
    const scene::Scene& scene = stage.scene();
    program.set("ambient", Eigen::Vector3f(linear(scene.ambient) * scene.ambient_strength));
    program.set("zenith", linear(scene.sky.zenith));
    program.set("horizon", linear(scene.sky.horizon));
    program.set("fog_colour", linear(scene.fog.colour));
    glUniform2f(program.at("fog_range"), static_cast<float>(scene.fog.begin_m),
                static_cast<float>(std::max(scene.fog.end_m, scene.fog.begin_m + 0.01)));
    program.set("floor_light", linear(scene.ground.light));
    program.set("floor_dark", linear(scene.ground.dark));
    program.set("floor_line", linear(scene.ground.line));
    program.set("floor_tile", static_cast<float>(scene.ground.tile_m));
    program.set("floor_fade", static_cast<float>(scene.ground.fade_m));
  }

  void draw_sky(const Mat4& clip, const Vec3& eye_m) {
    backdrop.use();
    backdrop.set("world_clip", Mat4(clip.inverse()));
    backdrop.set("eye", Eigen::Vector3f(eye_m.cast<float>()));
    backdrop.set("zenith", linear(stage.scene().sky.zenith));
    backdrop.set("horizon", linear(stage.scene().sky.horizon));
    glDisable(GL_CULL_FACE);
    glDepthMask(GL_FALSE);
    glBindVertexArray(nothing.id());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glDepthMask(GL_TRUE);
  }

  void draw_floor(const View& view, const Effects& effects) {
    if (!effects.ground || !stage.scene().ground.on) return;
    glDisable(GL_CULL_FACE);
    const Vec2 half(kFloor_m / 2, kFloor_m / 2), eye = view.eye_m.head<2>();
    const Area all{eye - half, eye + half};
    View unshaded = view;
    unshaded.shadow_light = -1;
    if (view.shadow_light < 0) return draw_floor_part(unshaded, effects, all);
    // Most of it lies outside of what the shadow map covers, and needs no look at it. The parts
    // overlap a little where neither has a shadow, so that no crack is between them.
    constexpr double kOverlap_m = 0.001;
    const Area in = view.shaded.intersection(all);
    if (in.isEmpty()) return draw_floor_part(unshaded, effects, all);
    const Vec2 low = in.min().array() + kOverlap_m, high = in.max().array() - kOverlap_m;
    draw_floor_part(view, effects, in);
    draw_floor_part(unshaded, effects, {all.min(), Vec2(low.x(), all.max().y())});
    draw_floor_part(unshaded, effects, {Vec2(high.x(), all.min().y()), all.max()});
    draw_floor_part(unshaded, effects, {Vec2(low.x(), all.min().y()), Vec2(high.x(), low.y())});
    draw_floor_part(unshaded, effects, {Vec2(low.x(), high.y()), Vec2(high.x(), all.max().y())});
  }

  void draw_floor_part(const View& view, const Effects& effects, const Area& part) {
    Program& ground = lit_program(view, effects, true, false);
    Mat4 at = Mat4::Identity();
    at.block<2, 1>(0, 3) = part.center().cast<float>();
    ground.set("world_item", at);
    ground.set("scale", Eigen::Vector3f(static_cast<float>(part.sizes().x()),
                                        static_cast<float>(part.sizes().y()), 1));
    floor.draw();
  }

  void draw_item(const Placed& placed, const Effects& effects, float opacity) {
    const scene::Material& material = placed.item->material;
    Eigen::Vector4f colour;
    colour << linear(material.colour), effects.transparency ? material.colour.a * opacity : 1.0F;
    const bool textured = effects.textures && placed.texture != 0;
    Program& solid = textured ? *painted : *plain;
    solid.use();
    solid.set("world_item", placed.world);
    solid.set("scale", placed.scale);
    solid.set("colour", colour);
    solid.set("glow", linear(material.glow));
    solid.set("roughness", material.roughness);
    solid.set("metallic", material.metallic);
    // Of a closed shape, the far side is never seen. Files' meshes may be open, or wind either way.
    const bool closed = placed.item->shape < scene::Shape::kPlane;
    (closed ? glEnable : glDisable)(GL_CULL_FACE);
    glActiveTexture(GL_TEXTURE1);
    glBindTexture(GL_TEXTURE_2D, textured ? placed.texture : 0);
    placed.mesh->draw();
  }

  bool is_clear(const Placed& placed, const Effects& effects, float opacity) const {
    return effects.transparency && placed.item->material.colour.a * opacity < 0.99F;
  }

  void draw_solid(const std::vector<Placed>& placed, const Effects& effects) {
    for (const Placed& item : placed) {
      if (!is_clear(item, effects, 1)) draw_item(item, effects, 1);
    }
  }

  /// What one sees through, the farthest first; behind everything that is solid.
  void draw_clear(const std::vector<Placed>& placed, const Effects& effects, const Vec3& eye_m,
                  float opacity) {
    std::vector<const Placed*> clear;
    for (const Placed& item : placed) {
      if (is_clear(item, effects, opacity)) clear.push_back(&item);
    }
    const Eigen::Vector3f eye = eye_m.cast<float>();
    std::stable_sort(clear.begin(), clear.end(), [&](const Placed* a, const Placed* b) {
      return (a->world.block<3, 1>(0, 3) - eye).norm() > (b->world.block<3, 1>(0, 3) - eye).norm();
    });
    glDepthMask(GL_FALSE);
    for (const Placed* item : clear) draw_item(*item, effects, opacity);
    glDepthMask(GL_TRUE);
  }

  void draw_marks(const Marks& marks, const Mat4& clip) {
    if (marks.vertices.empty()) return;
    glDisable(GL_CULL_FACE);
    mark.use();
    mark.set("clip_world", clip);
    glBindVertexArray(mark_vertices.id());
    glBindBuffer(GL_ARRAY_BUFFER, mark_buffer.id());
    glBufferData(GL_ARRAY_BUFFER,
                 static_cast<GLsizeiptr>(marks.vertices.size() * sizeof(Marks::Vertex)),
                 marks.vertices.data(), GL_STREAM_DRAW);
    const auto count = static_cast<GLsizei>(marks.vertices.size());
    glDepthMask(GL_FALSE);
    glDepthFunc(GL_GREATER);  // behind something: faint
    mark.set("opacity", 0.3F);
    glDrawArrays(GL_TRIANGLES, 0, count);
    glDepthMask(GL_TRUE);
    glDepthFunc(GL_LEQUAL);
    mark.set("opacity", 1.0F);
    glDrawArrays(GL_TRIANGLES, 0, count);
  }

  View view_of(const scene::Snapshot& now, const scene::Camera& camera, Size size,
               const Effects& effects) const {
    const Stage::Ball ball = stage.extent(now, camera);
    View view;
    view.eye_m = camera.eye_m;
    view.clip = clip_of(camera, size);
    view.sun_radius_m = ball.radius_m;
    view.shadow_light = shadow_light(effects);
    if (view.shadow_light >= 0) {
      const auto light = static_cast<std::size_t>(view.shadow_light);
      const Vec3& direction = stage.scene().lights[light].direction;
      view.sun = sun_of(direction, ball);
      view.shaded = shaded_by(view.sun, direction, ball);
    }
    return view;
  }

  /// Solid things first, then what they leave of the floor and the sky: a hidden pixel costs
  /// little.
  void draw_all(const scene::Snapshot& now, const scene::Camera& camera, Size size,
                const Effects& effects, GLuint target) {
    const std::vector<Placed> placed = stage.place(now, effects);
    const View view = view_of(now, camera, size, effects);
    begin_state();
    glDisable(GL_BLEND);
    make_shadow_map(effects.quick ? kQuickShadowTexels : kShadowTexels);
    if (view.shadow_light >= 0) draw_shadows(placed, view.sun);
    glBindFramebuffer(GL_FRAMEBUFFER, target);
    glViewport(0, 0, size.width, size.height);
    const Colour& back = stage.scene().sky.horizon;
    glClearColor(back.r, back.g, back.b, 1);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    plain = &lit_program(view, effects, false, false);
    const bool any_texture =
        effects.textures && std::any_of(placed.begin(), placed.end(),
                                        [](const Placed& item) { return item.texture != 0; });
    painted = any_texture ? &lit_program(view, effects, false, true) : plain;
    draw_solid(placed, effects);
    draw_floor(view, effects);
    if (effects.sky) draw_sky(view.clip, camera.eye_m);
    glEnable(GL_BLEND);
    draw_clear(placed, effects, camera.eye_m, 1);
    if (effects.goals) {
      draw_clear(stage.place(at_goals(stage.scene(), now), effects), effects, camera.eye_m, 0.35F);
    }
    draw_marks(marks_of(stage.scene(), now, effects), view.clip);
    glBindVertexArray(0);
  }

  static void begin_state() {
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LEQUAL);
    glDepthMask(GL_TRUE);
    glDisable(GL_CULL_FACE);
    glDisable(GL_SCISSOR_TEST);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glEnable(GL_BLEND);
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    glBlendEquation(GL_FUNC_ADD);
  }

  /// Into the canvas, antialiased if asked for.
  void draw_canvas(const scene::Snapshot& now, const scene::Camera& camera, Size size,
                   const Effects& effects) {
    const int samples = effects.antialias ? kSamples : 0;
    if (!canvas.fits(size.width, size.height, samples)) {
      canvas = Canvas(size.width, size.height, GL_RGBA8, samples);
    }
    draw_all(now, camera, size, effects, canvas.frame());
  }

  void copy_to(GLuint target, Size size) {
    glBindFramebuffer(GL_READ_FRAMEBUFFER, canvas.frame());
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, target);
    glBlitFramebuffer(0, 0, size.width, size.height, 0, 0, size.width, size.height,
                      GL_COLOR_BUFFER_BIT, GL_NEAREST);
    glBindFramebuffer(GL_FRAMEBUFFER, target);
  }

  /// RGBA floats: depth, label and item of each pixel, rows from the bottom.
  std::vector<float> measure(const scene::Snapshot& now, const scene::Camera& camera, Size size,
                             const Effects& effects, bool with_labels) {
    if (!measured.fits(size.width, size.height, 0)) {
      measured = Canvas(size.width, size.height, GL_RGBA32F, 0);
    }
    begin_state();
    glDisable(GL_BLEND);
    glBindFramebuffer(GL_FRAMEBUFFER, measured.frame());
    glViewport(0, 0, size.width, size.height);
    glClearColor(std::numeric_limits<float>::infinity(), 0, 0, 1);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    meter.use();
    meter.set("clip_world", clip_of(camera, size));
    meter.set("sun_world", Mat4(Mat4::Identity()));
    meter.set("eye", Eigen::Vector3f(camera.eye_m.cast<float>()));
    meter.set("ahead",
              Eigen::Vector3f((camera.target_m - camera.eye_m).normalized().cast<float>()));
    const auto one = [&](const Mat4& world, const Eigen::Vector3f& scale, int label,
                         const GpuMesh& mesh) {
      meter.set("world_item", world);
      meter.set("scale", scale);
      meter.set("label", static_cast<float>(label));
      mesh.draw();
    };
    if (effects.ground && stage.scene().ground.on) {
      Mat4 at = Mat4::Identity();
      at.block<2, 1>(0, 3) = camera.eye_m.head<2>().cast<float>();
      const auto edge_m = static_cast<float>(kFloor_m);
      one(at, {edge_m, edge_m, 1}, with_labels ? 0 : -1, floor);
    }
    for (const Placed& item : stage.place(now, effects)) {
      one(item.world, item.scale,
          with_labels ? scene::label_of(stage.scene(), *item.item) : item.index, *item.mesh);
    }
    std::vector<float> rgba(4 * static_cast<std::size_t>(size.width * size.height));
    glReadPixels(0, 0, size.width, size.height, GL_RGBA, GL_FLOAT, rgba.data());
    return rgba;
  }
};

Renderer::Renderer() {
  if (epoxy_gl_version() < 33) {
    throw RenderError(
        "this GL driver is older than OpenGL 3.3, which pictures need; Debian's "
        "software driver has it: apt-get install libgl1-mesa-dri");
  }
  impl_ = std::make_unique<Impl>();
}

Renderer::~Renderer() = default;

bool Renderer::on_processor() const {
  const auto* name = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  const std::string text = name == nullptr ? "" : name;
  return text.find("llvmpipe") != text.npos || text.find("softpipe") != text.npos ||
         text.find("SwiftShader") != text.npos;
}

void Renderer::set_scene(const scene::Scene& scene) {
  impl_->stage.fill(scene);
}

void Renderer::set_looks(const scene::Scene& scene) {
  impl_->stage.set_looks(scene);
}

const std::vector<std::string>& Renderer::notes() const {
  return impl_->stage.notes();
}

void Renderer::draw(const scene::Snapshot& now, const scene::Camera& camera, Size size,
                    const Effects& effects, unsigned framebuffer) {
  impl_->draw_canvas(now, camera, size, effects);
  impl_->copy_to(framebuffer, size);
}

Image Renderer::image(const scene::Snapshot& now, const scene::Camera& camera, Size size,
                      const Effects& effects) {
  impl_->draw_canvas(now, camera, size, effects);
  if (!impl_->resolved.fits(size.width, size.height, 0)) {
    impl_->resolved = Canvas(size.width, size.height, GL_RGBA8, 0);
  }
  impl_->copy_to(impl_->resolved.frame(), size);
  Image image{size, {}};
  const std::size_t row = 3 * static_cast<std::size_t>(size.width);
  image.rgb.resize(row * static_cast<std::size_t>(size.height));
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, size.width, size.height, GL_RGB, GL_UNSIGNED_BYTE, image.rgb.data());
  for (int top = 0, bottom = size.height - 1; top < bottom; ++top, --bottom) {
    const auto first = image.rgb.begin() + static_cast<std::ptrdiff_t>(row) * top;
    std::swap_ranges(first, first + static_cast<std::ptrdiff_t>(row),
                     image.rgb.begin() + static_cast<std::ptrdiff_t>(row) * bottom);
  }
  return image;
}

Measured Renderer::measure(const scene::Snapshot& now, const scene::Camera& camera, Size size,
                           const Effects& effects) {
  const std::vector<float> rgba = impl_->measure(now, camera, size, effects, true);
  Measured out{size, {}, {}};
  for (int y = size.height - 1; y >= 0; --y) {
    for (int x = 0; x < size.width; ++x) {
      const auto at = 4 * static_cast<std::size_t>(y * size.width + x);
      out.depth_m.push_back(rgba[at]);
      out.label.push_back(static_cast<std::uint16_t>(rgba[at + 1]));
    }
  }
  return out;
}

Renderer::Hit Renderer::pick(const scene::Snapshot& now, const scene::Camera& camera, Size size,
                             int x, int y, const Effects& effects) {
  if (x < 0 || y < 0 || x >= size.width || y >= size.height) return {};
  const std::vector<float> rgba = impl_->measure(now, camera, size, effects, false);
  const auto at = 4 * static_cast<std::size_t>((size.height - 1 - y) * size.width + x);
  const double depth_m = static_cast<double>(rgba[at]);
  if (!std::isfinite(depth_m)) return {};
  const Mat4 view = look_at(camera.eye_m, camera.target_m, camera.up);
  const double half = std::tan(camera.vertical_fov_rad / 2),
               aspect = 1.0 * size.width / size.height;
  const Vec3 ray((2 * (x + 0.5) / size.width - 1) * half * aspect,
                 (1 - 2 * (y + 0.5) / size.height) * half, -1);
  const Vec3 point_m =
      camera.eye_m + view.block<3, 3>(0, 0).cast<double>().transpose() * (depth_m * ray);
  return {static_cast<int>(rgba[at + 1]), point_m};
}

}  // namespace verp::render
