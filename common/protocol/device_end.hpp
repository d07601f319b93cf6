#pragma once
#include <cstddef>
#include <cstdint>

#include "common/protocol/dynamixel2.hpp"

/// The device side of Protocol 2.0, common to all devices. Rules from the e-Manual.
namespace verp::dxl {

/// Answers to a Ping to all are so far apart, by id: the vendor's SDK waits so long for each.
inline constexpr std::uint32_t kPingSlot_us = 3000;

/// One device's part of a Sync or Bulk Read.
struct ReadEntry {
  std::uint8_t id = 0;
  std::uint16_t address = 0;
  std::uint16_t length = 0;
};
/// Entry `index`, in order of the answers. False if there is none, or the packet is malformed or of
/// another kind.
bool read_entry(const Packet& packet, std::size_t index, ReadEntry& entry);

/// One device's part of a Sync or Bulk Write.
struct WriteEntry {
  std::uint8_t id = 0;
  std::uint16_t address = 0;
  const std::uint8_t* data = nullptr;
  std::size_t size = 0;
};
/// The entry at `offset`, from 0; advances it. False if there are no more, or the packet is of
/// another kind.
bool write_entry(const Packet& packet, std::size_t& offset, WriteEntry& entry);

/// Ping, Read, and the reads of several devices: requests that change nothing. In a firmware image
/// the codes' bits take less room than a list.
constexpr bool is_read(Instruction instruction) {
  const auto code = static_cast<unsigned>(instruction);
  return code <= 0x02 || (code & 0xE7) == 0x82;
}

constexpr bool is_fast_read(Instruction instruction) {
  return instruction == Instruction::kFastSyncRead || instruction == Instruction::kFastBulkRead;
}

constexpr std::uint8_t error_field(Error error, bool alert) {
  return static_cast<std::uint8_t>(static_cast<unsigned>(error) | (alert ? kAlert : 0u));
}

/// `size` is 1 to 4.
constexpr std::int64_t register_value(const std::uint8_t* bytes, unsigned size, bool is_signed) {
  std::uint32_t raw = 0;
  for (unsigned i = 0; i < size; ++i) raw |= static_cast<std::uint32_t>(bytes[i]) << (8 * i);
  if (!is_signed) return raw;
  const unsigned unused_bits = 32 - 8 * size;
  return static_cast<std::int32_t>(raw << unused_bits) >> unused_bits;
}

struct WriteRule {
  std::uint8_t size = 0;  ///< bytes of the register that begins there; 0: none
  bool writable = false;
  std::int64_t minimum = 0;  ///< a negative one makes the register signed
  std::int64_t maximum = 0;
};

/// kNone if the bytes cover whole, writable registers with values in range. `rule_at(address)`
/// returns the present WriteRule.
template <class RuleAt>
constexpr Error check_write(std::uint16_t address, const std::uint8_t* data, std::size_t size,
                            RuleAt&& rule_at) {
  if (size == 0) return Error::kDataLength;
  for (std::size_t i = 0; i < size;) {
    const std::size_t at = address + i;
    const WriteRule rule = at > 0xFFFF ? WriteRule{} : rule_at(static_cast<std::uint16_t>(at));
    if (rule.size == 0 || !rule.writable) return Error::kAccess;
    if (i + rule.size > size) return Error::kDataLength;
    const std::int64_t value = register_value(data + i, rule.size, rule.minimum < 0);
    if (value < rule.minimum || value > rule.maximum) return Error::kDataRange;
    i += rule.size;
  }
  return Error::kNone;
}

}  // namespace verp::dxl
