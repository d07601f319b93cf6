#include "host/bus/register_table.hpp"

#include <algorithm>
#include <utility>

#include "common/protocol/control_table.hpp"

namespace verp::bus {
namespace {

std::int64_t decode(const Register& reg, const std::uint8_t* bytes) {
  std::uint32_t raw = 0;
  for (int i = 0; i < reg.size; ++i) raw |= static_cast<std::uint32_t>(bytes[i]) << (8 * i);
  if (reg.minimum >= 0) return raw;
  const int unused_bits = 32 - 8 * reg.size;
  return static_cast<std::int32_t>(raw << unused_bits) >> unused_bits;
}

}  // namespace

RegisterTable::RegisterTable(std::vector<Register> registers) : registers_(std::move(registers)) {
  const Register& last = registers_.back();
  image_.resize(static_cast<std::size_t>(last.address) + last.size);
  index_.assign(image_.size(), -1);
  for (std::size_t i = 0; i < registers_.size(); ++i) {
    index_[registers_[i].address] = static_cast<std::int16_t>(i);
    set(registers_[i].address, registers_[i].initial);
  }
}

const Register* RegisterTable::find(std::uint16_t address) const {
  if (address >= index_.size() || index_[address] < 0) return nullptr;
  return &registers_[static_cast<std::size_t>(index_[address])];
}

std::int64_t RegisterTable::get(std::uint16_t address) const {
  const Register* reg = find(address);
  return reg == nullptr ? 0 : decode(*reg, image_.data() + address);
}

void RegisterTable::set(std::uint16_t address, std::int64_t value) {
  const Register* reg = find(address);
  if (reg == nullptr) return;
  for (unsigned i = 0; i < reg->size; ++i) {
    image_[address + i] = static_cast<std::uint8_t>(value >> (8 * i));
  }
}

void RegisterTable::restore_initial(std::uint16_t first, std::uint16_t end) {
  for (const Register& reg : registers_) {
    if (reg.address >= first && reg.address < end) set(reg.address, reg.initial);
  }
}

std::span<const std::uint8_t> RegisterTable::bytes(std::uint16_t address,
                                                   std::uint16_t length) const {
  if (static_cast<std::size_t>(address) + length > image_.size()) return {};
  return std::span(image_).subspan(address, length);
}

std::int64_t RegisterTable::value_in(const Register& reg, std::uint16_t address,
                                     std::span<const std::uint8_t> data) {
  return decode(reg, data.data() + (reg.address - address));
}

dxl::Error RegisterTable::check(std::uint16_t address, std::span<const std::uint8_t> data,
                                bool eeprom_locked) const {
  if (data.empty()) return dxl::Error::kDataLength;
  const std::size_t end = address + data.size();
  std::size_t at = address;
  while (at < end) {
    const Register* reg = find(static_cast<std::uint16_t>(at));
    if (reg == nullptr || !reg->writable) return dxl::Error::kAccess;
    if (eeprom_locked && at < dxl::address::kTorqueEnable) return dxl::Error::kAccess;
    if (at + reg->size > end) return dxl::Error::kDataLength;
    const std::int64_t value = value_in(*reg, address, data);
    if (value < reg->minimum || value > reg->maximum) return dxl::Error::kDataRange;
    at += reg->size;
  }
  return dxl::Error::kNone;
}

void RegisterTable::store(std::uint16_t address, std::span<const std::uint8_t> data) {
  std::copy(data.begin(), data.end(), image_.begin() + address);
}

}  // namespace verp::bus
