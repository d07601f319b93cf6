#pragma once
#include <concepts>
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
template <std::derived_from<hal::ByteLink> Link, Images Store = NoImages>
class OperatorDevice {
 public:
  OperatorDevice(Link& link, const Params& params, const OperatorSetup& setup, Store& images)
      : link_(link), registers_(params, setup, images) {}
  OperatorDevice(Link& link, const Params& params,
                 const OperatorSetup& setup) requires std::same_as<Store, NoImages>
      : OperatorDevice(link, params, setup, no_images) {}

  /// Takes at most kSlice bytes from the link; nothing while part of a reply waits for room. True
  /// if there was anything to do.
  bool poll() {
    bool busy = push();
    if (more_) serve(parser_.next());
    if (sent_ < reply_size_) return busy;
    if (taken_ == arrived_) {
      taken_ = 0;
      arrived_ = link_.read(inbox_, sizeof inbox_, 0);
    }
    while (taken_ < arrived_ && sent_ == reply_size_) {
      busy = true;
      serve(parser_.push(inbox_[taken_++]));
    }
    registers_.report().link(parser_.crc_errors(), link_.errors());
    return busy;
  }

  /// Shows the bring-up's result to the operator; drops earlier orders.
  void brought_up(const BringUpReport& report) {
    registers_.report().bring_up(report);
    withdraw_orders();
  }

  void show(table::StartFault fault) { registers_.report().start_fault(fault); }

  void show(table::ServoPower power) { registers_.report().servo_power(power); }
  void show(table::ImuCalibrationState state) { registers_.report().imu_calibration(state); }

  /// Call when the twin that played the servos is silent or gone: no servo can hold torque. The
  /// operator regains what torque blocks, such as a restart, until the next tick. Orders stay.
  void servos_gone() { registers_.report().servos_gone(); }

  /// `count`: actions in the loop's library; `fault`: why stored ones are not available.
  void offer_actions(int count, action::KeptFault fault = action::KeptFault::kNone) {
    registers_.offer_actions(count, fault);
  }

  /// Call as often as the counters should refresh.
  void report(const LoopHealth& health) { registers_.report().health(health); }

  OperatorRegisters<Store>& registers() { return registers_; }

  std::uint8_t id() const { return registers_.id(); }
  table::ImuSource imu_source() const { return registers_.imu_source(); }
  std::uint8_t torque_limit_percent() const { return registers_.torque_limit_percent(); }
  bool armed() const { return registers_.armed(); }
  table::ImuCalibrationOrder take_calibration_order() {
    return registers_.take_calibration_order();
  }
  bool take_relax() { return registers_.take_relax(); }
  bool reply_waits() const { return sent_ < reply_size_; }
  /// The operator wants a restart; asked only with torque off.
  bool reboot_asked() const { return reboot_asked_ && sent_ == reply_size_; }

  // OperatorLink
  OperatorOrder order(std::uint32_t tick) {
    if (registers_.slept_until(tick)) withdraw_orders();
    return registers_.order();
  }

  // Recorder
  void record(const TickRecord& record, const State& state, const Outputs& outputs) {
    registers_.record(record, state, outputs);
  }

 private:
  static constexpr std::size_t kSlice = 64;
  static constexpr int kMostSlices = 64;  ///< more than a port can hold
  enum StatusLevel : std::uint8_t { kPingOnly = 0, kReads = 1, kAll = 2 };

  // Bytes still in the link were sent earlier: take them first.
  void withdraw_orders() {
    for (int slice = 0; slice < kMostSlices && poll(); ++slice) {
    }
    registers_.withdraw_orders();
  }

  bool push() {
    if (sent_ == reply_size_) return false;
    sent_ += link_.write(reply_ + sent_, reply_size_ - sent_, 0);
    if (!link_.connected()) sent_ = reply_size_;  // the peer is gone
    return true;
  }

  // One byte can complete several packets if a false header hid them.
  void serve(bool found) {
    for (; found; found = parser_.next()) {
      const dxl::Packet& packet = parser_.packet();
      if (packet.is_status()) {
        overhear(packet.id);
      } else {
        before_us_ = dxl::kBroadcast;
        handle(packet);
      }
      push();
      more_ = sent_ < reply_size_;
      if (more_) return;
    }
    more_ = false;
  }

  void handle(const dxl::Packet& packet) {
    const std::uint8_t id = registers_.id();
    if (packet.id != dxl::kBroadcast && packet.id != id) return;
    registers_.report().heard();
    switch (packet.instruction) {
      case dxl::Instruction::kPing:
        return ping(id);
      case dxl::Instruction::kRead:
        return read(packet);
      case dxl::Instruction::kSyncRead:
      case dxl::Instruction::kBulkRead:
      case dxl::Instruction::kFastSyncRead:
      case dxl::Instruction::kFastBulkRead:
        return read_in_turn(packet, id);
      case dxl::Instruction::kSyncWrite:
      case dxl::Instruction::kBulkWrite:
        return write_each(packet, id);
      default:
        return acknowledge(packet.id, execute(packet));
    }
  }

