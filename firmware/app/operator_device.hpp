#pragma once
#include <cstddef>
#include <cstdint>

#include "common/protocol/device_end.hpp"
#include "common/protocol/dynamixel2.hpp"
#include "firmware/app/contracts.hpp"
#include "firmware/app/operator_registers.hpp"
#include "hal/contract/byte_link.hpp"

namespace verp::app {

/// The controller as a Dynamixel device on the operator's port; OperatorLink and Recorder of the
/// loop. Nothing waits: poll() serves the link in the loop's idle time, order() and record() in the
/// tick. Single context; `params`, `link` and `images` must outlive it.
///
/// Answers Ping, Read, Write, Reg Write, Action, Sync, Bulk and fast reads, Sync and Bulk Write and
/// Reboot; others give the Instruction Error. Orders expire: the core checks their age.
class OperatorDevice {
 public:
  OperatorDevice(hal::ByteLink& link, const Params& params, const OperatorSetup& setup,
                 Images& images = no_images)
      : link_(link), registers_(params, setup, images) {}

  /// Takes at most kSlice bytes from the link; nothing while part of a reply waits for room. True
  /// if there was anything to do.
  bool poll();

  /// Shows the bring-up's result to the operator; drops earlier orders.
  void brought_up(const BringUpReport& report);
  void show(table::StartFault fault) { registers_.report().start_fault(fault); }

  void show(table::ServoPower power) { registers_.report().servo_power(power); }
  void show(table::ImuCalibrationState state) { registers_.report().imu_calibration(state); }

  /// Call when the twin that played the servos is silent or gone: no servo can hold torque. The
  /// operator regains what torque blocks, such as a restart, until the next tick. Orders stay.
  void servos_gone() { registers_.report().servos_gone(); }

  /// `count`: actions in the loop's library; `fault`: why stored ones are not available.
  void offer_actions(int count, action::KeptFault fault = action::KeptFault::kNone);

  /// Call as often as the counters should refresh.
  void report(const LoopHealth& health) { registers_.report().health(health); }

  OperatorRegisters& registers() { return registers_; }

  std::uint8_t id() const { return registers_.id(); }
  table::ImuSource imu_source() const { return registers_.imu_source(); }
  std::uint8_t torque_limit_percent() const { return registers_.torque_limit_percent(); }
  bool armed() const { return registers_.armed(); }
  table::ImuCalibrationOrder take_calibration_order();
  bool take_relax() { return registers_.take_relax(); }
  bool reply_waits() const { return sent_ < reply_size_; }
  /// The operator wants a restart; asked only with torque off.
  bool reboot_asked() const { return reboot_asked_ && sent_ == reply_size_; }

  // OperatorLink
  OperatorOrder order(std::uint32_t tick);

  // Recorder
  void record(const TickRecord& record, const State& state, const Outputs& outputs);

 private:
  static constexpr std::size_t kSlice = 64;
  static constexpr int kMostSlices = 64;  ///< more than a port can hold
  enum StatusLevel : std::uint8_t { kPingOnly = 0, kReads = 1, kAll = 2 };

  // Bytes still in the link were sent earlier: take them first.
  void withdraw_orders();
  bool push();

  // One byte can complete several packets if a false header hid them.
  void serve(bool found);
  void handle(const dxl::Packet& packet);
  dxl::Error execute(const dxl::Packet& packet);
  void ping(std::uint8_t id);
  void read(const dxl::Packet& packet);
  void show(std::uint8_t id, std::uint16_t address, std::uint16_t size);

  // Devices answer in list order, each after the one before it.
  void read_in_turn(const dxl::Packet& packet, std::uint8_t id);
  void overhear(std::uint8_t id);
  void show_fast(const dxl::ReadEntry& own, std::size_t all_bytes);
  void write_each(const dxl::Packet& packet, std::uint8_t id);
  void acknowledge(std::uint8_t asked_as, dxl::Error error);
  void reply(std::uint8_t id, dxl::Error error, const std::uint8_t* data, std::size_t size);

  hal::ByteLink& link_;
  OperatorRegisters registers_;
  dxl::Parser parser_;
  dxl::ReadEntry waiting_;  ///< sent once `before_us_` has answered
  std::uint8_t before_us_ = dxl::kBroadcast;
  bool reboot_asked_ = false;
  bool more_ = false;  ///< the parser may hold another packet
  std::size_t arrived_ = 0;
  std::size_t taken_ = 0;
  std::size_t reply_size_ = 0;
  std::size_t sent_ = 0;
  std::uint8_t inbox_[kSlice];
  std::uint8_t reply_[dxl::kMaxPacket];
};

}  // namespace verp::app
