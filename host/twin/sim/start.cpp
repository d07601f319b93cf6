#include "host/twin/sim/start.hpp"

#include <algorithm>
#include <numbers>
#include <stdexcept>

#include "host/robot/model/principal.hpp"
#include "host/robot/model/self_collision.hpp"
#include "host/twin/sim/coupling.hpp"

namespace verp::sim {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
/// Gap below the soles: contact begins in the first milliseconds, without penetration.
constexpr double kStartGap = 0.0002;
/// Spread of the initial pose, one sigma: a robot placed by hand.
constexpr double kJointSpread = 0.2 * kDegree;
constexpr double kLeanSpread = 0.2 * kDegree;
constexpr double kYawSpread = 0.5 * kDegree;

double uniform(Random& random, double low, double high) {
  return low + (high - low) * 0.5 * (1 + random.uniform(-1, 1));
}

/// Angles inside their limits at which no links intersect.
std::vector<double> any_angles(const model::Entity& entity, Random& random) {
  constexpr int kMostDraws = 1000;
  std::vector<double> angle_rad;
  for (int i = 0; i < kMostDraws; ++i) {
    angle_rad.clear();
    for (const model::Joint& joint : entity.joints)
      angle_rad.push_back(uniform(random, joint.lower_rad, joint.upper_rad));
    lead(entity, angle_rad);
    const auto meet = model::overlaps(entity, angle_rad);
    const bool free = std::all_of(meet.begin(), meet.end(), [&](const model::Overlap& each) {
      return std::any_of(entity.no_collide.begin(), entity.no_collide.end(),
                         [&](const model::NoCollide& pair) {
                           return pair.link == each.link && pair.other == each.other;
                         });
    });
    if (free) return angle_rad;
  }
  throw std::invalid_argument("no pose of '" + entity.name + "' was found in which no links meet");
}

Mat3 laid(Lies lies, Random& random) {
  constexpr double kQuarter = std::numbers::pi / 2;
  const auto turn = [](double angle_rad, const Vec3& axis) {
    return Eigen::AngleAxisd(angle_rad, axis).toRotationMatrix();
  };
  switch (lies) {
    case Lies::kNo:
      return Mat3::Identity();
    case Lies::kFront:
      return turn(kQuarter, Vec3::UnitY());
    case Lies::kBack:
      return turn(-kQuarter, Vec3::UnitY());
    case Lies::kLeft:
      return turn(-kQuarter, Vec3::UnitX());
    case Lies::kRight:
      return turn(kQuarter, Vec3::UnitX());
    case Lies::kAny:
      break;
  }
  Eigen::Quaterniond any(random.normal(), random.normal(), random.normal(), random.normal());
  return any.normalized().toRotationMatrix();
}

}  // namespace

Start make_start(const model::Entity& entity, const TwinOptions& options) {
  Start start{options.initial_rad, {}};
  if (start.joint_rad.empty()) {
    for (const model::Joint& joint : entity.joints) start.joint_rad.push_back(joint.stand_rad);
  }
  if (start.joint_rad.size() != entity.joints.size()) {
    throw std::invalid_argument("a start in " + std::to_string(start.joint_rad.size()) +
                                " joint angles: " + entity.name + " has " +
                                std::to_string(entity.joints.size()) + " joints");
  }
  Random lying(options.seed, Draw::kLyingPose);
  if (options.lies == Lies::kAny) start.joint_rad = any_angles(entity, lying);
  lead(entity, start.joint_rad);
  start.body_world = standing_pose(entity, start.joint_rad, options.start_m, options.start_yaw_rad,
                                   kStartGap + options.start_m.z());
  if (options.lies != Lies::kNo) {
    start.body_world.linear() *= laid(options.lies, lying);
    start.body_world =
        resting(entity, start.joint_rad, start.body_world, kStartGap + options.start_m.z());
  }
  if (!options.imperfections.initial_pose) return start;
  Random random(options.seed, Draw::kInitialPose);
  const double roll = kLeanSpread * random.normal();
  const double pitch = kLeanSpread * random.normal();
  const double yaw = kYawSpread * random.normal();
  for (double& angle : start.joint_rad) angle += kJointSpread * random.normal();
  lead(entity, start.joint_rad);
  start.body_world.linear() = model::rotation_rpy({roll, pitch, yaw}) * start.body_world.linear();
  start.body_world =
      resting(entity, start.joint_rad, start.body_world, kStartGap + options.start_m.z());
  return start;
}

}  // namespace verp::sim
