#include "host/twin/bus/servo_setup.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>

#include "common/protocol/control_table.hpp"
#include "common/protocol/feetech.hpp"
#include "common/protocol/feetech_table.hpp"

namespace verp::bus {
namespace {

namespace at = dxl::address;

constexpr std::uint32_t kTimeout_us = 60'000;  // 16 ms of an adapter, twice, with margin
constexpr int kPositions = 9;
constexpr std::uint8_t kAllReplies = 2;  // e-Manual, Status Return Level (68)
constexpr std::int32_t kStill = 6;       // counts, half a degree: a hand trembles

struct Setting {
  const char* name;
  std::uint16_t address;
  std::uint8_t value;
};

/// What a protocol calls these things.
struct SetupWords {
  std::span<const std::uint32_t> rates;  ///< likely ones first
  std::uint8_t (*baud_code)(std::uint32_t);
  std::uint16_t id, baud, torque, position, homing;
  std::size_t number_bytes;  ///< of position and homing
  int homing_sign;           ///< Present Position is the encoder's count plus this times homing
  std::int32_t most_homing;
  Setting answers_all;
  std::span<const Setting> settings;
};

namespace ft = feetech::address;

// e-Manual, Baud Rate (8).
constexpr std::array<std::uint32_t, 8> kRates = {dxl::kFactoryBaud, 1'000'000, 2'000'000, 115'200,
                                                 3'000'000,         4'000'000, 4'500'000, 9'600};
constexpr Setting kSettings[] = {{"status_return_level", at::kStatusReturnLevel, kAllReplies},
                                 {"torque_enable", at::kTorqueEnable, 0},
                                 {"return_delay", at::kReturnDelay, 0},
                                 // The zero and the direction depend on them.
                                 {"drive_mode", at::kDriveMode, dxl::kTimeBasedProfile},
                                 {"operating_mode", at::kOperatingMode, dxl::kPositionMode}};
constexpr SetupWords kDynamixel = {kRates,
                                   dxl::baud_rate_code,
                                   at::kId,
                                   at::kBaudRate,
                                   at::kTorqueEnable,
                                   at::kPresentPosition,
                                   at::kHomingOffset,
                                   4,
                                   1,
                                   kMostHoming,
                                   kSettings[0],
                                   kSettings};

// Lock comes first: while it is 1, EEPROM forgets. keep() sets it again.
constexpr Setting kFeetechSettings[] = {{"torque_enable", ft::kTorqueEnable, 0},
                                        {"lock", ft::kLock, 0},
                                        {"status_level", ft::kStatusLevel, 1},
                                        {"mode", ft::kMode, 0}};
constexpr SetupWords kFeetech = {feetech::kBaudRates,
                                 feetech::baud_rate_code,
                                 ft::kId,
                                 ft::kBaudRate,
                                 ft::kTorqueEnable,
                                 ft::kPresentPosition,
                                 ft::kOffset,
                                 2,
                                 -1,
                                 feetech::kMostOffset,
                                 kFeetechSettings[2],
                                 kFeetechSettings};

const SetupWords& words_of(BusProtocol protocol) {
  return protocol == BusProtocol::kFeetech ? kFeetech : kDynamixel;
}
const SetupWords& words_of(const Client& client) {
  return words_of(client.protocol());
}

std::vector<std::uint8_t> bytes_of(std::int64_t value, std::size_t size) {
  std::vector<std::uint8_t> bytes;
  for (std::size_t i = 0; i < size; ++i) {
    bytes.push_back(static_cast<std::uint8_t>(value >> (8 * i) & 0xFF));
  }
  return bytes;
}

/// Position or homing; Feetech's are magnitudes with a sign.
std::int32_t read_number(Client& client, std::uint8_t id, std::uint16_t address) {
  const std::size_t size = words_of(client).number_bytes;
  const auto bytes = client.read(id, address, static_cast<std::uint16_t>(size));
  if (client.protocol() != BusProtocol::kFeetech)
    return static_cast<std::int32_t>(dxl::get_u32(bytes.data()));
  return feetech::from_magnitude(feetech::get_u16(bytes.data()),
                                 feetech::sign_bit(static_cast<std::uint8_t>(address)));
}

/// Needs no reply: the status return level may forbid it, or the write changes it.
void tell(Client& client, std::uint8_t id, std::uint16_t address, std::uint8_t value) {
  try {
    client.write(id, address, {value});
  } catch (const DeviceError&) {  // the caller reads back
  }
}

/// Lets a Feetech servo keep what is written to its EEPROM.
void unlock(Client& client, std::uint8_t id) {
  if (client.protocol() == BusProtocol::kFeetech) tell(client, id, ft::kLock, 0);
}

void make_it_answer(Client& client, std::uint8_t id, const Changed& changed) {
  const Setting& answer = words_of(client).answers_all;
  std::uint8_t before = 0;
  try {
    before = client.read(id, answer.address, 1)[0];
  } catch (const DeviceError&) {  // 0: pings only
  }
  if (before == answer.value) return;
  unlock(client, id);
  tell(client, id, answer.address, answer.value);
  changed({answer.name, before, answer.value});
}

void keep(Client& client, std::uint8_t id) {
  if (client.protocol() == BusProtocol::kFeetech) tell(client, id, ft::kLock, 1);
}

}  // namespace

SetupLine::SetupLine(const link::Endpoint& endpoint, std::uint32_t baud, BusProtocol protocol)
    : endpoint_(endpoint), baud_(baud), protocol_(protocol) {}

Client& SetupLine::at(std::uint32_t baud) {
  const bool has_rate = endpoint_.kind == link::Endpoint::Kind::kSerial;
  if (client_ && (!has_rate || endpoint_.baud == baud)) return *client_;
  client_.reset();
  if (has_rate) endpoint_.baud = baud;
  client_.emplace(endpoint_, kTimeout_us, protocol_);
  return *client_;
}

std::vector<FoundServo> SetupLine::find(const std::function<bool()>& give_up) {
  std::vector<std::uint32_t> rates = {baud_};
  if (endpoint_.kind == link::Endpoint::Kind::kSerial) {
    for (const std::uint32_t rate : words_of(protocol_).rates) {
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
  const SetupWords& words = words_of(*client);
  const std::span<const Setting> settings = words.settings;
  if (!dry_run) make_it_answer(*client, from, changed);
  for (const Setting& each : settings) {
    const std::uint8_t before = client->read(from, each.address, 1)[0];
    if (before == each.value) continue;
    if (!dry_run) client->write(from, each.address, {each.value});
    changed({each.name, before, each.value});
  }
  if (from != id) {
    if (!dry_run) tell(*client, from, words.id, id);
    changed({"id", from, id});
    if (!dry_run && !client->ping(id)) {
      throw DeviceError(fmt::format("{}: device {} did not become {}; is it alone on the bus?",
                                    client->place(), from, id));
    }
    if (!dry_run) servo.identity.id = id;
  }
  if (servo.baud != baud) {
    if (!dry_run) tell(*client, servo.identity.id, words.baud, words.baud_code(baud));
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
  if (!dry_run) keep(*client, servo.identity.id);
}

bool is_stiff(Client& client, std::uint8_t id) {
  return client.read(id, words_of(client).torque, 1)[0] != 0;
}

std::int32_t still_position(Client& client, std::uint8_t id) {
  std::vector<std::int32_t> counts;
  for (int i = 0; i < kPositions; ++i) {
    counts.push_back(read_number(client, id, words_of(client).position));
  }
  std::sort(counts.begin(), counts.end());
  if (counts.back() - counts.front() > kStill) {
    throw DeviceError(fmt::format("device {} moves ({} to {} counts): hold the joint still", id,
                                  counts.front(), counts.back()));
  }
  return counts[kPositions / 2];
}

ZeroFix zero_fix(Client& client, std::uint8_t id, std::int32_t count, std::int32_t model_count) {
  const SetupWords& words = words_of(client);
  ZeroFix fix{.count = count, .homing_before = read_number(client, id, words.homing)};
  fix.homing_after = fix.homing_before + words.homing_sign * (model_count - count);
  fix.model_offset = count;
  fix.servo_can = fix.homing_after >= -words.most_homing && fix.homing_after <= words.most_homing;
  return fix;
}

void write_homing(Client& client, std::uint8_t id, const ZeroFix& fix) {
  const SetupWords& words = words_of(client);
  const bool feetech = client.protocol() == BusProtocol::kFeetech;
  const std::int64_t raw =
      feetech ? feetech::to_magnitude(fix.homing_after, feetech::kOffsetSign) : fix.homing_after;
  unlock(client, id);
  client.write(id, words.homing, bytes_of(raw, words.number_bytes));
  keep(client, id);
  if (read_number(client, id, words.homing) == fix.homing_after) return;
  throw DeviceError(
      fmt::format("{}: device {} does not keep its Homing Offset", client.place(), id));
}

}  // namespace verp::bus
