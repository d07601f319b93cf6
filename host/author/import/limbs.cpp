#include "host/author/import/limbs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace verp::import {
namespace {

constexpr std::size_t kLeastJoints = 4;  // of a leg
constexpr double kOneHeight_m = 0.01;
constexpr double kLeastApart_m = 0.005;  // of two feet
constexpr std::ptrdiff_t kLeastArm = 2;  // joints
constexpr double kFourFeet = 0.1;        // of the hip's height: hands hang higher

class Finder {
 public:
  Finder(const Skeleton& skeleton, const model::XmlElement& at) : s_(skeleton), at_(at) {}

  Body find() {
    find_tips();
    const int foot = lowest();
    const int other = mirror_of(foot);
    part(foot, other);
    find_forward(foot, other);
    name_legs(foot, other);
    find_others();
    return std::move(body_);
  }

 private:
  const LinkPart& link(int index) const { return s_.links[static_cast<std::size_t>(index)]; }
  const Bone& bone(int index) const { return s_.bones[static_cast<std::size_t>(index)]; }

  /// Links that a turning joint moves, with no turning joint beyond.
  void find_tips() {
    for (std::size_t i = 0; i < s_.bones.size(); ++i) {
      if (s_.bones[i].kind != Bone::Kind::kTurns) continue;
      const auto below = s_.hanging_on(s_.bones[i].child);
      const bool last = std::none_of(s_.bones.begin(), s_.bones.end(), [&](const Bone& each) {
        return each.kind == Bone::Kind::kTurns &&
               std::find(below.begin(), below.end(), each.parent) != below.end();
      });
      if (last) tips_.push_back(s_.bones[i].child);
    }
  }

  bool could_be_foot(int tip) const { return s_.turning_to(tip).size() >= kLeastJoints; }

  /// Takes the link with mass where two are at one height: some legs have rods that are only drawn.
  int lowest() const {
    int foot = -1;
    for (const int tip : tips_) {
      if (!could_be_foot(tip)) continue;
      const bool beside = foot >= 0 && std::abs(height(tip) - height(foot)) < kOneHeight_m;
      const bool is_better = beside && has_mass(tip) != has_mass(foot)
                                 ? has_mass(tip)
                                 : foot < 0 || height(tip) < height(foot);
      if (is_better) foot = tip;
    }
    if (foot >= 0) return foot;
    at_.fail("no leg is found: no chain of four or more turning joints",
             "legs need four joints or more; VERP walks on two legs of four to six");
  }

  bool has_mass(int tip) const {
    const std::vector<int> below = s_.hanging_on(tip);
    return std::any_of(below.begin(), below.end(),
                       [&](int each) { return link(each).mass_kg > 0; });
  }

  double height(int tip) const { return link(tip).pose.translation().z(); }

  /// Distance along the lateral axis apart, two feet are at one place. Axes are tried, because the
  /// root's origin need not be in the sagittal plane.
  double unlikeness(int foot, int other) const {
    const Vec3 apart = link(other).pose.translation() - link(foot).pose.translation();
    double least = std::numeric_limits<double>::infinity();
    for (const Vec3& axis : {Vec3(Vec3::UnitX()), Vec3(Vec3::UnitY())}) {
      const double along = apart.dot(axis);
      if (std::abs(along) < kLeastApart_m) continue;
      least = std::min(least, (apart - along * axis).norm());
    }
    const auto joints = [&](int tip) { return static_cast<double>(s_.turning_to(tip).size()); };
    return least + 0.02 * std::abs(joints(foot) - joints(other));
  }

  int mirror_of(int foot) const {
    int best = -1;
    for (const int tip : tips_) {
      if (tip == foot || !could_be_foot(tip)) continue;
      if (best < 0 || unlikeness(foot, tip) < unlikeness(foot, best)) best = tip;
    }
    if (best >= 0 && unlikeness(foot, best) < 0.3) return best;
    at_.fail("only one leg is found: no other limb mirrors '" + link(foot).name + "'",
             "the two feet must be at one height, side by side, in the zero pose");
  }

  /// The trunk: the last link on both ways.
  void part(int foot, int other) {
    const std::vector<int> above = way_to(foot), beside = way_to(other);
    std::size_t same = 0;
    while (same < above.size() && same < beside.size() && above[same] == beside[same]) ++same;
    body_.trunk = above[same - 1];
  }

  std::vector<int> way_to(int tip) const {
    std::vector<int> way;
    for (int at = tip;; at = bone(link(at).above).parent) {
      way.insert(way.begin(), at);
      if (link(at).above < 0) return way;
    }
  }

