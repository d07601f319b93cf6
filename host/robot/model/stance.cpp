#include "host/robot/model/stance.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "common/kinematics/leg_ik.hpp"
#include "common/model/leg.hpp"
#include "common/model/tuning_ranges.hpp"
#include "host/robot/model/leg.hpp"
#include "host/robot/model/load_error.hpp"
#include "host/robot/model/params.hpp"

namespace verp::model {
namespace {

// Tuning's defaults are for generic21: leg 186 mm, hip at 0.81 of it, feet 1.4 mm inside the hips.
// Lengths scale with the leg, times with its square root, like a pendulum's.
constexpr double kItsLeg_m = 0.186;
constexpr double kUsual_v = 12;  // of its servos
constexpr double kHipShare = 0.808;
constexpr double kMostHipShare = 0.97;  // straighter legs cannot step
constexpr double kFeetInside = 0.0014 / kItsLeg_m;
// Soles that roll with their legs bear less sway. Open Duck Mini walks with 0.30 to 0.32 s.
constexpr double kRockingCycle_s = 0.335;
// Gap between inner edges of passing soles.
constexpr double kSolesApart_m = 0.005;
// The walk's range (tuning_ranges.hpp): hip 5 cm to 1 m above the ankle.
constexpr double kLeastLeg_m = 0.06, kMostLeg_m = 1.2;
constexpr double kMostTilt_rad = 0.2, kMostUneven_m = 0.02;

double leg_length(const Entity& entity, const Limb& leg) {
  const LegGeometry g = classify_leg(entity, leg);
  return g.thigh_m + g.shank_m;
}

const char* leg_name(int side) {
  return side == 0 ? "left_leg" : "right_leg";
}

/// Poses of a leg's links in the body frame, hip to ankle, standing.
std::vector<Transform> standing_links(const Entity& entity, const Limb& leg) {
  std::vector<int> chain;
  for (int node = leg.joints.back() + 1; node != 0;
       node = entity.joints[static_cast<std::size_t>(node - 1)].parent) {
    chain.insert(chain.begin(), node - 1);
  }
  Transform pose = Transform::Identity();
  std::vector<Transform> links;
  for (const int j : chain) {
    const Joint& joint = entity.joints[static_cast<std::size_t>(j)];
    pose = pose * Eigen::Translation3d(joint.origin_m) *
           Eigen::AngleAxisd(joint.stand_rad, joint.axis);
    if (std::find(leg.joints.begin(), leg.joints.end(), j) != leg.joints.end()) {
      links.push_back(pose);
    }
  }
  return links;
}

/// A level sole under the hip, at the walk's lateral distance.
Pose sole_at(const Params& params, int side, double height_m) {
  const LegParams& leg = params.leg[side];
  Pose sole;
  sole.position_m = {leg.hip_body_m.x,
                     static_cast<float>(side == 0 ? 1 : -1) * params.tuning.gait.half_stance_m,
                     leg.hip_body_m.z - static_cast<float>(height_m) + leg.sole_foot_m.z};
  return sole;
}

class Settler {
 public:
  Settler(const Facts& facts, Entity& entity) : f_(facts), e_(entity) {
    for (const int side : {0, 1})
      leg_[static_cast<std::size_t>(side)] = find_limb(e_, leg_name(side));
  }

  void settle() {
    if (!leg_[0] || !leg_[1]) return;
    check_sides();
    check_lengths();
    fill_gait();
    fill_stand();
    fill_pose("sit", 0.45 * leg_m_);
    check_pose();
    check_stand();
    check_knees();
  }

 private:
  const XmlElement& limb_at(const std::string& name) const {
    for (const LimbFact& fact : f_.limbs) {
      if (fact.name == name) return fact.at;
    }
    return f_.body->at;
  }

  const TuningFact* given(const std::string& name) const {
    for (const TuningFact& fact : f_.tuning) {
      if (fact.name == name) return &fact;
    }
    return nullptr;
  }

  double tuned(const std::string& name) const {
    double value = 0;
    for (const auto& [each, number] : e_.tuning) {
      if (each == name) value = number;
    }
    return value;
  }

  void check_sides() const {
    const double left_m = classify_leg(e_, *leg_[0]).hip_m.y();
    const double right_m = classify_leg(e_, *leg_[1]).hip_m.y();
    if (left_m > right_m) return;
    limb_at("left_leg")
        .fail(
            fmt::format("left_leg hangs at y = {:.3f} m, right_leg at {:.3f} m: on the other side",
                        left_m, right_m),
            "swap the two legs' tips, or turn the pose in <verp:body> so that y points left");
  }

