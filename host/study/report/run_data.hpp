#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

/// Data of a walk's report, independent of twin and controller. World frame: x where the robot
/// faced at the start, y to its left, z up. SI units unless the name says otherwise.
namespace verp::report {

struct Point2 {
  double x_m = 0, y_m = 0;
};
struct Point3 {
  double x_m = 0, y_m = 0, z_m = 0;
};

struct Sample {
  double t_s = 0;    ///< since the gait's start
  int phase = 0;     ///< gait::Phase
  int state = 0;     ///< 0..15, as in the paper
  int carrying = 2;  ///< supporting or next foot: 0 left, 1 right, 2 both
  Point3 body;
  std::array<double, 3> roll_pitch_yaw_rad{};
  std::array<Point3, 2> ankle;                ///< left, right
  std::array<std::array<Point2, 4>, 2> sole;  ///< corners in order
  std::array<bool, 2> contact{};
  std::vector<std::vector<Point3>> limb;  ///< Run::limbs, root to tip
  std::optional<Point2> zmp;              ///< measured
  std::optional<Point2> zmp_planned;      ///< relative to the supporting sole
  std::optional<double> zmp_bias_mm;
  std::vector<double> joint_rad;
  std::vector<double> goal_rad;    ///< the controller's goals
  std::vector<double> torque_use;  ///< |torque| / stall torque
};

struct Limb {
  enum class Kind { kTrunk, kHead, kArm, kLeg } kind = Kind::kTrunk;
  int side = 2;  ///< 0 left, 1 right, 2 neither
};

/// One walk of a sweep. Only a good one has speed and bias.
struct SweepWalk {
  enum class End { kNone, kWalked, kFell, kFailed, kInterrupted } end = End::kNone;
  std::optional<double> step_m;     ///< longest step made
  std::optional<double> speed_m_s;  ///< in steady walking
  std::optional<double> bias_mm;
};

/// For tables; kNone: the sweep ended first.
constexpr const char* name_of(SweepWalk::End end) {
  constexpr const char* kNames[] = {"not walked", "walked", "fell", "failed", "interrupted"};
  return kNames[static_cast<int>(end)];
}

struct SweepRow {
  double step_m = 0;  ///< requested
  SweepWalk with;     ///< with multibody correction
  SweepWalk without;

  /// Shorter steps than requested, with the correction.
  bool limited() const { return with.step_m && *with.step_m < step_m - 5e-4; }
};

struct Fact {
  std::string name, value, note;
};

struct Run {
  std::string model;
  std::string title;    ///< the command, in words
  std::string verdict;  ///< the result, in words
  bool good = true;
  bool steady = true;  ///< has a steady cycle
  double cycle_s = 0.45;
  double period_s = 0.01;
  std::vector<std::string> joints;
  std::array<std::vector<int>, 2> leg_joints;  ///< left, right; hip to ankle
  std::vector<Limb> limbs;
  std::vector<Sample> samples;
  std::vector<Point2> asked;  ///< from the gait's start
  std::vector<Fact> facts;
  std::array<std::optional<double>, 16> bias_by_state_mm{};
  std::optional<double> bias_mean_mm;
  std::optional<double> speed_mean_m_s;
  std::vector<SweepRow> sweep;
  std::vector<std::pair<std::string, std::string>> changed;  ///< changed settings
  std::vector<std::pair<std::string, std::string>>
      provenance;           ///< revision, compiler, command, digest
  std::string replay_html;  ///< 3D replay; empty: none
  std::string trace_file;   ///< in the folder; empty: none
};

}  // namespace verp::report