  dxl::Error execute(const dxl::Packet& packet) {
    constexpr std::size_t kAddressBytes = 2;
    const std::uint8_t* data = packet.parameters + kAddressBytes;
    const std::size_t size = packet.size < kAddressBytes ? 0 : packet.size - kAddressBytes;
    switch (packet.instruction) {
      case dxl::Instruction::kWrite:
        return size == 0 ? dxl::Error::kDataLength
                         : registers_.write(dxl::get_u16(packet.parameters), data, size);
      case dxl::Instruction::kRegWrite:
        return size == 0 ? dxl::Error::kDataLength
                         : registers_.reg_write(dxl::get_u16(packet.parameters), data, size);
      case dxl::Instruction::kAction:
        return registers_.action();
      case dxl::Instruction::kReboot:
        if (registers_.armed()) return dxl::Error::kResultFail;
        reboot_asked_ = true;
        return dxl::Error::kNone;
      default:
        return dxl::Error::kInstruction;
    }
  }

  void ping(std::uint8_t id) {
    std::uint8_t identity[3];
    dxl::put_u16(identity, table::kModel);
    identity[2] = table::kTableVersion;
    reply(id, dxl::Error::kNone, identity, sizeof identity);
  }

  void read(const dxl::Packet& packet) {
    if (packet.id == dxl::kBroadcast || registers_.status_level() < kReads) return;
    if (packet.size != 4) return reply(packet.id, dxl::Error::kDataLength, nullptr, 0);
    show(packet.id, dxl::get_u16(packet.parameters), dxl::get_u16(packet.parameters + 2));
  }

  void show(std::uint8_t id, std::uint16_t address, std::uint16_t size) {
    const std::uint8_t* data = registers_.read(address, size);
    if (data == nullptr) return reply(id, dxl::Error::kAccess, nullptr, 0);
    reply(id, dxl::Error::kNone, data, size);
    // Stuffing can make a reply exceed the packet limit.
    if (reply_size_ == 0) reply(id, dxl::Error::kDataLimit, nullptr, 0);
  }

  // Devices answer in list order, each after the one before it.
  void read_in_turn(const dxl::Packet& packet, std::uint8_t id) {
    if (registers_.status_level() < kReads) return;
    std::uint8_t before = dxl::kBroadcast;
    std::size_t all_bytes = 0;
    dxl::ReadEntry own, each;
    bool asked = false;
    for (std::size_t i = 0; dxl::read_entry(packet, i, each); ++i) {
      all_bytes += each.length + dxl::kFastBlockBytes;
      if (each.id == id && !asked) {
        own = each;
        asked = true;
      }
      if (!asked) before = each.id;
    }
    if (!asked) return;
    if (dxl::is_fast_read(packet.instruction)) {
      // One packet of all devices: behind others our CRC would continue theirs.
      if (before == dxl::kBroadcast) show_fast(own, all_bytes);
    } else if (before == dxl::kBroadcast) {
      show(id, own.address, own.length);
    } else {
      before_us_ = before;
      waiting_ = own;
    }
  }

  void overhear(std::uint8_t id) {
    if (before_us_ == dxl::kBroadcast || id != before_us_) return;
    before_us_ = dxl::kBroadcast;
    show(waiting_.id, waiting_.address, waiting_.length);
  }

  void show_fast(const dxl::ReadEntry& own, std::size_t all_bytes) {
    if (dxl::kFastHeaderBytes + dxl::kFastBlockBytes + own.length > sizeof reply_) return;
    const std::uint8_t* data = registers_.read(own.address, own.length);
    if (data == nullptr) return;
    std::uint16_t crc = 0;
    sent_ = 0;
    reply_size_ = dxl::encode_fast_block(reply_, true, all_bytes, own.id,
                                         dxl::error_field(dxl::Error::kNone, registers_.alert()),
                                         data, own.length, crc);
  }

  void write_each(const dxl::Packet& packet, std::uint8_t id) {
    dxl::WriteEntry entry;
    for (std::size_t offset = 0; dxl::write_entry(packet, offset, entry);) {
      if (entry.id == id) registers_.write(entry.address, entry.data, entry.size);
    }
  }

  void acknowledge(std::uint8_t asked_as, dxl::Error error) {
    if (asked_as == dxl::kBroadcast || registers_.status_level() < kAll) return;
    reply(asked_as, error, nullptr, 0);
  }

  void reply(std::uint8_t id, dxl::Error error, const std::uint8_t* data, std::size_t size) {
    sent_ = 0;
    reply_size_ = dxl::encode_status(reply_, sizeof reply_, id,
                                     dxl::error_field(error, registers_.alert()), data, size);
  }

  Link& link_;
  OperatorRegisters<Store> registers_;
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