  void check_lengths() {
    for (const int side : {0, 1}) {
      leg_m_ = leg_length(e_, *leg_[static_cast<std::size_t>(side)]);
      if (leg_m_ >= kLeastLeg_m && leg_m_ <= kMostLeg_m) continue;
      limb_at(leg_name(side))
          .fail(fmt::format("{} is {:.4g} m long from hip to ankle", leg_name(side), leg_m_),
                "this controller walks on legs of 0.06 to 1.2 m: check the file's units");
    }
  }

  void put(const std::string& name, double value, const char* from) {
    if (given(name)) return;
    const Range range = kTuningRanges[*tuning_id(name)];
    value = std::clamp(value, static_cast<double>(range.low), static_cast<double>(range.high));
    e_.tuning.emplace_back(name, value);
    e_.defaults.push_back(fmt::format("{} {:.4g}, from its {}", name, value, from));
  }

  /// Height of the file's standing pose, or the usual share of the leg.
  double hip_height() const {
    if (given("gait.hip_height_m")) return tuned("gait.hip_height_m");
    if (poses_leg("stand")) return stand_of(e_, *leg_[0]).hip_height_m;
    return found_m_ > 0 ? found_m_ : kHipShare * leg_m_;
  }

  double half_stance() const {
    const Limb& leg = *leg_[0];
    const LegGeometry g = classify_leg(e_, leg);
    const double foot_m = node_origins(e_)[static_cast<std::size_t>(leg.joints.back()) + 1].y();
    // Without ankle roll, a sole is level only where it is at the zero pose.
    const double ankle_m = g.joint[5] < 0 ? foot_m : g.hip_m.y() - kFeetInside * leg_m_;
    const double beside_m = ankle_m + leg.tip.translation().y();
    return std::max(beside_m, kSolesApart_m / 2 - leg.sole_min_m.y());
  }

  bool lacks(std::size_t slot) const { return classify_leg(e_, *leg_[0]).joint[slot] < 0; }

  /// From the sole's middle to near its inner edge. There the body sways least, so that soles which
  /// roll with their legs stay flat.
  double inward_m() const {
    const Limb& leg = *leg_[0];
    const double half_m = (leg.sole_max_m.y() - leg.sole_min_m.y()) / 2;
    return std::max(half_m - static_cast<double>(GaitTuning{}.support_margin_m), 0.0);
  }

  void fill_gait() {
    const Tuning usual;
    const double longer = leg_m_ / kItsLeg_m, slower = std::sqrt(longer);
    // The low-voltage threshold of 12 V servos (three lithium cells), scaled.
    const double nominal_v = e_.joints.empty() ? kUsual_v : e_.joints[0].servo.nominal_v;
    if (nominal_v != kUsual_v) {
      put("safety.voltage_low_v", usual.safety.voltage_low_v / kUsual_v * nominal_v, "servos");
    }
    put("gait.hip_height_m", hip_height(), poses_leg("stand") ? "standing pose" : "legs");
    put("gait.half_stance_m", half_stance(), "hips and soles");
    if (lacks(0)) put("gait.max_turn_rad", 0, "legs without hip yaw");
    if (lacks(5)) {
      put("gait.zmp_y_m", -inward_m(), "legs without ankle roll");
      put("gait.cycle_s", kRockingCycle_s * slower, "legs without ankle roll");
    }
    for (const auto& [name, value] : {std::pair{"gait.lift_m", usual.gait.lift_m},
                                      {"gait.touchdown_m", usual.gait.touchdown_m}}) {
      put(name, longer * static_cast<double>(value), "legs");
    }
    for (const auto& [name, value] :
         {std::pair{"balance.ankle_pitch_rate_s", usual.balance.ankle_pitch_rate_s},
          {"balance.ankle_roll_rate_s", usual.balance.ankle_roll_rate_s},
          {"balance.hip_pitch_rate_s", usual.balance.hip_pitch_rate_s},
          {"balance.hip_roll_rate_s", usual.balance.hip_roll_rate_s}}) {
      put(name, slower * static_cast<double>(value), "legs");
    }
  }

  bool is_of_leg(const std::string& joint) const {
    for (const Limb* const leg : leg_) {
      for (const int j : leg->joints) {
        if (e_.joints[static_cast<std::size_t>(j)].name == joint) return true;
      }
    }
    return false;
  }

  const PoseFact* poses_leg(const std::string& pose) const {
    for (const PoseFact& fact : f_.poses) {
      if (fact.pose == pose && is_of_leg(fact.joint)) return &fact;
    }
    return nullptr;
  }

