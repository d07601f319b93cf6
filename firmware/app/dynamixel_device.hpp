#pragma once
#include <cstddef>
#include <cstdint>

#include "common/protocol/device_end.hpp"
#include "common/protocol/dynamixel2.hpp"
#include "hal/contract/byte_link.hpp"

namespace verp::app {

/// A Dynamixel device at a ByteLink. Nothing waits: poll() serves the link. Single context.
///
/// Answers Ping, Read, Write, Reg Write, Action, Sync, Bulk and fast reads, Sync and Bulk Write and
/// Reboot; others give the Instruction Error.
///
/// Requests are executed and answered in order. One gets no answer: a read or Ping when the next
/// request is one too and is whole in the link before the answer began to leave. Its master has
/// asked again, and would take the older answer for the newer one. So a master may send writes and
/// one read together and count the answers (OperatorPort), and several reads with a write before
/// each (TickPort), but not two reads in a row.
///
/// Registers (OperatorRegisters, SensorRegisters):
///  - id(), model(), version(), status_level(), alert(), armed()
///  - read(address, size): the bytes, or nullptr; write(), reg_write(), action(): all or an error
///  - answers_after(time_us): an answer was made, to leave so long after its request and the return
///    delay; holds(): it is too early. Another request drops an answer that is held.
///  - heard(): of each request to this device; link(): counters
template <class Registers>
class DynamixelDevice {
 public:
  /// Takes at most kSlice bytes from the link; nothing while half a reply waits for room. True if
  /// there was anything to do.
  bool poll();

  Registers& registers() { return registers_; }
  bool reply_waits() const { return reply_size_ > 0; }
  /// A master wants a restart; asked only with torque off.
  bool reboot_asked() const { return reboot_asked_ && !reply_waits(); }

 protected:
  template <class... Arguments>
  explicit DynamixelDevice(hal::ByteLink& link, Arguments&&... arguments)
      : link_(link), registers_(static_cast<Arguments&&>(arguments)...) {}

  hal::ByteLink& link_;
  Registers registers_;

 private:
  static constexpr std::size_t kSlice = 64;
  enum StatusLevel : std::uint8_t { kPingOnly = 0, kReads = 1, kAll = 2 };

  void push();
  // False: an earlier answer must leave first.
  bool take(const dxl::Packet& packet);
  void handle(const dxl::Packet& packet);
  dxl::Error execute(const dxl::Packet& packet);
  void ping(std::uint8_t id, bool all);
  void read(const dxl::Packet& packet);
  void show(std::uint8_t id, std::uint16_t address, std::uint16_t size);

  // Devices answer in list order, each after the one before it.
  void read_in_turn(const dxl::Packet& packet, std::uint8_t id);
  void overhear(std::uint8_t id);
  void show_fast(const dxl::ReadEntry& own, std::size_t all_bytes);
  void write_each(const dxl::Packet& packet, std::uint8_t id);
  void acknowledge(std::uint8_t asked_as, dxl::Error error);
  void reply(std::uint8_t id, dxl::Error error, const std::uint8_t* data, std::size_t size);

