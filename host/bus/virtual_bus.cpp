#include "host/bus/virtual_bus.hpp"

#include <algorithm>
#include <utility>

#include "host/bus/sensor_device.hpp"
#include "host/bus/servo_device.hpp"

namespace verp::bus {
namespace {

constexpr std::uint64_t kBitsPerByte = 10;

bool begins_tick(const dxl::Packet& packet) {
  if (packet.id != dxl::kBroadcast || packet.size < 4) return false;
  if (packet.instruction != dxl::Instruction::kSyncRead &&
      packet.instruction != dxl::Instruction::kFastSyncRead) {
    return false;
  }
  const unsigned address = dxl::get_u16(packet.parameters);
  const unsigned end = address + dxl::get_u16(packet.parameters + 2);
  return address <= dxl::address::kPresentPosition && end >= dxl::address::kPresentPosition + 4;
}

std::uint8_t error_field(const Device& device, dxl::Error error) {
  return static_cast<std::uint8_t>(static_cast<std::uint8_t>(error) |
                                   (device.alert() ? dxl::kAlert : 0));
}

}  // namespace

VirtualBus::VirtualBus(const Params& params, sim::Plant& plant)
    : plant_(plant), period_ns_(std::uint64_t{params.period_us} * 1000), baud_(params.baud) {
  for (int j = 0; j < params.joint_count; ++j) {
    const JointParams& joint = params.joint[j];
    const ServoProfile& profile = params.servo[joint.servo_profile % kServoProfiles];
    const ServoIdentity identity{.id = joint.servo_id,
                                 .model = profile.model_number,
                                 .baud = params.baud,
                                 .fast_sync_read = profile.fast_sync_read != 0};
    devices_.push_back(std::make_unique<ServoDevice>(identity, plant, j));
  }
  if (params.imu.device_id != 0) {
    devices_.push_back(std::make_unique<ImuDevice>(params.imu.device_id, params.baud, plant));
  }
  for (int foot = 0; foot < kFeet; ++foot) {
    const std::uint8_t id = params.feet.device_id[foot];
    if (id == 0) continue;
    devices_.push_back(std::make_unique<FootDevice>(id, params.baud, plant, foot));
  }
}

std::uint64_t VirtualBus::bytes_ns(std::size_t count) const {
  return count * kBitsPerByte * 1'000'000'000u / baud_;
}

Device* VirtualBus::device(std::uint8_t id) {
  if (unplugged_[id]) return nullptr;
  for (const auto& candidate : devices_) {
    if (candidate->id() == id) return candidate.get();
  }
  return nullptr;
}

void VirtualBus::set_connected(std::uint8_t id, bool connected) {
  unplugged_[id] = !connected;
}

std::uint64_t VirtualBus::begin_tick(std::uint64_t ready_ns) {
  std::uint64_t start_ns = (ready_ns + period_ns_ - 1) / period_ns_ * period_ns_;
  if (ticking_) start_ns = std::max(start_ns, tick_start_ns_ + period_ns_);
  if (!ticking_) first_tick_ns_ = start_ns;
  ticking_ = true;
  tick_start_ns_ = start_ns;
  tick_ = static_cast<std::uint32_t>((start_ns - first_tick_ns_) / period_ns_);
  return start_ns;
}

bool VirtualBus::send(const std::uint8_t* data, std::size_t size) {
  if (size == 0 || size > hal::kMaxFrame) return false;
  std::uint64_t start_ns = std::max(now_ns_, wire_free_ns_);
  bytes_on_wire_ += size;
  for (std::size_t i = 0; i < size; ++i) {
    for (bool found = line_.push(data[i]); found; found = line_.next()) {
      if (begins_tick(line_.packet())) start_ns = begin_tick(start_ns);
      wire_free_ns_ = std::max(wire_free_ns_, start_ns + bytes_ns(i + 1));
      handle(line_.packet(), wire_free_ns_);
    }
  }
  wire_free_ns_ = std::max(wire_free_ns_, start_ns + bytes_ns(size));
  send_start_ns_ = start_ns;
  now_ns_ = std::max(now_ns_, start_ns);
  return true;
}

std::size_t VirtualBus::poll(std::uint8_t* buffer, std::size_t capacity, std::uint32_t timeout_us) {
  const std::uint64_t deadline_ns =
      std::max(now_ns_, send_start_ns_ + std::uint64_t{timeout_us} * 1000);
  std::size_t count = 0;
  while (!replies_.empty() && count < capacity) {
    Chunk& chunk = replies_.front();
    const std::uint64_t arrival_ns = chunk.start_ns + bytes_ns(chunk.taken + 1);
    if (arrival_ns > deadline_ns) break;
    buffer[count++] = chunk.bytes[chunk.taken++];
    now_ns_ = std::max(now_ns_, arrival_ns);
    if (chunk.taken == chunk.bytes.size()) replies_.pop_front();
  }
  if (count == 0 && capacity > 0) now_ns_ = deadline_ns;
  return count;
}

void VirtualBus::handle(const dxl::Packet& packet, std::uint64_t end_ns) {
  if (packet.is_status()) return;
  plant_.advance_to(end_ns / 1000);
  switch (packet.instruction) {
    case dxl::Instruction::kSyncRead:
      return sync_read(packet);
    case dxl::Instruction::kFastSyncRead:
      return fast_sync_read(packet);
    case dxl::Instruction::kSyncWrite:
      return sync_write(packet);
    case dxl::Instruction::kWrite:
      return write(packet);
    default:
      break;
  }
  if (packet.id == dxl::kBroadcast) {
    if (packet.instruction != dxl::Instruction::kPing) return;
    for (int id = 0; id <= dxl::kMaxId; ++id) {
      Device* each = device(static_cast<std::uint8_t>(id));
      if (each != nullptr) ping(*each);
    }
    return;
  }
  Device* target = device(packet.id);
  if (target == nullptr) return;
  if (packet.instruction == dxl::Instruction::kPing) {
    ping(*target);
  } else if (packet.instruction == dxl::Instruction::kRead) {
    read(*target, packet);
  } else {
    wait_for(*target);
    reply(*target, dxl::Error::kInstruction, {});
  }
}

void VirtualBus::ping(Device& device) {
  wait_for(device);
  std::array<std::uint8_t, 3> identity{};
  dxl::put_u16(identity.data(), device.model());
  identity[2] = device.firmware_version();
  reply(device, dxl::Error::kNone, identity);
}

void VirtualBus::read(Device& device, const dxl::Packet& packet) {
  if (device.status_level() < 1) return;
  wait_for(device);
  if (packet.size != 4) return reply(device, dxl::Error::kDataLength, {});
  const auto data =
      device.read(dxl::get_u16(packet.parameters), dxl::get_u16(packet.parameters + 2));
  reply(device, data.empty() ? dxl::Error::kAccess : dxl::Error::kNone, data);
}

void VirtualBus::write(const dxl::Packet& packet) {
  for (const auto& each : devices_) {
    if (unplugged_[each->id()] || (packet.id != dxl::kBroadcast && packet.id != each->id())) {
      continue;
    }
    dxl::Error error = dxl::Error::kDataLength;
    if (packet.size > 2) {
      error =
          each->write(dxl::get_u16(packet.parameters), {packet.parameters + 2, packet.size - 2});
    }
    if (packet.id == dxl::kBroadcast || each->status_level() < 2) continue;
    wait_for(*each);
    return reply(*each, error, {});
  }
}

void VirtualBus::sync_read(const dxl::Packet& packet) {
  if (packet.size < 5) return;
  const std::uint16_t address = dxl::get_u16(packet.parameters);
  const std::uint16_t length = dxl::get_u16(packet.parameters + 2);
  for (std::size_t i = 4; i < packet.size; ++i) {
    Device* each = device(packet.parameters[i]);
    if (each == nullptr || each->status_level() < 1) return;
    wait_for(*each);
    const auto data = each->read(address, length);
    reply(*each, data.empty() ? dxl::Error::kAccess : dxl::Error::kNone, data);
  }
}

void VirtualBus::fast_sync_read(const dxl::Packet& packet) {
  if (packet.size < 5) return;
  const std::uint16_t address = dxl::get_u16(packet.parameters);
  const std::uint16_t length = dxl::get_u16(packet.parameters + 2);
  const std::size_t count = packet.size - 4;
  std::uint16_t crc = 0;
  for (std::size_t i = 0; i < count; ++i) {
    Device* each = device(packet.parameters[4 + i]);
    if (each == nullptr || each->status_level() < 1 || !each->answers_fast_sync_read()) return;
    if (i == 0) wait_for(*each);
    plant_.advance_to(wire_free_ns_ / 1000);
    const auto data = each->read(address, length);
    if (data.empty()) return;
    std::vector<std::uint8_t> block(dxl::kFastHeaderBytes + dxl::kFastBlockBytes + length);
    block.resize(dxl::encode_fast_block(block.data(), i == 0, count, each->id(),
                                        error_field(*each, dxl::Error::kNone), data.data(), length,
                                        crc));
    put_on_wire(std::move(block));
  }
}

void VirtualBus::sync_write(const dxl::Packet& packet) {
  if (packet.size < 4) return;
  const std::uint16_t address = dxl::get_u16(packet.parameters);
  const std::size_t length = dxl::get_u16(packet.parameters + 2);
  for (std::size_t i = 4; i + 1 + length <= packet.size; i += 1 + length) {
    Device* each = device(packet.parameters[i]);
    if (each != nullptr) each->write(address, {packet.parameters + i + 1, length});
  }
}

void VirtualBus::wait_for(const Device& device) {
  wire_free_ns_ += std::uint64_t{device.return_delay_us()} * 1000;
  plant_.advance_to(wire_free_ns_ / 1000);
}

void VirtualBus::reply(const Device& device, dxl::Error error, std::span<const std::uint8_t> data) {
  std::vector<std::uint8_t> packet(dxl::kMaxPacket);
  packet.resize(dxl::encode_status(packet.data(), packet.size(), device.id(),
                                   error_field(device, error), data.data(), data.size()));
  put_on_wire(std::move(packet));
}

void VirtualBus::put_on_wire(std::vector<std::uint8_t> bytes) {
  if (bytes.empty()) return;
  bytes_on_wire_ += bytes.size();
  const std::uint64_t start_ns = wire_free_ns_;
  wire_free_ns_ += bytes_ns(bytes.size());
  replies_.push_back({start_ns, 0, std::move(bytes)});
}

}  // namespace verp::bus