  /// The knee is ahead of the line from hip to ankle.
  bool bends_forward(const Params& params, int side, const float* angle_rad) const {
    const LegParams& leg = params.leg[side];
    const kinematics::LegChain chain = kinematics::leg_chain(params, leg, Pose{}, angle_rad);
    const auto knee = chain.link[3].position_m, ankle = chain.link[5].position_m;
    const float share = (leg.hip_body_m.z - knee.z()) / (leg.hip_body_m.z - ankle.z());
    return knee.x() > leg.hip_body_m.x + share * (ankle.x() - leg.hip_body_m.x) - 1e-4F;
  }

  /// Newton finds the nearest solution: start from crouches in both directions.
  bool solve(const Params& params, int side, const Pose& sole, float* angle_rad) const {
    const LegParams& leg = params.leg[side];
    for (const double bend : {0.6, 0.3, 1.0, -0.6, -1.0}) {
      float start_rad[kLegJoints] = {};
      for (const auto& [k, part] : {std::pair{2, -1.0}, {3, 2.0}, {4, -1.0}}) {
        const double along = e_.joints[leg.joint[k]].axis.y();
        start_rad[k] = static_cast<float>(along < 0 ? -part * bend : part * bend);
      }
      kinematics::LegAngles solved;
      for (int round = 0; round < 12; ++round) {
        solved = kinematics::solve_leg(params, leg, sole, start_rad);
        std::copy_n(solved.angle_rad, kLegJoints, start_rad);
      }
      if (solved.flags != 0 || bends_forward(params, side, solved.angle_rad) != knees_ahead_)
        continue;
      std::copy_n(solved.angle_rad, kLegJoints, angle_rad);
      return true;
    }
    return false;
  }

  /// Omitted leg angles, at this height or the lowest reachable one above.
  void fill_pose(const std::string& pose, double height_m) {
    if (poses_leg(pose)) return;
    const double stand_m = hip_height();
    for (int step = 0; step <= 20; ++step) {
      if (put_pose(pose, height_m + step * (stand_m - height_m) / 20)) {
        e_.defaults.push_back(fmt::format("the legs of pose {}, from their lengths{}", pose,
                                          knees_ahead_ ? "" : "; their knees bend back"));
        return;
      }
      if (height_m == stand_m) break;
    }
    refuse_height(stand_m, std::nullopt);
  }

  /// Knees ahead, as a person's, unless the limits allow only a bird's.
  void fill_stand() {
    const double height_m = hip_height();
    if (poses_leg("stand")) {
      float angle_rad[kLegJoints];
      const Params params = make_params(e_);
      for (int k = 0; k < kLegJoints; ++k)
        angle_rad[k] = joint_of(params, params.leg[0], k).stand_rad;
      knees_ahead_ = bends_forward(params, 0, angle_rad);
      return;
    }
    double used_m = height_m;
    if (!stands_at(height_m)) {
      const std::optional<double> nearest_m = nearest_height();
      if (given("gait.hip_height_m") || !nearest_m) refuse_height(height_m, nearest_m);
      used_m = found_m_ = *nearest_m;
      for (auto& [name, value] : e_.tuning) {
        if (name == "gait.hip_height_m") value = used_m;
      }
      e_.defaults.push_back(fmt::format(
          "gait.hip_height_m {:.4g} instead, the nearest within the legs' limits", used_m));
    }
    fill_pose("stand", used_m);
  }

  bool stands_at(double height_m) {
    for (const bool ahead : {true, false}) {
      knees_ahead_ = ahead;
      if (put_pose("stand", height_m)) return true;
    }
    return false;
  }

  /// To the usual one, where the legs reach a level stand, and if possible bend on to lift a foot:
  /// by the gait's lift, else by half of it, else not at all.
  std::optional<double> nearest_height() {
    for (const double bend_m : {tuned("gait.lift_m"), tuned("gait.lift_m") / 2, 0.0}) {
      for (int step = 1; step <= 30; ++step) {
        for (const double share : {kHipShare + 0.01 * step, kHipShare - 0.01 * step}) {
          const double height_m = share * leg_m_;
          if (share < kMostHipShare && stands_at(height_m - bend_m) && stands_at(height_m))
            return height_m;
        }
      }
    }
    return std::nullopt;
  }

  bool put_pose(const std::string& pose, double height_m) {
    const Params params = make_params(e_);
    float angle_rad[2][kLegJoints];
    for (const int side : {0, 1}) {
      if (!solve(params, side, sole_at(params, side, height_m), angle_rad[side])) return false;
    }
    for (const int side : {0, 1}) {
      for (int k = 0; k < kLegJoints; ++k) {
        if (!has(params.leg[side], k)) continue;
        Joint& joint = e_.joints[params.leg[side].joint[k]];
        (pose == "stand" ? joint.stand_rad : joint.sit_rad) =
            static_cast<double>(angle_rad[side][k]);
      }
    }
    return true;
  }