  /// Turning bones that the trunk does not hang on: those above it are fixed later.
  std::vector<int> bones_between(int tip) const {
    std::vector<int> all = s_.turning_to(tip);
    const auto trunk = s_.turning_to(body_.trunk);
    std::erase_if(
        all, [&](int each) { return std::find(trunk.begin(), trunk.end(), each) != trunk.end(); });
    return all;
  }

  void find_forward(int foot, int other) {
    Vec3 apart = link(other).pose.translation() - link(foot).pose.translation();
    apart.z() = 0;
    Vec3 ahead = snapped(apart.normalized().cross(Vec3::UnitZ()));
    const double knees = bend_back(foot, ahead) + bend_back(other, ahead);
    if (std::abs(knees) > 0.2) {
      if (knees < 0) ahead = -ahead;
      body_.sure_of_forward = true;
      body_.reasons.push_back("its knees bend so");
    } else {
      if (ahead.x() < -1e-6 || (std::abs(ahead.x()) <= 1e-6 && ahead.y() > 0)) ahead = -ahead;
      body_.reasons.push_back("x is ahead by custom (REP 103)");
    }
    body_.forward = ahead + Vec3::Zero();  // no negative zeros
    body_.left = Vec3::UnitZ().cross(ahead);
  }

  static Vec3 snapped(const Vec3& direction) {
    for (const Vec3& axis : {Vec3(Vec3::UnitX()), Vec3(Vec3::UnitY())}) {
      if (std::abs(direction.dot(axis)) > 0.999)
        return direction.dot(axis) > 0 ? axis : Vec3(-axis);
    }
    return direction;
  }

  /// Positive: the middle of the knee's range brings the shank back, seen along `ahead`.
  double bend_back(int foot, const Vec3& ahead) const {
    const Vec3 across = Vec3::UnitZ().cross(ahead);
    double most = 0, bend = 0;
    for (const int each : bones_between(foot)) {
      const Bone& knee = bone(each);
      if (std::abs(knee.axis.dot(across)) < 0.9 || knee.lower_rad > knee.upper_rad) continue;
      const Vec3 shank = link(foot).pose.translation() - knee.pose.translation();
      const double middle = (knee.lower_rad + knee.upper_rad) / 2;
      if (shank.norm() < 0.02 || std::abs(middle) <= most) continue;
      most = std::abs(middle);
      bend = -middle * knee.axis.cross(shank).normalized().dot(ahead);
    }
    return bend;
  }

  void name_legs(int foot, int other) {
    const auto sideways = [&](int tip) { return link(tip).pose.translation().dot(body_.left); };
    const bool first_is_left = sideways(foot) > sideways(other);
    for (const auto& [name, tip] : {std::pair{"left_leg", first_is_left ? foot : other},
                                    {"right_leg", first_is_left ? other : foot}}) {
      body_.legs.push_back({name, tip, bones_between(tip)});
    }
  }

  /// Beside the trunk the longest chains are arms; in its middle, the highest is a head.
  void find_others() {
    std::vector<FoundLimb> chains;
    for (const int tip : tips_) {
      FoundLimb limb{"", tip, bones_between(tip)};
      if (!limb.bones.empty() && !shares_leg(limb)) chains.push_back(limb);
    }
    cut_waist(chains);
    std::vector<FoundLimb> left, right, middle;
    for (const FoundLimb& limb : chains) {
      if (limb.bones.empty()) continue;
      // A neck's first joint may be a servo beside the middle: its tip is not.
      const double y =
          std::min(sideways(bone(limb.bones.front()).pose), sideways(link(limb.tip).pose),
                   [](double a, double b) { return std::abs(a) < std::abs(b); });
      (y > kLeastApart_m ? left : y < -kLeastApart_m ? right : middle).push_back(limb);
    }
    if (const int third = at_the_floor(left); third >= 0 && at_the_floor(right) >= 0) {
      at_.fail("it stands on four feet: '" + link(third).name + "' reaches the floor, too",
               "VERP walks on two legs");
    }
    const auto shorter = [](const FoundLimb& a, const FoundLimb& b) {
      return a.bones.size() < b.bones.size();
    };
    const auto lower = [&](const FoundLimb& a, const FoundLimb& b) {
      return height(a.tip) < height(b.tip);
    };
    add("left_arm", std::max_element(left.begin(), left.end(), shorter), left);
    add("right_arm", std::max_element(right.begin(), right.end(), shorter), right);
    add("head", std::max_element(middle.begin(), middle.end(), lower), middle);
  }

