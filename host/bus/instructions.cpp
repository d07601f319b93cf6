#include <utility>

#include "common/protocol/device_end.hpp"
#include "host/bus/virtual_bus.hpp"

// What each instruction of the protocol does on the bus.
namespace verp::bus {
namespace {

std::uint8_t error_field(const Device& device, dxl::Error error) {
  return dxl::error_field(error, device.alert());
}

}  // namespace

bool VirtualBus::begins_tick(const dxl::Packet& packet) {
  if (packet.id != dxl::kBroadcast) return false;
  dxl::ReadEntry each;
  for (std::size_t i = 0; dxl::read_entry(packet, i, each); ++i) {
    if (each.address <= dxl::address::kPresentPosition &&
        each.address + each.length >= dxl::address::kPresentPosition + 4) {
      return true;
    }
  }
  return false;
}

void VirtualBus::handle(const dxl::Packet& packet, std::uint64_t end_ns) {
  if (packet.is_status()) return;
  advance_plant(end_ns / 1000);
  for (const auto& each : devices_) {
    if (hears(*each)) each->heard(end_ns / 1000);
  }
  const std::span<const std::uint8_t> parameters(packet.parameters, packet.size);
  const bool has_address = packet.size > 2;
  const std::uint16_t address = has_address ? dxl::get_u16(packet.parameters) : std::uint16_t{0};
  switch (packet.instruction) {
    case dxl::Instruction::kPing:
      return ping(packet.id);
    case dxl::Instruction::kRead:
      return read(packet);
    case dxl::Instruction::kWrite:
      return command(packet.id, [&](Device& each) {
        return has_address ? each.write(address, parameters.subspan(2)) : dxl::Error::kDataLength;
      });
    case dxl::Instruction::kRegWrite:
      return command(packet.id, [&](Device& each) {
        return has_address ? each.reg_write(address, parameters.subspan(2))
                           : dxl::Error::kDataLength;
      });
    case dxl::Instruction::kAction:
      return command(packet.id, [](Device& each) { return each.action(); });
    case dxl::Instruction::kReboot:
      return command(packet.id, [](Device& each) {
        each.reboot();
        return dxl::Error::kNone;
      });
    case dxl::Instruction::kFactoryReset:
      return factory_reset(packet);
    case dxl::Instruction::kClear:
      return command(packet.id, [&](Device& each) { return each.clear(parameters); });
    case dxl::Instruction::kSyncRead:
    case dxl::Instruction::kBulkRead:
    case dxl::Instruction::kFastSyncRead:
    case dxl::Instruction::kFastBulkRead:
      return dxl::is_fast_read(packet.instruction) ? read_fast(packet) : read_each(packet);
    case dxl::Instruction::kSyncWrite:
    case dxl::Instruction::kBulkWrite:
      return write_each(packet);
    default:
      if (packet.id == dxl::kBroadcast) return;
      return command(packet.id, [](Device&) { return dxl::Error::kInstruction; });
  }
}

// A reply bears the id that the device was asked by, though it may have another one by then.
template <class Apply>
void VirtualBus::command(std::uint8_t id, Apply apply) {
  for (const auto& each : devices_) {
    if (!hears(*each) || (id != dxl::kBroadcast && id != each->id())) continue;
    const dxl::Error error = apply(*each);
    if (id == dxl::kBroadcast) continue;
    if (each->status_level() < 2) return;
    wait_us(each->return_delay_us());
    return reply(id, error_field(*each, error), {});
  }
}

void VirtualBus::ping(std::uint8_t id) {
  const int first = id == dxl::kBroadcast ? 0 : id;
  const int last = id == dxl::kBroadcast ? dxl::kMaxId : id;
  for (int i = first; i <= last; ++i) {
    Device* each = device(static_cast<std::uint8_t>(i));
    if (each == nullptr) continue;
    wait_us(each->return_delay_us());
    std::array<std::uint8_t, 3> identity{};
    dxl::put_u16(identity.data(), each->model());
    identity[2] = each->firmware_version();
    reply(each->id(), error_field(*each, dxl::Error::kNone), identity);
  }
}

void VirtualBus::read(const dxl::Packet& packet) {
  Device* target = packet.id == dxl::kBroadcast ? nullptr : device(packet.id);
  if (target == nullptr || target->status_level() < 1) return;
  wait_us(target->return_delay_us());
  std::span<const std::uint8_t> data;
  dxl::Error error = dxl::Error::kDataLength;
  if (packet.size == 4) {
    data = target->read(dxl::get_u16(packet.parameters), dxl::get_u16(packet.parameters + 2));
    error = data.empty() ? dxl::Error::kAccess : dxl::Error::kNone;
  }
  reply(packet.id, error_field(*target, error), data);
}

// To all at once, firmware 42 and above ignores the order to forget even the ids.
void VirtualBus::factory_reset(const dxl::Packet& packet) {
  const auto reset = static_cast<dxl::Reset>(packet.size == 1 ? packet.parameters[0] : 0);
  const bool known = reset == dxl::Reset::kAll || reset == dxl::Reset::kAllButId ||
                     reset == dxl::Reset::kAllButIdAndBaud;
  if (packet.id == dxl::kBroadcast && (!known || reset == dxl::Reset::kAll)) return;
  command(packet.id,
          [&](Device& each) { return known ? each.factory_reset(reset) : dxl::Error::kDataRange; });
}

void VirtualBus::read_each(const dxl::Packet& packet) {
  dxl::ReadEntry want;
  for (std::size_t i = 0; dxl::read_entry(packet, i, want); ++i) {
    Device* each = device(want.id);
    if (each == nullptr || each->status_level() < 1) return;
    wait_us(each->return_delay_us());
    const auto data = each->read(want.address, want.length);
    reply(want.id, error_field(*each, data.empty() ? dxl::Error::kAccess : dxl::Error::kNone),
          data);
  }
}

void VirtualBus::read_fast(const dxl::Packet& packet) {
  dxl::ReadEntry want;
  std::size_t all_bytes = 0;
  for (std::size_t i = 0; dxl::read_entry(packet, i, want); ++i) {
    all_bytes += want.length + dxl::kFastBlockBytes;
  }
  std::uint16_t crc = 0;
  for (std::size_t i = 0; dxl::read_entry(packet, i, want); ++i) {
    Device* each = device(want.id);
    if (each == nullptr || each->status_level() < 1 || !each->answers_fast_sync_read()) return;
    wait_us(i == 0 ? each->return_delay_us() : 0);
    const auto data = each->read(want.address, want.length);
    if (data.empty()) return;
    std::vector<std::uint8_t> block(dxl::kFastHeaderBytes + dxl::kFastBlockBytes + data.size());
    block.resize(dxl::encode_fast_block(block.data(), i == 0, all_bytes, want.id,
                                        error_field(*each, dxl::Error::kNone), data.data(),
                                        data.size(), crc));
    put_on_wire(std::move(block));
  }
}

void VirtualBus::write_each(const dxl::Packet& packet) {
  dxl::WriteEntry entry;
  for (std::size_t offset = 0; dxl::write_entry(packet, offset, entry);) {
    Device* each = device(entry.id);
    if (each != nullptr) each->write(entry.address, {entry.data, entry.size});
  }
}

}  // namespace verp::bus
