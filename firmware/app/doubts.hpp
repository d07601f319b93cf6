#pragma once
#include <cstddef>
#include <cstdint>

#include "common/model/params.hpp"
#include "firmware/app/joint_rules.hpp"

namespace verp::app {

/// Servos resolved in one tick.
inline constexpr int kResolvedAtOnce = 4;

/// Which servos' torque may differ from the command, whatever their protocol. A servo that was
/// silent for long may have lost power: it returns limp, and torque would throw it at its goal.
/// Until its state is known it is sent only torque off, and its position does not count, so the
/// core holds and lowers the robot. A servo that kept its torque counts again. Any other is set up
/// again once the robot was released, and rises from the pose it is found in. After a hardware
/// error a servo is treated alike until it is rebooted.
class Doubts {
 public:
  explicit Doubts(const Params& params) : params_(params) {}

  /// Bit j: joint j's servo is doubted.
  std::uint32_t all() const { return doubted_; }

  void silent_for(int joint, std::uint32_t time_us);
  /// `alert`: the answer's hardware error bit. True: the answer counts.
  bool counts(int joint, bool alert);
  /// A hardware error took the servo's torque.
  void shut_down(int joint);

 protected:
  /// A few servos to ask (`torque`: it is wanted) or to set up again; 0: none.
  std::uint32_t open(bool torque);
  std::uint32_t some(std::uint32_t joints) const;
  void learn(int joint, bool kept);
  void trust(std::uint32_t joints);

  const Params& params_;
  std::uint32_t here_ = 0;  ///< doubted servos that have answered

 private:
  std::uint32_t doubted_ = 0;
  std::uint32_t broken_ = 0;
  std::uint32_t limp_ = 0;
  const std::uint32_t patience_us_ = doubt_us(params_);
};

}  // namespace verp::app
