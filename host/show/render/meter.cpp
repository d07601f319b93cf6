#include "host/show/render/meter.hpp"

#include <limits>

#include "host/show/render/projection.hpp"

namespace verp::render {

void begin_pass() {
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

std::vector<float> Meter::measure(const Stage& stage, const scene::Snapshot& now,
                                  const scene::Camera& camera, Size size, const Effects& effects,
                                  Names names) {
  const bool labels = names == Names::kLabels;
  if (!measured_.fits(size.width, size.height, 0)) {
    measured_ = Canvas(size.width, size.height, GL_RGBA32F, 0);
  }
  begin_pass();
  glDisable(GL_BLEND);
  glBindFramebuffer(GL_FRAMEBUFFER, measured_.frame());
  glViewport(0, 0, size.width, size.height);
  glClearColor(std::numeric_limits<float>::infinity(), 0, 0, 1);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  meter_.use();
  meter_.set("clip_world", clip_of(camera, size));
  meter_.set("sun_world", Mat4(Mat4::Identity()));
  meter_.set("eye", Eigen::Vector3f(camera.eye_m.cast<float>()));
  meter_.set("ahead", Eigen::Vector3f((camera.target_m - camera.eye_m).normalized().cast<float>()));
  const auto one = [&](const Mat4& world, const Eigen::Vector3f& scale, int label,
                       const GpuMesh& mesh) {
    meter_.set("world_item", world);
    meter_.set("scale", scale);
    meter_.set("label", static_cast<float>(label));
    mesh.draw();
  };
  if (effects.ground && stage.scene().ground.on) {
    Mat4 at = Mat4::Identity();
    at.block<2, 1>(0, 3) = camera.eye_m.head<2>().cast<float>();
    const auto edge_m = static_cast<float>(kFloor_m);
    one(at, {edge_m, edge_m, 1}, labels ? 0 : -1, floor_);
  }
  for (const Placed& item : in_sight(stage.place(now, effects), camera, size)) {
    one(item.world, item.scale, labels ? scene::label_of(stage.scene(), *item.item) : item.index,
        *item.mesh);
  }
  std::vector<float> rgba(4 * static_cast<std::size_t>(size.width * size.height));
  glReadPixels(0, 0, size.width, size.height, GL_RGBA, GL_FLOAT, rgba.data());
  return rgba;
}

}  // namespace verp::render
