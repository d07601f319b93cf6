#pragma once
#include <cstdint>

#include "common/io/io.hpp"
#include "common/model/params.hpp"
#include "common/protocol/feetech_table.hpp"
#include "firmware/app/bring_up_report.hpp"
#include "firmware/app/doubts.hpp"
#include "firmware/app/feetech_master.hpp"
#include "firmware/app/feetech_writer.hpp"
#include "firmware/app/joint_effort.hpp"
#include "firmware/app/plausible_counts.hpp"
#include "firmware/app/read_chain.hpp"

/// The ServoBinding (contracts.hpp) for Feetech STS servos, our IMU and our feet on one FrameBus.
/// These servos have no bus watchdog: if the controller dies, they hold their last goal for ever.
namespace verp::app {

/// Doubts about Feetech servos. Their gains are EEPROM, so a power loss takes only torque.
class FeetechDoubts : public Doubts {
 public:
  using Doubts::Doubts;
  /// Call in ticks with room on the bus. `torque`: torque is wanted.
  void resolve(FeetechMaster& master, bool torque);
};

class FeetechServos {
 public:
  FeetechServos(const Params& params, hal::FrameBus& bus);
  BringUpReport bring_up();
  void limit_torque(std::uint8_t percent) { servos_.limit_torque(percent); }
  void read_positions(Inputs& inputs);
  void heard_nothing_for(std::uint64_t) {}
  void read_sensors(Inputs& inputs, bool imu);
  void send(const Outputs& outputs);
  std::uint64_t now_us() { return master_.now_us(); }
  const BusCounters& counters() const { return master_.counters(); }
  std::uint32_t damaged() const { return master_.crc_errors() + implausible_; }
  std::uint32_t noise() const { return master_.noise_bytes(); }
  /// Not read: a tick's bytes go to positions.
  const JointEffort* efforts() const { return nullptr; }

 private:
  enum Slot : std::uint8_t { kImuSlot = 0, kFootSlot = 1, kServoSlot = kFootSlot + kFeet };
  static constexpr std::uint8_t kPositionBytes = 2;
  static constexpr std::uint16_t kLongSilence = 5000;  ///< ticks; the count stops here

  Take take_position(const feetech::Packet& packet, Inputs& inputs);
  void set_position(int joint, const feetech::Packet& packet, Inputs& inputs);
  Take take_sensor(const feetech::Packet& packet, Inputs& inputs, bool imu);
  void set_sensor(int slot, const std::uint8_t* data, Inputs& inputs, bool imu);
  void set_slow(const std::uint8_t* data, Inputs& inputs);
  /// After an alarm: did the servo drop its torque?
  void read_torque();

  const Params& params_;
  FeetechMaster master_;
  FeetechWriter servos_{params_};
  FeetechDoubts doubted_{params_};
  PlausibleCounts plausible_{params_};
  ReadChain<kMaxJoints> joints_;
  ReadChain<kServoSlot + 1> sensors_;
  std::uint16_t silent_ticks_[kMaxJoints] = {};
  std::uint32_t feet_expected_ = 0;
  std::uint32_t feet_seen_ = 0;
  std::uint32_t implausible_ = 0;
  std::uint8_t spare_ = 0;
  std::uint8_t slow_joint_ = 0;
};

/// Status bits as the bits of Hardware Error Status that the core knows.
std::uint8_t hardware_error_of(std::uint8_t feetech_status);

}  // namespace verp::app
