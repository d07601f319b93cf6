#pragma once
#include <cstddef>
#include <cstdint>

#include "common/model/params.hpp"
#include "common/protocol/control_table.hpp"
#include "firmware/app/bus_master.hpp"
#include "firmware/app/joint_rules.hpp"
#include "firmware/app/schedule.hpp"
#include "firmware/app/servo_ram.hpp"

namespace verp::app {

/// Servos whose torque may differ from the command. A servo that was silent for long may have lost
/// power: it returns limp, with factory gains and no profile, and torque would throw it at its
/// goal. Until its state is known it is sent only torque off, and its position does not count, so
/// the core holds and lowers the robot. A servo that kept its torque counts again. Any other gets
/// gains and profile once the robot was released, and rises from the pose it is found in. After a
/// hardware error a servo is treated alike until it is rebooted.
class DoubtedServos {
 public:
  explicit DoubtedServos(const Params& params) : params_(params) {}

  /// Bit j: joint j's servo is doubted.
  std::uint32_t all() const { return doubted_; }

  void silent_for(int joint, std::uint32_t time_us);
  /// `alert`: the answer's hardware error bit. True: the answer counts.
  bool counts(int joint, bool alert);
  /// A hardware error took the servo's torque.
  void shut_down(int joint);

  /// Call in ticks with room on the bus: queries a few servos, or sets them up again. `torque`:
  /// torque is wanted.
  void resolve(BusMaster& master, bool torque);

 private:
  static constexpr std::uint8_t kRepeats = 3;  ///< of unconfirmed writes

  std::uint32_t some(std::uint32_t joints) const;
  void ask(BusMaster& master, std::uint32_t joints);
  void learn(int joint, bool kept);
  void trust(std::uint32_t joints);
  void renew(BusMaster& master);
  template <std::size_t bytes>
  void send_ram(BusMaster& master, std::uint16_t address, std::uint8_t (ServoRam::*part)[bytes]) {
    dxl::Encoder encoder(master.frame(), master.capacity());
    dxl::begin_sync_write(encoder, address, bytes);
    for (int j = 0; j < params_.servo_count(); ++j) {
      if ((batch_ >> j & 1) == 0) continue;
      encoder.u8(params_.joint[j].servo_id);
      const ServoRam ram(profile_of(params_, j));
      for (const std::uint8_t byte : ram.*part) encoder.u8(byte);
    }
    master.send(encoder.finish());
  }

  const Params& params_;
  std::uint32_t doubted_ = 0;
  std::uint32_t here_ = 0;  ///< doubted servos that have answered
  std::uint32_t broken_ = 0;
  std::uint32_t limp_ = 0;
  std::uint32_t batch_ = 0;
  std::uint8_t renewals_ = 0;  ///< left to send to batch_
  const std::uint32_t patience_us_ = doubt_us(params_);
};

}  // namespace verp::app
