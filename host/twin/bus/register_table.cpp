#include "host/twin/bus/register_table.hpp"

#include <algorithm>
#include <utility>

#include "common/protocol/control_table.hpp"
#include "common/protocol/device_end.hpp"

namespace verp::bus {
namespace {

std::int64_t decode(const Register& reg, const std::uint8_t* bytes) {
  return dxl::register_value(bytes, reg.size, reg.minimum < 0);
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

void RegisterTable::copy(const RegisterTable& other, std::uint16_t first, std::uint16_t end) {
  std::copy(other.image_.begin() + first, other.image_.begin() + end, image_.begin() + first);
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
  return dxl::check_write(address, data.data(), data.size(), [&](std::uint16_t at) {
    const Register* reg = find(at);
    if (reg == nullptr) return dxl::WriteRule{};
    const bool locked = eeprom_locked && at < dxl::address::kTorqueEnable;
    return dxl::WriteRule{reg->size, reg->writable && !locked, reg->minimum, reg->maximum};
  });
}

void RegisterTable::store(std::uint16_t address, std::span<const std::uint8_t> data) {
  std::copy(data.begin(), data.end(), image_.begin() + address);
}

}  // namespace verp::bus
