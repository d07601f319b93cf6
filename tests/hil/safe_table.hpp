#pragma once
#include <cstdint>
#include <string>

#include "common/control/state.hpp"
#include "common/io/io.hpp"
#include "common/model/params.hpp"

namespace verp::test {

/// Judges every tick of one run; written from host/guide/safety.md, not from the code.
class SafeTable {
 public:
  explicit SafeTable(const Params& params);

  void tick(const Inputs& inputs, const Outputs& outputs);

  /// The first broken rule; empty if none.
  const std::string& violation() const { return violation_; }
  int mode() const { return mode_; }
  /// Bit m: mode m.
  std::uint32_t seen() const { return seen_; }

 private:
  void count_silence(const Inputs& inputs);
  void follow_joint(int joint, std::int32_t count);
  bool stirs(const Inputs& inputs);
  void count_push(const Inputs& inputs);
  void count_trouble(const Inputs& inputs, int to);
  void count_doubt(const Inputs& inputs);
  void count_flutter(int to);
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
  static constexpr std::uint32_t kForEver = 1'000'000;  ///< periods; counting stops here
  static constexpr std::uint32_t kFrozen = 20;          ///< equal IMU readings
  std::uint32_t servo_silent_[kMaxJoints] = {};         ///< periods
  std::uint32_t imu_silent_ = 0;
  std::uint32_t operator_silent_ = 0;
  std::uint32_t unmoved_ = 0;  ///< since the IMU showed a push
  std::uint32_t silent_ = 0;   ///< of servos, IMU, and missing ticks
  /// The same with devices that may be in doubt: silent_ has only those that must be.
  std::uint32_t perhaps_silent_ = 0;
  std::uint32_t servo_perhaps_[kMaxJoints] = {}, imu_perhaps_ = 0;
  /// A joint against a servo that follows its goals as a lag of 20 ms does, rad.
  struct Joint {
    double model = 0, stays = 0;
    double low = 0, high = 0;  ///< of the model since the joint last moved
    double due() const { return high - low; }
    double away = 0;
  };
  Joint joint_[kMaxJoints];
  std::uint32_t axis_still_[6] = {};  ///< readings since gyro and accelerometer axes moved
  std::int16_t axis_at_[6] = {};
  std::uint32_t alike_ = 0;           ///< fresh but unchanged IMU readings
  static constexpr int kAlarm = 3;    ///< of one servo
  static constexpr int kSupply = 21;  ///< of any servos
  static constexpr double kBeyond_rad = 0.05;
  static constexpr double kPushed_s = 0.3;  ///< a pushed robot may step unasked for this long
  static constexpr double kLies_s = 1.0;    ///< limp before it gets up
  static constexpr double kFalls_s = 0.7;
  static constexpr double kLiesDown_s = 1.0;  ///< no robot is on the floor sooner
  int servo_bad_[kMaxJoints] = {};            ///< consecutive readings
  int supply_low_ = 0;
  static constexpr int kHeld_s = 3, kFlutter_s = 12;
  int flutter_us_ = 0;            ///< of holdings; time takes it away
  bool trouble_ = false;          ///< until a request to relax
  bool perhaps_trouble_ = false;  ///< a joint that may be in doubt, soles that bear nothing
  std::uint32_t unloaded_ = 0;    ///< periods
  int trouble_ticks_ = 0;         ///< while walking
  std::int16_t gyro_[3] = {}, accel_[3] = {};
  std::int32_t goal_[kMaxJoints] = {};
  std::int32_t from_[kMaxJoints] = {};  ///< goals at the start of the rise or sitting down
  bool begun_ = false;
};

}  // namespace verp::test
