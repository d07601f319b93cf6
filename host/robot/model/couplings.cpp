#include "host/robot/model/couplings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/robot/model/find.hpp"
#include "host/robot/model/leg.hpp"

namespace verp::model {
namespace {

constexpr double kLeastRatio = 0.01, kMostRatio = 100;  // beyond one stage

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::string mimics(const MimicFact& mimic) {
  return "joint '" + mimic.joint + "' mimics '" + mimic.driver + "'";
}

const char* const kOtherWays =
    "if it doesn't matter to walking, <verp:fix>; if it has a servo of its own, <verp:drop "
    "what=\"mimic\">";

const Joint& driver_of(const Entity& entity, const Joint& follower) {
  return entity.joints[static_cast<std::size_t>(follower.follows)];
}

/// Place in the leg, 0 at the hip; -1: not in the leg.
int place_in_leg(const Entity& entity, const char* name, int joint) {
  const Limb* const leg = find_limb(entity, name);
  if (leg == nullptr) return -1;
  const auto found = std::find(leg->joints.begin(), leg->joints.end(), joint);
  return found == leg->joints.end() ? -1 : static_cast<int>(found - leg->joints.begin());
}

/// Intersects both limits in the driver's angle and applies the result to both joints.
void join_limits(const MimicFact& mimic, Joint& driver, Joint& follower) {
  double low = (follower.lower_rad - follower.offset_rad) / follower.ratio;
  double high = (follower.upper_rad - follower.offset_rad) / follower.ratio;
  if (low > high) std::swap(low, high);
  const double lower = std::max(driver.lower_rad, low), upper = std::min(driver.upper_rad, high);
  if (!(lower < upper)) {
    mimic.at.fail(fmt::format("{}, and their limits leave it no way: {:.4g} to {:.4g} rad of '{}' "
                              "would be {:.4g} to {:.4g} of '{}'",
                              mimics(mimic), follower.lower_rad, follower.upper_rad, mimic.joint,
                              low, high, mimic.driver),
                  "correct the limits, multiplier or offset");
  }
  driver.lower_rad = lower;
  driver.upper_rad = upper;
  follower.lower_rad = follower.ratio * lower + follower.offset_rad;
  follower.upper_rad = follower.ratio * upper + follower.offset_rad;
  if (follower.ratio < 0) std::swap(follower.lower_rad, follower.upper_rad);
}

const PoseFact* pose_of(const Facts& facts, const std::string& pose, const std::string& joint) {
  const auto found =
      std::find_if(facts.poses.begin(), facts.poses.end(),
                   [&](const PoseFact& fact) { return fact.pose == pose && fact.joint == joint; });
  return found == facts.poses.end() ? nullptr : &*found;
}

}  // namespace

std::vector<MimicFact> urdf_mimics(const XmlElement& robot, const Facts& facts) {
  std::vector<MimicFact> found;
  for (const XmlElement& joint : robot.children("joint")) {
    const std::string name = joint.text("name");
    if (facts.fix_of(name) != nullptr || facts.is_dropped("mimic", name)) continue;
    for (const XmlElement& at : joint.children("mimic")) {
      found.push_back(
          {at, name, at.text("joint"), at.number("multiplier", 1), at.number("offset", 0)});
    }
  }
  return found;
}

void check_mimics(const Facts& facts, const std::vector<std::string>& turning,
                  const std::vector<std::string>& fixed) {
  for (const MimicFact& mimic : facts.mimics) {
    const auto wrong = [&](const std::string& why, const std::string& fix) {
      mimic.at.fail(mimics(mimic) + why, fix);
    };
    if (!contains(turning, mimic.joint)) {
      wrong(", and there is no turning joint '" + mimic.joint + "'", "name one that turns");
    }
    if (mimic.driver == mimic.joint) wrong(", itself", "name the joint that has the motor");
    if (contains(fixed, mimic.driver)) {
      wrong(", which doesn't turn", "fix '" + mimic.joint + "' too, or name one that turns");
    }
    if (!contains(turning, mimic.driver)) {
      wrong(", which there is not", "name the joint that has the motor");
    }
    const double size = std::abs(mimic.multiplier);
    if (!(size >= kLeastRatio && size <= kMostRatio)) {
      wrong(fmt::format(" {} times", mimic.multiplier), "choose 0.01 to 100, or below zero");
    }
    if (!(std::abs(mimic.offset_rad) <= 7)) {
      wrong(fmt::format(" and {} rad beside", mimic.offset_rad), "choose -7 to 7 rad");
    }
    for (const MimicFact& other : facts.mimics) {
      if (other.joint == mimic.driver) {
        wrong(", which mimics '" + other.driver + "'",
              "mimic '" + other.driver + "' itself, by the product of the ratios");
      }
      if (&other < &mimic && other.joint == mimic.joint) {
        wrong(" and '" + other.driver + "'", "keep one of them");
      }
    }
  }
}

void join_followers(const Facts& facts, Entity& entity) {
  for (const MimicFact& mimic : facts.mimics) {
    for (Joint& joint : entity.joints) {
      if (joint.follows < 0 || joint.name != mimic.joint) continue;
      Joint& driver = entity.joints[static_cast<std::size_t>(joint.follows)];
      joint.servo = driver.servo;
      join_limits(mimic, driver, joint);
      driver.velocity_limit_rad_s =
          std::min(driver.velocity_limit_rad_s, joint.velocity_limit_rad_s / std::abs(joint.ratio));
    }
  }
  for (Joint& joint : entity.joints) {
    if (joint.follows < 0) continue;
    // A later follower may have narrowed the limits.
    const Joint& driver = driver_of(entity, joint);
    joint.velocity_limit_rad_s = std::abs(joint.ratio) * driver.velocity_limit_rad_s;
    joint.lower_rad = joint.ratio * driver.lower_rad + joint.offset_rad;
    joint.upper_rad = joint.ratio * driver.upper_rad + joint.offset_rad;
    if (joint.ratio < 0) std::swap(joint.lower_rad, joint.upper_rad);
  }
}

void check_coupled_legs(const Facts& facts, const Entity& entity) {
  for (const MimicFact& mimic : facts.mimics) {
    for (std::size_t j = 0; j < entity.joints.size(); ++j) {
      const Joint& joint = entity.joints[j];
      if (joint.follows < 0 || joint.name != mimic.joint) continue;
      const int left = place_in_leg(entity, "left_leg", static_cast<int>(j));
      const int right = place_in_leg(entity, "right_leg", static_cast<int>(j));
      if (left < 0 && right < 0) continue;
      const int other = place_in_leg(entity, left == 0 ? "right_leg" : "left_leg", joint.follows);
      if (std::max(left, right) != 0 || other != 0) {
        mimic.at.fail(mimics(mimic) +
                          ": a leg's joints need a motor each, but for the first ones of both legs",
                      kOtherWays);
      }
      // In a turn the feet turn opposite ways.
      const double own = joint.axis.z(), driver = driver_of(entity, joint).axis.z();
      if (std::min(std::abs(own), std::abs(driver)) < 0.3 || joint.ratio * own * driver >= 0) {
        mimic.at.fail(
            mimics(mimic) + ": hips that share a motor have to turn the feet opposite ways",
            "correct the axes or the multiplier");
      }
      if (std::abs(joint.offset_rad) > 0.1) {
        mimic.at.fail(mimics(mimic) + fmt::format(" and {:.3g} rad beside: both feet cannot point "
                                                  "ahead",
                                                  joint.offset_rad),
                      "write 0.1 rad or less");
      }
    }
  }
}

void pose_followers(const Facts& facts, Entity& entity) {
  constexpr double kSame_rad = 2e-3;
  for (Joint& joint : entity.joints) {
    if (joint.follows < 0) continue;
    const Joint& driver = driver_of(entity, joint);
    const auto put = [&](const char* pose, double driver_rad, double& own_rad) {
      const double rad = joint.ratio * driver_rad + joint.offset_rad;
      const PoseFact* const fact = pose_of(facts, pose, joint.name);
      if (fact != nullptr && std::abs(fact->rad - rad) > kSame_rad) {
        fact->at.fail(fmt::format("pose '{}' puts '{}' at {:.4g} rad, and '{}' takes it to {:.4g}",
                                  pose, joint.name, fact->rad, driver.name, rad),
                      "leave it out: it follows");
      }
      own_rad = rad;
    };
    put("stand", driver.stand_rad, joint.stand_rad);
    put("sit", driver.sit_rad, joint.sit_rad);
  }
}

std::vector<std::string> describe_couplings(const Entity& entity) {
  std::vector<std::string> lines;
  for (const Joint& joint : entity.joints) {
    if (joint.follows < 0) continue;
    std::string line = fmt::format("{} follows {}, whose servo turns both: {:g} times its angle",
                                   joint.name, driver_of(entity, joint).name, joint.ratio);
    if (joint.offset_rad != 0) line += fmt::format(" and {:g} rad", joint.offset_rad);
    lines.push_back(line);
  }
  return lines;
}

}  // namespace verp::model
