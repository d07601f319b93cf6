#pragma once
#include <cstdint>

#include "common/io/io.hpp"
#include "common/model/params.hpp"
#include "common/protocol/control_table.hpp"
#include "firmware/app/bring_up_report.hpp"
#include "firmware/app/bus_master.hpp"
#include "firmware/app/doubted_servos.hpp"
#include "firmware/app/joint_effort.hpp"
#include "firmware/app/read_chain.hpp"
#include "firmware/app/schedule.hpp"
#include "firmware/app/servo_writer.hpp"

/// The ServoBinding (contracts.hpp) for Dynamixel Protocol 2.0: servos, IMU and feet on one
/// FrameBus.
namespace verp::app {

class DynamixelServos {
 public:
  DynamixelServos(const Params& params, hal::FrameBus& bus);
  BringUpReport bring_up();
  void limit_torque(std::uint8_t percent) { servos_.limit_torque(percent); }

  // Fast Sync Read returns one packet for all servos, so one missing servo spoils it. After an
  // incomplete read the loop uses plain Sync Read until all answer again.
  void read_positions(Inputs& inputs);
  void heard_nothing_for(std::uint64_t time_us);
  void read_sensors(Inputs& inputs, bool imu);
  void send(const Outputs& outputs);
  std::uint64_t now_us() { return master_.now_us(); }
  const BusCounters& counters() const { return master_.counters(); }
  std::uint32_t damaged() const { return master_.crc_errors(); }
  std::uint32_t noise() const { return master_.noise_bytes(); }
  /// Not read: a tick's bytes go to positions.
  const JointEffort* efforts() const { return nullptr; }

 private:
  enum Slot : std::uint8_t { kImuSlot = 0, kFootSlot = 1, kServoSlot = kFootSlot + kFeet };
  static constexpr std::uint16_t kPositionBytes = 4;
  static constexpr std::uint16_t kLongSilence = 5000;  ///< ticks; the count stops here

  Take take_position(const dxl::Packet& packet, Inputs& inputs);
  Take take_fast(const dxl::Packet& packet, Inputs& inputs);
  void set_position(int joint, std::uint8_t error, const std::uint8_t* data, Inputs& inputs);
  Take take_sensor(const dxl::Packet& packet, Inputs& inputs, bool imu);
  void set_sensor(int slot, std::uint8_t error, const std::uint8_t* data, Inputs& inputs, bool imu);

  // The alert bit: Hardware Error Status is not zero. Only then a separate read pays; it includes
  // Torque Enable.
  void read_hardware_error(Inputs& inputs);

  const Params& params_;
  BusMaster master_;
  ServoWriter servos_{params_};
  DoubtedServos doubted_{params_};
  ReadChain<kMaxJoints> joints_;
  ReadChain<kServoSlot + 1> sensors_;
  std::uint16_t silent_ticks_[kMaxJoints] = {};
  std::uint32_t feet_expected_ = 0;
  std::uint32_t feet_seen_ = 0;
  std::uint8_t spare_ = 0;
  std::uint8_t slow_joint_ = 0;
  bool slow_alert_ = false;
  bool positions_complete_ = true;
  const bool all_fast_ = all_fast(params_);
};

}  // namespace verp::app
