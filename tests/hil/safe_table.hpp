#pragma once
#include <cstdint>
#include <string>

#include "common/control/state.hpp"
#include "common/io/io.hpp"
#include "common/model/params.hpp"

namespace verp::test {

/// A referee of the safety table, written from the words of common/safety/README.md and not from
/// its code: sees Inputs and Outputs of every tick and remembers what they must not do. One for
/// each life of a controller.
class SafeTable {
 public:
  explicit SafeTable(const Params& params);

  void tick(const Inputs& inputs, const Outputs& outputs);

  /// The first thing that broke a rule, and when; empty: nothing did.
  const std::string& violation() const { return violation_; }
  int mode() const { return mode_; }
  /// Bit m: the controller has been in mode m.
  std::uint32_t seen() const { return seen_; }

 private:
  void count_silence(const Inputs& inputs);
  void count_push(const Inputs& inputs);
  void count_trouble(const Inputs& inputs, int to);
  void check_trouble(int to);
  void check_way(const Outputs& outputs, int to);
  void check_transition(const Inputs& inputs, int to);
  void check_outputs(const Inputs& inputs, const Outputs& outputs, int to);
  void check_goals(const Inputs& inputs, const Outputs& outputs);
  void fault(const std::string& what);

  const Params& params_;
  std::string violation_;
  std::uint32_t tick_ = 0;
  std::uint32_t seen_ = 1;
  int mode_ = 0;
  int in_mode_ticks_ = 0;
  static constexpr std::uint32_t kForEver = 1'000'000;  ///< periods; counted no further
  static constexpr std::uint32_t kFrozen = 20;          ///< readings alike: the IMU repeats itself
  std::uint32_t servo_silent_[kMaxJoints] = {};         ///< periods
  std::uint32_t imu_silent_ = 0;
  std::uint32_t operator_silent_ = 0;
  std::uint32_t unmoved_ = 0;  ///< since the IMU told of a push
  std::uint32_t silent_ = 0;   ///< the longest of servos, IMU, and a controller that had no tick
  std::uint32_t alike_ = 0;    ///< fresh readings of the IMU since they changed
  static constexpr int kAlarm = 3;    ///< readings of one servo in a row
  static constexpr int kSupply = 21;  ///< readings of any servos in a row
  static constexpr double kBeyond_rad = 0.05;
  static constexpr double kPushed_s = 0.3;  ///< so long after it a robot may step unasked
  static constexpr double kLies_s = 1.0;    ///< limp, before it gets up
  static constexpr double kFalls_s = 0.7;   ///< what a fall lasts
  int servo_bad_[kMaxJoints] = {};          ///< readings in a row
  int supply_low_ = 0;
  bool trouble_ = false;   ///< of power, and nobody has asked a relaxed robot to relax since
  int trouble_ticks_ = 0;  ///< of a walk
  std::int16_t gyro_[3] = {}, accel_[3] = {};
  std::int32_t goal_[kMaxJoints] = {};
  std::int32_t from_[kMaxJoints] = {};  ///< goals when the rise or the sitting down began
  bool begun_ = false;
};

}  // namespace verp::test
