#include "common/control/golden.hpp"

#include "common/kinematics/forward.hpp"
#include "common/kinematics/leg_ik.hpp"
#include "common/model/leg.hpp"
#include "common/record/digest.hpp"

namespace verp::control {
namespace {

using namespace kinematics;

constexpr std::uint32_t kSeed = 0x564b;  // so that zeros count

// Knuth's linear congruential generator; its upper bits are the good ones.
float next_share(std::uint32_t& random) {
  random = random * 1664525u + 1013904223u;
  return static_cast<float>(random >> 8) * 0x1p-24F;
}

void add(record::Digest32& digest, float value) {
  std::uint32_t word;
  __builtin_memcpy(&word, &value, sizeof word);
  digest.add(word);
}

void add(record::Digest32& digest, const Pose& pose) {
  for (int i = 0; i < 9; ++i) add(digest, pose.rotation(i / 3, i % 3));
  for (int i = 0; i < 3; ++i) add(digest, pose.position_m[i]);
}

void solve(const Params& params, int foot, const float* angle_rad, GoldenVector& vector,
           record::Digest32& digest) {
  const LegParams& leg = params.leg[foot];
  if (leg.solver == LegSolver::kNone) return;
  float leg_rad[kLegJoints];
  model::read_leg(leg, angle_rad, leg_rad);
  const Pose sole = sole_pose(leg, leg_chain(params, leg, Pose{}, leg_rad));
  vector.sole_m[foot] = math::to_xyz(sole.position_m);
  const LegAngles solved = solve_leg(params, leg, sole, leg_rad);
  for (const float angle : solved.angle_rad) add(digest, angle);
  digest.add(solved.flags);
}

}  // namespace

void golden_posture(const Params& params, std::uint32_t seed, float* angle_rad) {
  std::uint32_t random = seed;
  for (int j = 0; j < params.joint_count; ++j) {
    const JointParams& joint = params.joint[j];
    angle_rad[j] = joint.lower_rad + (joint.upper_rad - joint.lower_rad) * next_share(random);
  }
}

GoldenVector golden_vector(const Params& params, std::uint32_t seed) {
  GoldenVector vector;
  vector.seed = seed;
  float angle_rad[kMaxJoints] = {};
  golden_posture(params, seed, angle_rad);
  record::Digest32 poses(kSeed);
  for (int node = 0; node <= params.joint_count; ++node) {
    add(poses, node_pose(params, Pose{}, angle_rad, node));
  }
  vector.poses_digest = poses.value();
  vector.com_m = math::to_xyz(center_of_mass(params, Pose{}, angle_rad));
  record::Digest32 legs(kSeed);
  for (int foot = 0; foot < kFeet; ++foot) solve(params, foot, angle_rad, vector, legs);
  vector.legs_digest = legs.value();
  return vector;
}

int count_golden_matches(const ParamsImage& image) {
  int matches = 0;
  for (const GoldenVector& wanted : image.golden) {
    const GoldenVector found = golden_vector(image.params, wanted.seed);
    if (__builtin_memcmp(&found, &wanted, sizeof found) == 0) ++matches;
  }
  return matches;
}

}  // namespace verp::control
