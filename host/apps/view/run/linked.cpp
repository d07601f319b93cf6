#include "host/apps/view/run/linked.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <cstring>
#include <vector>

#include "common/protocol/canopen/robot_plan.hpp"
#include "host/show/scene/plan_marks.hpp"
#include "host/trace/record/ros_messages.hpp"
#include "host/twin/bus/client.hpp"
#include "host/twin/bus/register_names.hpp"
#include "host/twin/can/client.hpp"
#include "host/twin/sim/body.hpp"

namespace verp::view {
namespace {

using namespace std::chrono_literals;
using Bytes = std::vector<std::uint8_t>;

constexpr std::uint32_t kTimeout_us = 50'000;
constexpr auto kPause = 25ms;       // as often as a picture is drawn
constexpr auto kLostPause = 500ms;  // between polls of a silent link
constexpr double kApart_m = 0.45;
constexpr double kTiltCount_rad = 1e-4;

template <class Number>
Number number_at(const Bytes& bytes, std::size_t offset = 0) {
  Number value{};
  std::memcpy(&value, bytes.data() + offset, sizeof value);  // little-endian
  return value;
}

const bus::NamedRegister& find(const char* name) {
  const bus::NamedRegister* found = bus::find_register(dxl::controller::kModel, name);
  if (found == nullptr) throw std::logic_error(std::string("no register ") + name);
  return *found;
}

}  // namespace

/// Reads a register's first `count` elements. Throws bus::DeviceError.
class Linked::Registers {
 public:
  virtual ~Registers() = default;
  virtual Bytes read(const char* name, unsigned count = 1) = 0;
};

class Linked::Serial final : public Registers {
 public:
  explicit Serial(const link::Endpoint& endpoint) : client_(endpoint, kTimeout_us) {}
  Bytes read(const char* name, unsigned count) override {
    const auto& found = find(name);
    return client_.read(dxl::controller::kDefaultId, found.address,
                        static_cast<std::uint16_t>(count * type_bytes(found.type)));
  }

 private:
  bus::Client client_;
};

class Linked::Can final : public Registers {
 public:
  explicit Can(const link::Endpoint& endpoint) : client_(endpoint, kTimeout_us) {}
  Bytes read(const char* name, unsigned count) override {
    const auto& found = find(name);
    Bytes all;
    for (unsigned i = 0; i < count; ++i) {
      const auto sub = static_cast<std::uint8_t>(found.count == 1 ? 0 : i + 1);
      Bytes one = client_.read(canopen::plan::kControllerNode, {found.object_index(), sub});
      one.resize(type_bytes(found.type));
      all.insert(all.end(), one.begin(), one.end());
    }
    return all;
  }

 private:
  can::Client client_;
};

Linked::Linked(const std::string& link, std::shared_ptr<const scene::Entity> entity,
               const Params& params)
    : entity_(std::move(entity)), params_(params) {
  const link::Endpoint endpoint = link::parse_endpoint(link);
  if (endpoint.kind == link::Endpoint::Kind::kCan) {
    registers_ = std::make_unique<Can>(endpoint);
  } else {
    registers_ = std::make_unique<Serial>(endpoint);
  }
  told_.trouble = link + ": not heard yet";
  thread_ = std::thread([this] { loop(); });
}

Linked::~Linked() {
  {
    const std::lock_guard lock(mutex_);
    quit_ = true;
  }
  woken_.notify_all();
  thread_.join();
}

Linked::Told Linked::told() const {
  const std::lock_guard lock(mutex_);
  return told_;
}

void Linked::loop() {
  std::unique_lock lock(mutex_);
  while (!quit_) {
    lock.unlock();
    std::string trouble;
    Told now;
    try {
      if (!known_) require_same_robot();
      now = look();
    } catch (const std::exception& error) {
      trouble = error.what();
      known_ = false;  // the next answer may come from another controller
    }
    lock.lock();
    if (trouble.empty()) {
      now.looks = told_.looks + 1;
      told_ = std::move(now);
    } else {
      told_.trouble = trouble;
      told_.lost = told_.looks > 0;
    }
    woken_.wait_for(lock, trouble.empty() ? kPause : kLostPause, [this] { return quit_; });
  }
}

void Linked::require_same_robot() {
  const auto joints = number_at<std::uint8_t>(registers_->read("joint_count"));
  known_ = joints == params_.joint_count;
  if (known_) return;
  throw std::runtime_error(
      fmt::format("the controller there has {} joints and {} has {}; name the "
                  "robot that it is of",
                  joints, params_.name, params_.joint_count));
}

Linked::Told Linked::look() {
  Told now;
  now.digest = number_at<std::uint64_t>(registers_->read("digest"));
  now.tick = number_at<std::uint32_t>(registers_->read("tick"));
  now.robot.faults = number_at<std::uint32_t>(registers_->read("faults"));
  now.robot.mode = number_at<std::uint8_t>(registers_->read("mode"));
  now.robot.phase = number_at<std::uint8_t>(registers_->read("gait_phase"));
  now.robot.gait_state = number_at<std::uint8_t>(registers_->read("gait_state"));
  now.robot.stance = number_at<std::uint8_t>(registers_->read("stance"));
  now.roll_rad = kTiltCount_rad * number_at<std::int16_t>(registers_->read("tilt_roll"));
  now.pitch_rad = kTiltCount_rad * number_at<std::int16_t>(registers_->read("tilt_pitch"));
  const Bytes angles = registers_->read("present_position", params_.joint_count),
              goals = registers_->read("goal_position", params_.joint_count);
  for (std::size_t j = 0; j < params_.joint_count; ++j) {
    const auto rad = [&](const Bytes& counts) {
      return record::ros::joint_rad(params_.joint[j], number_at<std::int32_t>(counts, 4 * j));
    };
    now.robot.joint_rad.push_back(rad(angles));
    now.robot.goal_rad.push_back(rad(goals));
  }
  return now;
}

scene::RobotView Linked::beside(const scene::RobotView& own) const {
  const Told now = told();
  scene::RobotView view = now.robot;
  if (view.joint_rad.empty() || own.link_world.empty()) return view;
  const scene::Transform& body = own.link_world.front();
  const double yaw_rad = std::atan2(body.linear()(1, 0), body.linear()(0, 0));
  const Eigen::AngleAxisd heading(yaw_rad, scene::Vec3::UnitZ());
  scene::Transform pose = scene::Transform::Identity();
  pose.translation() = body.translation() + heading * scene::Vec3(0, kApart_m, 0);
  pose.linear() = (heading * Eigen::AngleAxisd(now.pitch_rad, scene::Vec3::UnitY()) *
                   Eigen::AngleAxisd(now.roll_rad, scene::Vec3::UnitX()))
                      .toRotationMatrix();
  pose = sim::resting(*entity_, view.joint_rad, pose, 0);
  view.link_world = sim::link_poses(*entity_, pose, view.joint_rad);
  return view;
}

}  // namespace verp::view
