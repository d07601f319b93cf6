#include "firmware/app/operator_device.hpp"

namespace verp::app {

bool OperatorDevice::poll() {
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

void OperatorDevice::brought_up(const BringUpReport& report) {
  registers_.report().bring_up(report);
  withdraw_orders();
}

void OperatorDevice::offer_actions(int count, action::KeptFault fault) {
  registers_.offer_actions(count, fault);
}

table::ImuCalibrationOrder OperatorDevice::take_calibration_order() {
  return registers_.take_calibration_order();
}

OperatorOrder OperatorDevice::order(std::uint32_t tick) {
  if (registers_.slept_until(tick)) withdraw_orders();
  return registers_.order();
}

void OperatorDevice::record(const TickRecord& record, const State& state, const Outputs& outputs) {
  registers_.record(record, state, outputs);
}

void OperatorDevice::withdraw_orders() {
  for (int slice = 0; slice < kMostSlices && poll(); ++slice) {
  }
  registers_.withdraw_orders();
}

bool OperatorDevice::push() {
  if (sent_ == reply_size_) return false;
  sent_ += link_.write(reply_ + sent_, reply_size_ - sent_, 0);
  if (!link_.connected()) sent_ = reply_size_;  // the peer is gone
  return true;
}

void OperatorDevice::serve(bool found) {
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

void OperatorDevice::handle(const dxl::Packet& packet) {
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

dxl::Error OperatorDevice::execute(const dxl::Packet& packet) {
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

void OperatorDevice::ping(std::uint8_t id) {
  std::uint8_t identity[3];
  dxl::put_u16(identity, table::kModel);
  identity[2] = table::kTableVersion;
  reply(id, dxl::Error::kNone, identity, sizeof identity);
}

void OperatorDevice::read(const dxl::Packet& packet) {
  if (packet.id == dxl::kBroadcast || registers_.status_level() < kReads) return;
  if (packet.size != 4) return reply(packet.id, dxl::Error::kDataLength, nullptr, 0);
  show(packet.id, dxl::get_u16(packet.parameters), dxl::get_u16(packet.parameters + 2));
}

void OperatorDevice::show(std::uint8_t id, std::uint16_t address, std::uint16_t size) {
  const std::uint8_t* data = registers_.read(address, size);
  if (data == nullptr) return reply(id, dxl::Error::kAccess, nullptr, 0);
  reply(id, dxl::Error::kNone, data, size);
  // Stuffing can make a reply exceed the packet limit.
  if (reply_size_ == 0) reply(id, dxl::Error::kDataLimit, nullptr, 0);
}

void OperatorDevice::read_in_turn(const dxl::Packet& packet, std::uint8_t id) {
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

void OperatorDevice::overhear(std::uint8_t id) {
  if (before_us_ == dxl::kBroadcast || id != before_us_) return;
  before_us_ = dxl::kBroadcast;
  show(waiting_.id, waiting_.address, waiting_.length);
}

void OperatorDevice::show_fast(const dxl::ReadEntry& own, std::size_t all_bytes) {
  if (dxl::kFastHeaderBytes + dxl::kFastBlockBytes + own.length > sizeof reply_) return;
  const std::uint8_t* data = registers_.read(own.address, own.length);
  if (data == nullptr) return;
  std::uint16_t crc = 0;
  sent_ = 0;
  reply_size_ = dxl::encode_fast_block(reply_, true, all_bytes, own.id,
                                       dxl::error_field(dxl::Error::kNone, registers_.alert()),
                                       data, own.length, crc);
}

void OperatorDevice::write_each(const dxl::Packet& packet, std::uint8_t id) {
  dxl::WriteEntry entry;
  for (std::size_t offset = 0; dxl::write_entry(packet, offset, entry);) {
    if (entry.id == id) registers_.write(entry.address, entry.data, entry.size);
  }
}

void OperatorDevice::acknowledge(std::uint8_t asked_as, dxl::Error error) {
  if (asked_as == dxl::kBroadcast || registers_.status_level() < kAll) return;
  reply(asked_as, error, nullptr, 0);
}

void OperatorDevice::reply(std::uint8_t id, dxl::Error error, const std::uint8_t* data,
                           std::size_t size) {
  sent_ = 0;
  reply_size_ = dxl::encode_status(reply_, sizeof reply_, id,
                                   dxl::error_field(error, registers_.alert()), data, size);
}

}  // namespace verp::app
