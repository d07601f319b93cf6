#include "host/apps/libverp/sight.hpp"

#include <filesystem>
#include <utility>

namespace verp::abi {
namespace {

std::vector<std::vector<model::Transform>> links_of_all(session::Session& session) {
  std::vector<std::vector<model::Transform>> all;
  for (std::size_t i = 0; i < session.size(); ++i)
    all.push_back(session.robot(i).twin().body().links_world());
  return all;
}

/// The drawing program reads it later, when the directory may have changed.
std::string wherever_we_are(const std::string& file) {
  return file.empty() ? "" : std::filesystem::absolute(file).string();
}

}  // namespace

Sight::Sight(const sim::WorldOptions& world) {
  if (world.scenery != nullptr) stage_.world_file = wherever_we_are(world.scenery->file);
}

void Sight::add(const session::WalkPlan& plan) {
  stage_.robots.push_back({wherever_we_are(plan.entity.file), plan.twin.seed});
  last_.emplace_back(plan.entity.cameras.size());
  painter_.reset();  // it knows earlier robots only
}

void Sight::looked(session::Session& session, std::uint32_t robot) {
  for (sim::Exposure& exposure : session.robot(robot).twin().take_exposures()) {
    auto moment = std::make_shared<camera::Moment>();
    moment->time_us = exposure.time_us;
    moment->link_world = std::move(exposure.link_world);
    moment->body_world = std::move(exposure.body_world);
    moment->robot = robot;
    moment->raw = true;
    for (const std::size_t camera : exposure.cameras) last_[robot][camera] = {moment, {}};
  }
}

camera::Painter& Sight::painter() {
  if (painter_ == nullptr || !painter_->works())
    painter_ = std::make_unique<camera::Painter>(camera::find_program(), stage_);
  return *painter_;
}

const camera::Picture* Sight::picture(std::uint32_t robot, std::uint32_t camera,
                                      const char* encoding) {
  Look& look = last_.at(robot).at(camera);
  if (look.at == nullptr) return nullptr;
  if (look.drawn.empty()) {
    camera::Moment moment = *look.at;
    moment.cameras = {camera};
    look.drawn = painter().look(moment);
  }
  for (const camera::Picture& picture : look.drawn) {
    if (picture.encoding == encoding) return &picture;
  }
  throw camera::CameraError("cameras: their program has drawn something else than was asked for");
}

camera::Picture Sight::render(session::Session& session, std::uint32_t robot,
                              const camera::Outside& from) {
  camera::Moment moment{.time_us = session.now_us(),
                        .cameras = {},
                        .link_world = links_of_all(session),
                        .body_world = {},
                        .robot = robot};
  if (session.scenery() != nullptr) moment.body_world = session.scenery()->moving_poses();
  return painter().look(moment, from);
}

}  // namespace verp::abi
