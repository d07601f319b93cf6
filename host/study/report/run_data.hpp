#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

/// The data of a report on one walk. Plain numbers, so that the report depends on neither twin nor
/// controller. World frame: x where the robot faced at the start, y to its left, z up. SI units
/// unless the name says otherwise.
namespace verp::report {

struct Point2 {
  double x_m = 0, y_m = 0;
};
struct Point3 {
  double x_m = 0, y_m = 0, z_m = 0;
};

/// One control tick of the gait.
struct Sample {
  double t_s = 0;    ///< since the start of the gait
  int phase = 0;     ///< gait::Phase
  int state = 0;     ///< 0..15, the paper's state within the cycle
  int carrying = 2;  ///< supporting foot, or the next one: 0 left, 1 right, 2 both
  Point3 body;
  std::array<double, 3> roll_pitch_yaw_rad{};
  std::array<Point3, 2> ankle;                ///< left, right
  std::array<std::array<Point2, 4>, 2> sole;  ///< corners, in order around the sole
  std::array<bool, 2> contact{};
  std::vector<std::vector<Point3>> limb;  ///< for each of Run::limbs, its line from root to tip
  std::optional<Point2> zmp;              ///< measured
  std::optional<Point2> zmp_planned;      ///< relative to the supporting sole
  std::optional<double> zmp_bias_mm;
  std::vector<double> joint_rad;
  std::vector<double> goal_rad;    ///< the controller's goals
  std::vector<double> torque_use;  ///< |torque| / stall torque
};

/// A limb as a chain of bones.
struct Limb {
  enum class Kind { kTrunk, kHead, kArm, kLeg } kind = Kind::kTrunk;
  int side = 2;  ///< 0 left, 1 right, 2 neither
};

/// Result of one walk of a sweep. Only a walk that ended well has speed and bias.
struct SweepWalk {
  enum class End { kNone, kWalked, kFell, kFailed, kInterrupted } end = End::kNone;
  std::optional<double> step_m;     ///< longest step made; limits may shorten it
  std::optional<double> speed_m_s;  ///< in steady walking
  std::optional<double> bias_mm;
};

/// For tables: "fell", and so on; kNone: the sweep ended first.
constexpr const char* name_of(SweepWalk::End end) {
  constexpr const char* kNames[] = {"not walked", "walked", "fell", "failed", "interrupted"};
  return kNames[static_cast<int>(end)];
}

struct SweepRow {
  double step_m = 0;  ///< requested
  SweepWalk with;     ///< with multibody correction
  SweepWalk without;

  /// The corrected walk made shorter steps than requested.
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
  bool steady = true;  ///< has a steady cycle; the last whole one represents the walk
  double cycle_s = 0.45;
  double period_s = 0.01;
  std::vector<std::string> joints;
  std::array<std::vector<int>, 2> leg_joints;  ///< left, right; hip to ankle
  std::vector<Limb> limbs;
  std::vector<Sample> samples;
  std::vector<Point2> asked;  ///< commanded path from the start of the gait
  std::vector<Fact> facts;
  std::array<std::optional<double>, 16> bias_by_state_mm{};
  std::optional<double> bias_mean_mm;
  std::optional<double> speed_mean_m_s;
  std::vector<SweepRow> sweep;
  std::vector<std::pair<std::string, std::string>>
      changed;  ///< settings that differ from the defaults
  std::vector<std::pair<std::string, std::string>>
      provenance;           ///< revision, compiler, command, digest
  std::string replay_html;  ///< section with a 3D replay; empty: none
  std::string trace_file;   ///< name in the folder; empty: none
};

}  // namespace verp::report