  dxl::Parser parser_;
  dxl::ReadEntry waiting_;  ///< sent once `before_us_` has answered
  std::uint8_t before_us_ = dxl::kBroadcast;
  bool reboot_asked_ = false;
  bool found_ = false;         ///< the parser's packet waits
  bool answers_read_ = false;  ///< so does the reply
  std::size_t arrived_ = 0;
  std::size_t taken_ = 0;
  std::size_t reply_size_ = 0;  ///< 0: no reply waits
  std::size_t sent_ = 0;        ///< of the reply that waits; 0 if none does
  std::uint8_t inbox_[kSlice];
  std::uint8_t reply_[dxl::kMaxPacket];
};

template <class Registers>
bool DynamixelDevice<Registers>::poll() {
  if (sent_ > 0) push();
  if (sent_ > 0) return true;
  bool busy = reply_waits();
  if (taken_ == arrived_) {
    taken_ = 0;
    arrived_ = link_.read(inbox_, sizeof inbox_, 0);
  }
  for (;;) {
    // One byte can complete several packets if a false header hid them.
    while (found_ && take(parser_.packet())) found_ = parser_.next();
    if (found_ || taken_ == arrived_) break;
    found_ = parser_.push(inbox_[taken_++]);
    busy = true;
  }
  if (arrived_ < kSlice) push();  // a full inbox: the link may hold a newer request
  registers_.link(parser_.crc_errors(), link_.errors());
  return busy;
}

template <class Registers>
void DynamixelDevice<Registers>::push() {
  if (!reply_waits() || registers_.holds()) return;
  sent_ += link_.write(reply_ + sent_, reply_size_ - sent_, 0);
  // Without connection the peer is gone.
  if (sent_ == reply_size_ || !link_.connected()) sent_ = reply_size_ = 0;
}

template <class Registers>
bool DynamixelDevice<Registers>::take(const dxl::Packet& packet) {
  if (packet.is_status()) {
    overhear(packet.id);
    return true;
  }
  const bool read = dxl::is_read(packet.instruction);
  if (sent_ == 0 && (registers_.holds() || (read && answers_read_))) reply_size_ = 0;
  push();
  if (reply_waits()) return false;
  before_us_ = dxl::kBroadcast;
  answers_read_ = read;
  handle(packet);
  return true;
}

template <class Registers>
void DynamixelDevice<Registers>::handle(const dxl::Packet& packet) {
  const std::uint8_t id = registers_.id();
  if (packet.id != dxl::kBroadcast && packet.id != id) return;
  registers_.heard();
  using dxl::Instruction;
  const Instruction asked = packet.instruction;
  if (asked == Instruction::kPing) return ping(id, packet.id == dxl::kBroadcast);
  if (asked == Instruction::kRead) return read(packet);
  if (answers_read_) return read_in_turn(packet, id);
  if (asked == Instruction::kSyncWrite || asked == Instruction::kBulkWrite) {
    return write_each(packet, id);
  }
  acknowledge(packet.id, execute(packet));
}

template <class Registers>
dxl::Error DynamixelDevice<Registers>::execute(const dxl::Packet& packet) {
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

template <class Registers>
void DynamixelDevice<Registers>::ping(std::uint8_t id, bool all) {
  std::uint8_t identity[3];
  dxl::put_u16(identity, registers_.model());
  identity[2] = registers_.version();
  reply(id, dxl::Error::kNone, identity, sizeof identity);
  if (all) registers_.answers_after(id * dxl::kPingSlot_us);
}

template <class Registers>
void DynamixelDevice<Registers>::read(const dxl::Packet& packet) {
  if (packet.id == dxl::kBroadcast || registers_.status_level() < kReads) return;
  if (packet.size != 4) return reply(packet.id, dxl::Error::kDataLength, nullptr, 0);
  show(packet.id, dxl::get_u16(packet.parameters), dxl::get_u16(packet.parameters + 2));
}

template <class Registers>
void DynamixelDevice<Registers>::show(std::uint8_t id, std::uint16_t address, std::uint16_t size) {
  const std::uint8_t* data = registers_.read(address, size);
  if (data == nullptr) return reply(id, dxl::Error::kAccess, nullptr, 0);
  reply(id, dxl::Error::kNone, data, size);
  // Stuffing can make a reply exceed the packet limit.
  if (reply_size_ == 0) reply(id, dxl::Error::kDataLimit, nullptr, 0);
}

template <class Registers>
void DynamixelDevice<Registers>::read_in_turn(const dxl::Packet& packet, std::uint8_t id) {
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

template <class Registers>
void DynamixelDevice<Registers>::overhear(std::uint8_t id) {
  if (before_us_ == dxl::kBroadcast || id != before_us_) return;
  before_us_ = dxl::kBroadcast;
  show(waiting_.id, waiting_.address, waiting_.length);
}

template <class Registers>
void DynamixelDevice<Registers>::show_fast(const dxl::ReadEntry& own, std::size_t all_bytes) {
  if (dxl::kFastHeaderBytes + dxl::kFastBlockBytes + own.length > sizeof reply_) return;
  const std::uint8_t* data = registers_.read(own.address, own.length);
  if (data == nullptr) return;
  std::uint16_t crc = 0;
  reply_size_ = dxl::encode_fast_block(reply_, true, all_bytes, own.id,
                                       dxl::error_field(dxl::Error::kNone, registers_.alert()),
                                       data, own.length, crc);
  registers_.answers_after(0);
}

template <class Registers>
void DynamixelDevice<Registers>::write_each(const dxl::Packet& packet, std::uint8_t id) {
  dxl::WriteEntry entry;
  for (std::size_t offset = 0; dxl::write_entry(packet, offset, entry);) {
    if (entry.id == id) registers_.write(entry.address, entry.data, entry.size);
  }
}

template <class Registers>
void DynamixelDevice<Registers>::acknowledge(std::uint8_t asked_as, dxl::Error error) {
  if (asked_as == dxl::kBroadcast || registers_.status_level() < kAll) return;
  reply(asked_as, error, nullptr, 0);
}

template <class Registers>
void DynamixelDevice<Registers>::reply(std::uint8_t id, dxl::Error error, const std::uint8_t* data,
                                       std::size_t size) {
  reply_size_ = dxl::encode_status(reply_, sizeof reply_, id,
                                   dxl::error_field(error, registers_.alert()), data, size);
  registers_.answers_after(0);
}

}  // namespace verp::app
