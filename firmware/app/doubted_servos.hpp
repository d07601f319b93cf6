#pragma once
#include <cstddef>
#include <cstdint>

#include "common/model/params.hpp"
#include "common/protocol/control_table.hpp"
#include "firmware/app/bus_master.hpp"
#include "firmware/app/doubts.hpp"
#include "firmware/app/read_chain.hpp"
#include "firmware/app/schedule.hpp"
#include "firmware/app/servo_ram.hpp"

namespace verp::app {

/// Doubts about Dynamixel servos. After a power loss these have factory gains and no profile.
class DoubtedServos : public Doubts {
 public:
  using Doubts::Doubts;

  /// Call in ticks with room on the bus: queries a few servos, or sets them up again. `torque`:
  /// torque is wanted.
  void resolve(BusMaster& master, bool torque);

 private:
  static constexpr std::uint8_t kRepeats = 3;  ///< of unconfirmed writes

  void ask(BusMaster& master, std::uint32_t joints);
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

  std::uint32_t batch_ = 0;
  std::uint8_t renewals_ = 0;  ///< left to send to batch_
};

}  // namespace verp::app
