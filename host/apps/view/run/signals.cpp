#include "host/apps/view/run/signals.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

namespace verp::view {
namespace {

constexpr float kNothing = std::numeric_limits<float>::quiet_NaN();
constexpr double kDegrees = 180 / 3.14159265358979323846;

/// Values in the order of signals_of().
class Row {
 public:
  void add(double value) { values_.push_back(static_cast<float>(value)); }
  void nothing(int count) {
    values_.insert(values_.end(), static_cast<std::size_t>(count), kNothing);
  }
  std::vector<float> take() { return std::move(values_); }

 private:
  std::vector<float> values_;
};

void add_body(Row& row, const scene::RobotView& robot) {
  if (robot.link_world.empty()) return row.nothing(6);
  const scene::Transform& body = robot.link_world.front();
  for (int axis = 0; axis < 3; ++axis) row.add(body.translation()[axis]);
  const scene::Mat3 r = body.linear();
  row.add(kDegrees * std::atan2(r(2, 1), r(2, 2)));
  row.add(kDegrees * std::asin(std::clamp(-r(2, 0), -1.0, 1.0)));
  row.add(kDegrees * std::atan2(r(1, 0), r(0, 0)));
}

void add_point(Row& row, const std::optional<scene::Vec2>& point) {
  if (!point) return row.nothing(2);
  row.add(point->x());
  row.add(point->y());
}

/// The robot at the link, and its difference to ours.
void add_beside(Row& row, const scene::RobotView& robot, const scene::RobotView& beside,
                std::size_t joints) {
  for (std::size_t j = 0; j < joints; ++j) {
    const bool known = j < beside.joint_rad.size() && j < robot.joint_rad.size();
    j < beside.goal_rad.size() ? row.add(kDegrees * beside.goal_rad[j]) : row.nothing(1);
    known ? row.add(kDegrees * beside.joint_rad[j]) : row.nothing(1);
    known ? row.add(kDegrees * (beside.joint_rad[j] - robot.joint_rad[j])) : row.nothing(1);
  }
}

}  // namespace

std::vector<Signal> signals_of(const scene::Entity& entity, bool beside) {
  std::vector<Signal> all = {{"Body", "x", "m"},
                             {"Body", "y", "m"},
                             {"Body", "z", "m"},
                             {"Body", "roll", "deg"},
                             {"Body", "pitch", "deg"},
                             {"Body", "yaw", "deg"},
                             {"Centre of mass", "x", "m"},
                             {"Centre of mass", "y", "m"},
                             {"Centre of mass", "z", "m"},
                             {"ZMP", "x", "m"},
                             {"ZMP", "y", "m"},
                             {"ZMP", "planned x", "m"},
                             {"ZMP", "planned y", "m"},
                             {"Feet", "left force", "N"},
                             {"Feet", "right force", "N"},
                             {"IMU", "gyro x", "rad/s"},
                             {"IMU", "gyro y", "rad/s"},
                             {"IMU", "gyro z", "rad/s"},
                             {"IMU", "accel x", "m/s²"},
                             {"IMU", "accel y", "m/s²"},
                             {"IMU", "accel z", "m/s²"},
                             {"Controller", "mode", ""},
                             {"Controller", "phase", ""},
                             {"Controller", "state", ""},
                             {"Controller", "faults", "count"}};
  for (const model::Joint& joint : entity.joints) {
    const std::string group = "Joints/" + joint.name;
    all.push_back({group, "goal", "deg"});
    all.push_back({group, "angle", "deg"});
    all.push_back({group, "error", "deg"});
    all.push_back({group, "load", "%"});
  }
  for (const model::Joint& joint : entity.joints) {
    if (!beside) break;
    const std::string group = "Linked joints/" + joint.name;
    all.push_back({group, "goal", "deg"});
    all.push_back({group, "angle", "deg"});
    all.push_back({group, "difference", "deg"});
  }
  return all;
}

std::vector<float> values_of(const scene::RobotView& robot, const scene::Entity& entity,
                             const scene::RobotView* beside) {
  Row row;
  add_body(row, robot);
  if (robot.com_world_m) {
    for (int axis = 0; axis < 3; ++axis) row.add((*robot.com_world_m)[axis]);
  } else {
    row.nothing(3);
  }
  add_point(row, robot.zmp_world_m);
  add_point(row, robot.zmp_planned_world_m);
  for (const double force_n : robot.foot_force_n) row.add(force_n);
  for (const double rate : robot.gyro_rad_s) row.add(rate);
  for (const double accel : robot.accel_m_s2) row.add(accel);
  row.add(robot.mode);
  row.add(robot.phase);
  row.add(robot.gait_state);
  row.add(std::popcount(robot.faults));
  for (std::size_t j = 0; j < entity.joints.size(); ++j) {
    const bool both = j < robot.goal_rad.size() && j < robot.joint_rad.size();
    j < robot.goal_rad.size() ? row.add(kDegrees * robot.goal_rad[j]) : row.nothing(1);
    j < robot.joint_rad.size() ? row.add(kDegrees * robot.joint_rad[j]) : row.nothing(1);
    both ? row.add(kDegrees * (robot.joint_rad[j] - robot.goal_rad[j])) : row.nothing(1);
    j < robot.torque_use.size() ? row.add(100 * robot.torque_use[j]) : row.nothing(1);
  }
  if (beside != nullptr) add_beside(row, robot, *beside, entity.joints.size());
  return row.take();
}

int signal_number(const std::vector<Signal>& all, const std::string& label) {
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].label() == label) return static_cast<int>(i);
  }
  return -1;
}

}  // namespace verp::view
