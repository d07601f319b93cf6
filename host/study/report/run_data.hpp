#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

/// What a report tells about one walk: plain numbers, so that the report knows neither twin nor
/// controller. World frame: x where the robot faced at the start, y to its left, z up; SI units
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
  double t_s = 0;    ///< since the gait began
  int phase = 0;     ///< gait::Phase
  int state = 0;     ///< 0..15, the paper's state within the cycle
  int carrying = 2;  ///< foot that carries or is about to: 0 left, 1 right, 2 both
  Point3 body;
  std::array<double, 3> roll_pitch_yaw_rad{};
  std::array<Point3, 2> ankle;                ///< left, right
  std::array<std::array<Point2, 4>, 2> sole;  ///< corners, in order around the sole
  std::array<bool, 2> contact{};
  std::vector<std::vector<Point3>> limb;  ///< of each Run::limbs, its line from root to tip
  std::optional<Point2> zmp;              ///< measured
  std::optional<Point2> zmp_planned;      ///< placed by the sole that carries
  std::optional<double> zmp_bias_mm;
  std::vector<double> joint_rad;
  std::vector<double> goal_rad;    ///< what the controller asked the servos for
  std::vector<double> torque_use;  ///< |torque| / stall torque
};

/// A limb as a line of bones.
struct Limb {
  enum class Kind { kTrunk, kHead, kArm, kLeg } kind = Kind::kTrunk;
  int side = 2;  ///< 0 left, 1 right, 2 neither
};

/// How one walk of a sweep ended, and what is true of it: a walk that did not end well has neither
/// speed nor bias to compare.
struct SweepWalk {
  enum class End { kNone, kWalked, kFell, kFailed, kInterrupted } end = End::kNone;
  std::optional<double> step_m;     ///< the longest step it made: limits may leave less than asked
  std::optional<double> speed_m_s;  ///< steady
  std::optional<double> bias_mm;
};

/// In a table: "fell", and so on; kNone: the sweep ended before it.
constexpr const char* name_of(SweepWalk::End end) {
  constexpr const char* kNames[] = {"not walked", "walked", "fell", "failed", "interrupted"};
  return kNames[static_cast<int>(end)];
}

/// One line of the table of a sweep over step lengths.
struct SweepRow {
  double step_m = 0;  ///< asked
  SweepWalk with;     ///< multibody correction
  SweepWalk without;

  /// The walk that was corrected made shorter steps than asked.
  bool limited() const { return with.step_m && *with.step_m < step_m - 5e-4; }
};

/// A named number as the page shows it.
struct Fact {
  std::string name, value, note;
};

struct Run {
  std::string model;
  std::string title;    ///< what was asked, in words
  std::string verdict;  ///< how it ended, in words
  bool good = true;
  bool steady = true;  ///< at least one cycle was: the last whole one stands for the walk
  double cycle_s = 0.45;
  double period_s = 0.01;
  std::vector<std::string> joints;
  std::array<std::vector<int>, 2> leg_joints;  ///< left, right; from hip to ankle
  std::vector<Limb> limbs;
  std::vector<Sample> samples;
  std::vector<Point2> asked;  ///< the way that the command makes from where the gait began
  std::vector<Fact> facts;
  std::array<std::optional<double>, 16> bias_by_state_mm{};
  std::optional<double> bias_mean_mm;
  std::optional<double> speed_mean_m_s;
  std::vector<SweepRow> sweep;
  std::vector<std::pair<std::string, std::string>> changed;  ///< what is not as by default
  std::vector<std::pair<std::string, std::string>>
      provenance;           ///< revision, compiler, command, digest
  std::string replay_html;  ///< a section that shows the run in three dimensions; empty: none
  std::string trace_file;   ///< name inside the folder; empty: none
};

}  // namespace verp::report
