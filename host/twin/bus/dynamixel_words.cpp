#include "host/twin/bus/dynamixel_words.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

#include "common/protocol/device_end.hpp"
#include "host/twin/bus/sensor_device.hpp"
#include "host/twin/bus/servo_device.hpp"

namespace verp::bus {
namespace {

constexpr auto kBackup = static_cast<dxl::Instruction>(0x20);  // e-Manual: Control Table Backup
constexpr std::uint8_t kTooLong = static_cast<std::uint8_t>(dxl::Error::kDataLength);

std::uint8_t error_field(const Device& device, dxl::Error error) {
  return dxl::error_field(error, device.alert());
}

/// A device refuses a read longer than it can send.
std::vector<std::uint8_t> status(std::uint8_t id, std::uint8_t error,
                                 std::span<const std::uint8_t> data) {
  std::vector<std::uint8_t> packet(dxl::kMaxPacket);
  packet.resize(
      dxl::encode_status(packet.data(), packet.size(), id, error, data.data(), data.size()));
  if (!packet.empty()) return packet;
  return status(id, static_cast<std::uint8_t>((error & dxl::kAlert) | int{kTooLong}), {});
}

/// A Secondary ID cannot write the EEPROM.
bool in_ram(std::uint16_t address) {
  return address >= dxl::address::kTorqueEnable;
}

}  // namespace

bool DynamixelWords::begins_tick(const dxl::Packet& packet) {
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

bool DynamixelWords::begins_tick(std::span<const std::uint8_t> frame) const {
  dxl::Parser parser;
  return std::any_of(frame.begin(), frame.end(), [&](std::uint8_t byte) {
    return parser.push(byte) && begins_tick(parser.packet());
  });
}

/// Up to the next header, which only occurs at the start of a packet.
std::size_t DynamixelWords::frame_size(std::span<const std::uint8_t> bytes) const {
  const auto next =
      std::search(bytes.begin() + 1, bytes.end(), std::begin(dxl::kHeader), std::end(dxl::kHeader));
  return std::min(static_cast<std::size_t>(next - bytes.begin()), hal::kMaxFrame);
}

void DynamixelWords::watch_header(std::uint8_t byte) {
  constexpr std::uint32_t kHeaderWord = 0xFFFFFD00;  // byte stuffing keeps it out of packets
  last_four_ = last_four_ << 8 | byte;
  if (last_four_ != kHeaderWord) return;
  parser_.reset();
  for (std::size_t j = 0; j + 1 < sizeof dxl::kHeader; ++j) parser_.push(dxl::kHeader[j]);
}

std::vector<Device*> DynamixelWords::devices(std::uint8_t id) const {
  std::vector<Device*> all;
  for (Device* candidate : devices_) {
    if (candidate->id() == id && line_.hears(*candidate)) all.push_back(candidate);
  }
  return all;
}

void DynamixelWords::handle(std::uint64_t end_ns) {
  const dxl::Packet& packet = parser_.packet();
  if (packet.is_status()) return;
  line_.request_ended(end_ns);
  const std::span<const std::uint8_t> parameters(packet.parameters, packet.size);
  const bool has_address = packet.size > 2;
  const std::uint16_t address = has_address ? dxl::get_u16(packet.parameters) : std::uint16_t{0};
  if (packet.instruction == kBackup) {
    return command(packet.id, false, [&](Device& each) { return each.backup(parameters); });
  }
  switch (packet.instruction) {
    case dxl::Instruction::kPing:
      return ping(packet.id);
    case dxl::Instruction::kRead:
      return read(packet);
    case dxl::Instruction::kWrite:
      return command(packet.id, in_ram(address), [&](Device& each) {
        return has_address ? each.write(address, parameters.subspan(2)) : dxl::Error::kDataLength;
      });
    case dxl::Instruction::kRegWrite:
      return command(packet.id, in_ram(address), [&](Device& each) {
        return has_address ? each.reg_write(address, parameters.subspan(2))
                           : dxl::Error::kDataLength;
      });
    case dxl::Instruction::kAction:
      return command(packet.id, true, [](Device& each) { return each.action(); });
    case dxl::Instruction::kReboot:
      return command(packet.id, true, [](Device& each) {
        each.reboot();
        return dxl::Error::kNone;
      });
    case dxl::Instruction::kFactoryReset:
      return factory_reset(packet);
    case dxl::Instruction::kClear:
      return command(packet.id, true, [&](Device& each) { return each.clear(parameters); });
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
      return command(packet.id, false, [](Device&) { return dxl::Error::kInstruction; });
  }
}

// A reply carries the id of the request, even after the write changed it.
template <class Apply>
void DynamixelWords::command(std::uint8_t id, bool for_group, Apply apply) {
  std::vector<Device*> speakers;
  std::vector<dxl::Error> errors;
  for (Device* each : devices_) {
    if (!line_.hears(*each)) continue;
    const bool asked = id == each->id();
    if (!asked && id != dxl::kBroadcast && !(for_group && each->in_group(id))) continue;
    const dxl::Error error = apply(*each);
    if (!asked || each->status_level() < 2) continue;
    speakers.push_back(each);
    errors.push_back(error);
  }
  std::size_t next = 0;
  line_.speak(speakers, false, [&](const Device& each) {
    return status(id, error_field(each, errors[next++]), {});
  });
}

void DynamixelWords::identify(std::uint8_t id) {
  line_.speak(devices(id), false, [id](const Device& each) {
    std::array<std::uint8_t, 3> identity{};
    dxl::put_u16(identity.data(), each.model());
    identity[2] = each.firmware_version();
    return status(id, error_field(each, dxl::Error::kNone), identity);
  });
}

// In the order of their ids (e-Manual), 3 ms apart as in the vendor's SDK. Dynamixel2Arduino issue
// 106: with a 10 ms wait, ids 1 and 2 are found and id 5 is not.
void DynamixelWords::ping(std::uint8_t id) {
  if (id != dxl::kBroadcast) return identify(id);
  const std::uint64_t end_ns = line_.wire_free_ns();
  for (int i = 0; i <= dxl::kMaxId; ++i) {
    const auto each = static_cast<std::uint8_t>(i);
    if (devices(each).empty()) continue;
    const std::uint64_t slot_ns = end_ns + std::uint64_t{each} * dxl::kPingSlot_us * 1000;
    line_.hold_wire_until(slot_ns);
    identify(each);
  }
}

void DynamixelWords::read(const dxl::Packet& packet) {
  if (packet.id == dxl::kBroadcast) return;
  std::vector<Device*> speakers = devices(packet.id);
  std::erase_if(speakers, [](const Device* each) { return each->status_level() < 1; });
  line_.speak(speakers, false, [&](Device& each) {
    std::span<const std::uint8_t> data;
    dxl::Error error = dxl::Error::kDataLength;
    if (packet.size == 4) {
      line_.advance_to_answer();
      data = each.read(dxl::get_u16(packet.parameters), dxl::get_u16(packet.parameters + 2));
      error = data.empty() ? dxl::Error::kAccess : dxl::Error::kNone;
    }
    return status(packet.id, error_field(each, error), data);
  });
}

// Firmware 42 and above ignores a broadcast reset of ids.
void DynamixelWords::factory_reset(const dxl::Packet& packet) {
  const auto reset = static_cast<dxl::Reset>(packet.size == 1 ? packet.parameters[0] : 0);
  const bool known = reset == dxl::Reset::kAll || reset == dxl::Reset::kAllButId ||
                     reset == dxl::Reset::kAllButIdAndBaud;
  if (packet.id == dxl::kBroadcast && (!known || reset == dxl::Reset::kAll)) return;
  command(packet.id, false,
          [&](Device& each) { return known ? each.factory_reset(reset) : dxl::Error::kDataRange; });
}

void DynamixelWords::read_each(const dxl::Packet& packet) {
  dxl::ReadEntry want;
  for (std::size_t i = 0; dxl::read_entry(packet, i, want); ++i) {
    std::vector<Device*> speakers = devices(want.id);
    std::erase_if(speakers, [](const Device* each) { return each->status_level() < 1; });
    if (speakers.empty()) return;
    line_.speak(speakers, false, [&](Device& each) {
      line_.advance_to_answer();
      const auto data = each.read(want.address, want.length);
      const dxl::Error error = data.empty() ? dxl::Error::kAccess : dxl::Error::kNone;
      return status(want.id, error_field(each, error), data);
    });
  }
}

void DynamixelWords::read_fast(const dxl::Packet& packet) {
  dxl::ReadEntry want;
  std::size_t all_bytes = 0;
  for (std::size_t i = 0; dxl::read_entry(packet, i, want); ++i) {
    all_bytes += want.length + dxl::kFastBlockBytes;
  }
  std::uint16_t crc = 0;
  for (std::size_t i = 0; dxl::read_entry(packet, i, want); ++i) {
    const std::vector<Device*> speakers = devices(want.id);
    const bool all_can = std::all_of(speakers.begin(), speakers.end(), [](const Device* each) {
      return each->status_level() > 0 && each->answers_fast_sync_read();
    });
    if (speakers.empty() || !all_can) return;
    const std::uint16_t crc_before = crc;
    bool told = false;
    line_.speak(speakers, i > 0, [&](Device& each) {
      line_.advance_to_answer();
      const auto data = each.read(want.address, want.length);
      std::vector<std::uint8_t> block(dxl::kFastHeaderBytes + dxl::kFastBlockBytes + data.size());
      crc = crc_before;
      block.resize(dxl::encode_fast_block(block.data(), i == 0, all_bytes, want.id,
                                          error_field(each, dxl::Error::kNone), data.data(),
                                          data.size(), crc));
      told = !data.empty();
      return told ? block : std::vector<std::uint8_t>{};
    });
    if (!told) return;
  }
}

void DynamixelWords::write_each(const dxl::Packet& packet) {
  dxl::WriteEntry entry;
  for (std::size_t offset = 0; dxl::write_entry(packet, offset, entry);) {
    for (Device* each : devices(entry.id)) each->write(entry.address, {entry.data, entry.size});
  }
}

SpokenBus make_dynamixel_bus(const Params& params, sim::Plant& plant, VirtualBus& line) {
  auto words = std::make_unique<DynamixelWords>(line);
  SpokenBus spoken;
  const auto add = [&](std::unique_ptr<Device> device) {
    words->add(*device);
    spoken.devices.push_back(std::move(device));
  };
  for (int j = 0; j < params.servo_count(); ++j) {
    const JointParams& joint = params.joint[j];
    const ServoProfile& profile = params.servo[joint.servo_profile % kServoProfiles];
    const ServoIdentity identity{.id = joint.servo_id,
                                 .model = profile.model_number,
                                 .baud = params.baud,
                                 .fast_sync_read = profile.fast_sync_read != 0,
                                 .rating = plant.rating(j)};
    add(std::make_unique<ServoDevice>(identity, plant, j));
  }
  if (params.imu.device_id != 0) {
    add(std::make_unique<ImuDevice>(params.imu.device_id, params.baud, plant));
  }
  for (int foot = 0; foot < kFeet; ++foot) {
    const std::uint8_t id = params.feet.device_id[foot];
    if (id != 0) add(std::make_unique<FootDevice>(id, params.baud, plant, foot));
  }
  spoken.words = std::move(words);
  return spoken;
}

}  // namespace verp::bus
