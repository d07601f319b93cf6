#include "host/show/render/renderer.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "host/show/render/lighting.hpp"
#include "host/show/render/marks.hpp"
#include "host/show/render/meter.hpp"
#include "host/show/render/projection.hpp"
#include "host/show/render/shaders.hpp"
#include "host/show/render/shapes.hpp"
#include "host/show/render/stage.hpp"
#include "host/show/scene/build.hpp"
#include "host/twin/sim/body.hpp"

namespace verp::render {

using scene::Colour;
using scene::Vec2;
using scene::Vec3;
using Area = Eigen::AlignedBox2d;

namespace {

constexpr int kSamples = 4;

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
  Lighting lighting;
  Program *plain = nullptr, *painted = nullptr;  ///< of the current picture
  Program backdrop{kSkyVertex, kSkyFragment};
  Meter meter;
  Program mark{kMarkVertex, kMarkFragment};
  GpuMesh floor{plane(1, 1)};
  VertexArray nothing = new_vertices(), mark_vertices = new_vertices();
  Buffer mark_buffer = new_buffer();
  Canvas canvas, resolved;
  Stage stage;

  Impl() {
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
    // Most of the floor is outside the shadow map; parts overlap without shadow, so no crack shows.
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
    Program& ground = lighting.program(stage.scene(), view, effects, true, false);
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
    // A closed shape hides its far side; meshes may be open or wind either way.
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

  /// Transparent items, farthest first, after all solid ones.
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
    glDepthFunc(GL_GREATER);  // marks behind something are faint
    mark.set("opacity", 0.3F);
    glDrawArrays(GL_TRIANGLES, 0, count);
    glDepthMask(GL_TRUE);
    glDepthFunc(GL_LEQUAL);
    mark.set("opacity", 1.0F);
    glDrawArrays(GL_TRIANGLES, 0, count);
  }

  /// A hidden pixel costs little: solid items first.
  void draw_all(const scene::Snapshot& now, const scene::Camera& camera, Size size,
                const Effects& effects, GLuint target) {
    const std::vector<Placed> placed = stage.place(now, effects);
    const View view =
        view_of(stage, now, camera, size, Lighting::shadow_light(stage.scene(), effects));
    begin_pass();
    glDisable(GL_BLEND);
    if (view.shadow_light >= 0) lighting.draw_shadows(placed, view.sun, effects);
    const std::vector<Placed> seen = in_sight(placed, camera, size);
    glBindFramebuffer(GL_FRAMEBUFFER, target);
    glViewport(0, 0, size.width, size.height);
    const Colour& back = stage.scene().sky.horizon;
    glClearColor(back.r, back.g, back.b, 1);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    plain = &lighting.program(stage.scene(), view, effects, false, false);
    const bool any_texture =
        effects.textures && std::any_of(placed.begin(), placed.end(),
                                        [](const Placed& item) { return item.texture != 0; });
    painted = any_texture ? &lighting.program(stage.scene(), view, effects, false, true) : plain;
    draw_solid(seen, effects);
    draw_floor(view, effects);
    if (effects.sky) draw_sky(view.clip, camera.eye_m);
    glEnable(GL_BLEND);
    draw_clear(seen, effects, camera.eye_m, 1);
    if (effects.goals) {
      draw_clear(stage.place(at_goals(stage.scene(), now), effects), effects, camera.eye_m, 0.35F);
    }
    draw_marks(marks_of(stage.scene(), now, effects), view.clip);
    glBindVertexArray(0);
  }

  /// The scene's file may switch effects off.
  void draw_canvas(const scene::Snapshot& now, const scene::Camera& camera, Size size,
                   Effects effects) {
    effects.antialias &= stage.scene().antialias;
    effects.textures &= stage.scene().textures;
    effects.transparency &= stage.scene().transparency;
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
  const std::vector<float> rgba =
      impl_->meter.measure(impl_->stage, now, camera, size, effects, Meter::Names::kLabels);
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
  const std::vector<float> rgba =
      impl_->meter.measure(impl_->stage, now, camera, size, effects, Meter::Names::kItems);
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