  /// Tip of a limb that is as low as the feet; -1: there is none.
  int at_the_floor(const std::vector<FoundLimb>& limbs) const {
    const FoundLimb& leg = body_.legs.front();
    const double hip_m = bone(leg.bones.front()).pose.translation().z() - height(leg.tip);
    for (const FoundLimb& limb : limbs) {
      const bool is_low = height(limb.tip) - height(leg.tip) < kFourFeet * hip_m;
      if (is_low && limb.bones.size() >= 2 && has_mass(limb.tip)) return limb.tip;
    }
    return -1;
  }

  /// Joints that carry both arms are the waist, a limb of its own, and the chains begin above it.
  /// A neck with antennas carries no arms: it is a head.
  void cut_waist(std::vector<FoundLimb>& chains) {
    FoundLimb waist{"waist", -1, {}};
    for (const FoundLimb& limb : chains) {
      for (const int each : limb.bones) {
        if (!contains(waist.bones, each) && carries_both(chains, each, kLeastArm))
          waist.bones.push_back(each);
      }
    }
    if (waist.bones.empty()) return;
    waist.tip = bone(waist.bones.back()).child;
    for (FoundLimb& limb : chains)
      std::erase_if(limb.bones, [&](int each) { return contains(waist.bones, each); });
    body_.others.push_back(waist);
  }

  /// Chains to the left and to the right with at least `own` joints that carry one side only.
  bool carries_both(const std::vector<FoundLimb>& chains, int carrier, std::ptrdiff_t own) const {
    bool left = false, right = false;
    for (const FoundLimb& limb : chains) {
      if (!contains(limb.bones, carrier)) continue;
      const auto carries_one = [&](int each) { return !carries_both(chains, each, 0); };
      if (own > 0 && std::count_if(limb.bones.begin(), limb.bones.end(), carries_one) < own)
        continue;
      const double y = sideways(link(limb.tip).pose);
      left = left || y > kLeastApart_m;
      right = right || y < -kLeastApart_m;
    }
    return left && right;
  }

  static bool contains(const std::vector<int>& bones, int each) {
    return std::find(bones.begin(), bones.end(), each) != bones.end();
  }

  /// From the sagittal plane to the left.
  double sideways(const Transform& pose) const {
    return pose.translation().dot(body_.left) - middle_y();
  }

  bool shares_leg(const FoundLimb& limb) const {
    return std::any_of(body_.legs.begin(), body_.legs.end(), [&](const FoundLimb& leg) {
      return !leg.bones.empty() && leg.bones.front() == limb.bones.front();
    });
  }

  double middle_y() const {
    double sum = 0;
    for (const FoundLimb& leg : body_.legs) sum += link(leg.tip).pose.translation().dot(body_.left);
    return sum / 2;
  }

  void add(const char* name, std::vector<FoundLimb>::iterator limb, std::vector<FoundLimb>& of) {
    if (limb == of.end()) return;
    limb->name = name;
    body_.others.push_back(*limb);
  }

  const Skeleton& s_;
  const model::XmlElement& at_;
  std::vector<int> tips_;
  Body body_;
};

}  // namespace

void Body::turn_round() {
  forward = Vec3::Zero() - forward;  // no negative zeros
  left = Vec3::Zero() - left;
  for (auto* limbs : {&legs, &others}) {
    for (FoundLimb& limb : *limbs) {
      if (limb.name.starts_with("left_")) {
        limb.name.replace(0, 5, "right_");
      } else if (limb.name.starts_with("right_")) {
        limb.name.replace(0, 6, "left_");
      }
    }
  }
  std::swap(legs[0], legs[1]);
}

LegJoints joints_of_leg(const Skeleton& skeleton, const Body& body, const FoundLimb& leg) {
  constexpr double kMostly = 0.7;
  const auto along = [&](int bone, const Vec3& axis) {
    return std::abs(skeleton.bones[static_cast<std::size_t>(bone)].axis.dot(axis)) > kMostly;
  };
  LegJoints joints{true, true, leg.bones.size() == 6};
  if (joints.complete) return joints;
  joints.yaws = std::any_of(leg.bones.begin(), leg.bones.end(),
                            [&](int each) { return along(each, Vec3::UnitZ()); });
  joints.rolls = along(leg.bones.back(), body.forward);
  const std::size_t count = 4U + (joints.yaws ? 1 : 0) + (joints.rolls ? 1 : 0);
  joints.complete = leg.bones.size() == count && count < 6;
  joints.hip_pitch = joints.yaws ? 2 : 1;
  return joints;
}

Body find_body(const Skeleton& skeleton, const model::XmlElement& at) {
  return Finder(skeleton, at).find();
}

}  // namespace verp::import
