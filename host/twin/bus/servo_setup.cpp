#include "host/twin/bus/servo_setup.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "common/protocol/control_table.hpp"

namespace verp::bus {
namespace {

namespace at = dxl::address;

constexpr std::uint32_t kTimeout_us = 60'000;  // 16 ms of an adapter, twice, with margin
constexpr int kPositions = 9;
constexpr std::uint8_t kAllReplies = 2;  // e-Manual, Status Return Level (68)
constexpr std::int32_t kStill = 6;       // counts, half a degree: a hand trembles

/// All servo baud rates (e-Manual, Baud Rate (8)), likely ones first.
constexpr std::array<std::uint32_t, 8> kRates = {dxl::kFactoryBaud, 1'000'000, 2'000'000, 115'200,
                                                 3'000'000,         4'000'000, 4'500'000, 9'600};

std::vector<std::uint8_t> bytes_of(std::int64_t value, std::size_t size) {
  std::vector<std::uint8_t> bytes;
  for (std::size_t i = 0; i < size; ++i) {
    bytes.push_back(static_cast<std::uint8_t>(value >> (8 * i) & 0xFF));
  }
  return bytes;
}

std::int32_t read_i32(Client& client, std::uint8_t id, std::uint16_t address) {
  return static_cast<std::int32_t>(dxl::get_u32(client.read(id, address, 4).data()));
}

/// Needs no reply: the status return level may forbid it, or the write changes it.
void tell(Client& client, std::uint8_t id, std::uint16_t address, std::uint8_t value) {
  try {
    client.write(id, address, {value});
  } catch (const DeviceError&) {  // the caller reads back
  }
}

void make_it_answer(Client& client, std::uint8_t id, const Changed& changed) {
  std::uint8_t before = 0;
  try {
    before = client.read(id, at::kStatusReturnLevel, 1)[0];
  } catch (const DeviceError&) {  // 0: pings only
  }
  if (before == kAllReplies) return;
  tell(client, id, at::kStatusReturnLevel, kAllReplies);
  changed({"status_return_level", before, kAllReplies});
}

struct Setting {
  const char* name;
  std::uint16_t address;
  std::uint8_t value;
};

}  // namespace

SetupLine::SetupLine(const link::Endpoint& endpoint, std::uint32_t baud)
    : endpoint_(endpoint), baud_(baud) {}

Client& SetupLine::at(std::uint32_t baud) {
  const bool has_rate = endpoint_.kind == link::Endpoint::Kind::kSerial;
  if (client_ && (!has_rate || endpoint_.baud == baud)) return *client_;
  client_.reset();
  if (has_rate) endpoint_.baud = baud;
  client_.emplace(endpoint_, kTimeout_us);
  return *client_;
}

std::vector<FoundServo> SetupLine::find(const std::function<bool()>& give_up) {
  std::vector<std::uint32_t> rates = {baud_};
  if (endpoint_.kind == link::Endpoint::Kind::kSerial) {
    for (const std::uint32_t rate : kRates) {
      if (rate != baud_) rates.push_back(rate);
    }
  }
  std::vector<FoundServo> found;
  for (const std::uint32_t rate : rates) {
    if (give_up()) break;
    try {
      for (const Identity& each : at(rate).scan()) found.push_back({each, rate});
    } catch (const link::LinkError& error) {
      if (error.kind() != link::LinkError::Kind::kUnsuitable || rate == baud_) throw;
      continue;  // not supported by the adapter
    }
    if (!found.empty()) break;
  }
  return found;
}

void configure(SetupLine& line, FoundServo& servo, std::uint8_t id, std::uint32_t baud,
               bool dry_run, const Changed& changed) {
  Client* client = &line.at(servo.baud);
  const std::uint8_t from = servo.identity.id;
  const Setting settings[] = {{"status_return_level", at::kStatusReturnLevel, kAllReplies},
                              {"torque_enable", at::kTorqueEnable, 0},
                              {"return_delay", at::kReturnDelay, 0},
                              // The zero and the direction depend on them.
                              {"drive_mode", at::kDriveMode, dxl::kTimeBasedProfile},
                              {"operating_mode", at::kOperatingMode, dxl::kPositionMode}};
  if (!dry_run) make_it_answer(*client, from, changed);
  for (const Setting& each : settings) {
    const std::uint8_t before = client->read(from, each.address, 1)[0];
    if (before == each.value) continue;
    if (!dry_run) client->write(from, each.address, {each.value});
    changed({each.name, before, each.value});
  }
  if (from != id) {
    if (!dry_run) tell(*client, from, at::kId, id);
    changed({"id", from, id});
    if (!dry_run && !client->ping(id)) {
      throw DeviceError(fmt::format("{}: device {} did not become {}; is it alone on the bus?",
                                    client->place(), from, id));
    }
    if (!dry_run) servo.identity.id = id;
  }
  if (servo.baud != baud) {
    if (!dry_run) tell(*client, servo.identity.id, at::kBaudRate, dxl::baud_rate_code(baud));
    changed({"baud", servo.baud, baud});
    if (dry_run) return;
    client = &line.at(baud);
    if (!client->ping(servo.identity.id)) {
      throw DeviceError(fmt::format("{}: device {} does not answer at {} baud, to which it was set",
                                    client->place(), servo.identity.id, baud));
    }
    servo.baud = baud;
  }
  for (const Setting& each : settings) {
    if (dry_run || client->read(servo.identity.id, each.address, 1)[0] == each.value) continue;
    throw DeviceError(fmt::format("{}: device {} does not keep {}", client->place(),
                                  servo.identity.id, each.name));
  }
}

std::int32_t still_position(Client& client, std::uint8_t id) {
  std::vector<std::int32_t> counts;
  for (int i = 0; i < kPositions; ++i) counts.push_back(read_i32(client, id, at::kPresentPosition));
  std::sort(counts.begin(), counts.end());
  if (counts.back() - counts.front() > kStill) {
    throw DeviceError(fmt::format("device {} moves ({} to {} counts): hold the joint still", id,
                                  counts.front(), counts.back()));
  }
  return counts[kPositions / 2];
}

ZeroFix zero_fix(Client& client, std::uint8_t id, std::int32_t count, std::int32_t model_count) {
  ZeroFix fix{.count = count, .homing_before = read_i32(client, id, at::kHomingOffset)};
  // e-Manual: Present Position is the encoder's count plus Homing Offset.
  fix.homing_after = fix.homing_before + model_count - count;
  fix.model_offset = count;
  fix.servo_can = fix.homing_after >= -kMostHoming && fix.homing_after <= kMostHoming;
  return fix;
}

void write_homing(Client& client, std::uint8_t id, const ZeroFix& fix) {
  client.write(id, at::kHomingOffset, bytes_of(fix.homing_after, 4));
  if (read_i32(client, id, at::kHomingOffset) == fix.homing_after) return;
  throw DeviceError(
      fmt::format("{}: device {} does not keep its Homing Offset", client.place(), id));
}

}  // namespace verp::bus