  [[noreturn]] void refuse_height(double height_m, std::optional<double> other_m) const {
    const TuningFact* const asked = given("gait.hip_height_m");
    const XmlElement& at = asked ? asked->at : limb_at("left_leg");
    at.fail(fmt::format("the legs ({:.3f} m from hip to ankle) cannot stand level with the hip "
                        "{:.3f} m above the ankle, within their joints' limits",
                        leg_m_, height_m),
            (other_m ? fmt::format("choose gait.hip_height_m near {:.3f}", *other_m)
                     : std::string("choose another gait.hip_height_m")) +
                ", or correct limits, axes or the soles' frames");
  }

  /// Soles level, and both on one floor.
  void check_pose() const {
    const PoseFact* const fact = poses_leg("stand");
    if (!fact) return;
    double height_m[2];
    for (const int side : {0, 1}) {
      const Limb& leg = *leg_[static_cast<std::size_t>(side)];
      const Transform sole = standing_links(e_, leg).back() * leg.tip;
      height_m[side] = sole.translation().z();
      const double tilt_rad = std::acos(std::clamp(sole.linear()(2, 2), -1.0, 1.0));
      if (tilt_rad <= kMostTilt_rad) continue;
      fact->at.fail(fmt::format("pose 'stand' tilts the sole of {} by {:.0f} degrees",
                                leg_name(side), tilt_rad * 57.2958),
                    "correct its angles, or leave the legs out: they are found");
    }
    if (std::abs(height_m[0] - height_m[1]) <= kMostUneven_m) return;
    fact->at.fail(fmt::format("pose 'stand' has one sole {:.0f} mm above the other",
                              1000 * std::abs(height_m[0] - height_m[1])),
                  "correct its angles, or leave the legs out: they are found");
  }

  /// Checks that the legs reach the gait's posture from the standing pose.
  void check_stand() const {
    const Params params = make_params(e_);
    if (!can_stand(params))
      refuse_height(static_cast<double>(params.tuning.gait.hip_height_m), std::nullopt);
  }

  void check_knees() const {
    for (const int side : {0, 1}) {
      const Limb& leg = *leg_[static_cast<std::size_t>(side)];
      const Joint& knee = e_.joints[static_cast<std::size_t>(classify_leg(e_, leg).joint[3])];
      const Stand stand = stand_of(e_, leg);
      if (stand.knee_n_m <= knee.servo.most_torque_n_m()) continue;
      for (const ServoFact& servo : f_.bus().servos) {
        if (servo.joint != knee.name) continue;
        servo.at.fail(
            fmt::format("joint '{}' has to hold {:.1f} N m when the robot ({:.3g} kg) "
                        "stands on one leg, and its servo stalls at {:.1f}",
                        knee.name, stand.knee_n_m, total_mass(e_), knee.servo.most_torque_n_m()),
            "choose a stronger servo, a straighter stand, or correct the masses");
      }
    }
  }

  const Facts& f_;
  Entity& e_;
  std::array<const Limb*, 2> leg_{};
  double leg_m_ = 0;
  bool knees_ahead_ = true;
  double found_m_ = 0;  ///< hip height, where the usual one is out of reach
};

}  // namespace

bool can_stand(const Params& params) {
  const double height_m = static_cast<double>(params.tuning.gait.hip_height_m);
  for (const int side : {0, 1}) {
    const LegParams& leg = params.leg[side];
    float angle_rad[kLegJoints];
    for (int k = 0; k < kLegJoints; ++k) angle_rad[k] = joint_of(params, leg, k).stand_rad;
    const auto solved =
        kinematics::solve_leg(params, leg, sole_at(params, side, height_m), angle_rad);
    if ((solved.flags & ~kinematics::kJointLimited) != 0) return false;
  }
  return true;
}

void settle_stance(const Facts& facts, Entity& entity) {
  Settler(facts, entity).settle();
}

Stand stand_of(const Entity& entity, const Limb& leg) {
  const std::vector<Transform> links = standing_links(entity, leg);
  const LegGeometry g = classify_leg(entity, leg);
  const std::size_t first = g.joint[0] < 0 ? 1 : 0;
  const Vec3 ankle = links[4 - first].translation(), knee = links[3 - first].translation();
  Stand stand;
  stand.hip_height_m = g.hip_m.z() - ankle.z();
  // On one leg the weight acts at worst halfway from ankle to hip.
  const double arm_m = std::abs(knee.x() - (ankle.x() + g.hip_m.x()) / 2);
  stand.knee_n_m = total_mass(entity) * kGravity_m_s2 * arm_m;
  return stand;
}

}  // namespace verp::model
