#include "host/twin/imu/bno055_model.hpp"

namespace verp::imu {

Bno055Model::Bno055Model() {
  reset(0);
  ready_us_ = 0;
}

void Bno055Model::reset(std::uint64_t now_us) {
  constexpr std::uint64_t kReset_us = 650'000;
  registers_ = {};
  registers_[0][kUnits] = 0x80;
  registers_[0][kAxisMap] = 0x24;
  registers_[1][0x08] = 0x0D;
  registers_[1][0x0A] = 0x38;
  page_ = 0;
  switch_us_ = ready_us_ = now_us + kReset_us;
}

void Bno055Model::measure(const sim::ImuMeasurement& counts) {
  if (frozen || !measures()) return;
  const auto store = [this](std::size_t at, std::int16_t count) {
    const auto bits = static_cast<std::uint16_t>(count);
    registers_[0][at] = static_cast<std::uint8_t>(bits & 0xFF);
    registers_[0][at + 1] = static_cast<std::uint8_t>(bits >> 8);
  };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    store(kData + 2 * axis, counts.accel_count[axis]);
    store(kData + 12 + 2 * axis, counts.gyro_count[axis]);
  }
  if (noisy)
    store(kData, static_cast<std::int16_t>(counts.accel_count[0] + (++noise_ % 2 ? 1 : -1)));
}

bool Bno055Model::read(std::uint8_t address, std::uint8_t* data, std::size_t size,
                       std::uint64_t now_us) {
  if (silent || now_us < ready_us_ || address + size > registers_[0].size()) return false;
  for (std::size_t i = 0; i < size; ++i, ++address) {
    data[i] = registers_[page_][address];
    if (address == kPage) data[i] = static_cast<std::uint8_t>(page_);
    if (address == kChip && page_ == 0) data[i] = static_cast<std::uint8_t>(chip_id);
  }
  return true;
}

bool Bno055Model::write(std::uint8_t address, const std::uint8_t* data, std::size_t size,
                        std::uint64_t now_us) {
  if (silent || now_us < ready_us_ || address + size > registers_[0].size()) return false;
  for (std::size_t i = 0; i < size; ++i, ++address) put(address, data[i], now_us);
  return true;
}

// Only the mode, the page and the trigger may be written outside of CONFIG mode (section 3.3.1).
void Bno055Model::put(std::uint8_t address, std::uint8_t value, std::uint64_t now_us) {
  if (address == kPage) {
    page_ = value & 1;
  } else if (page_ == 0 && address == kTrigger) {
    if ((value & 0x20) != 0) reset(now_us);
  } else if (now_us < switch_us_ || (page_ == 0 && address < kUnits)) {
    ++violations_;
  } else if (page_ == 0 && address == kMode) {
    set_mode(value, now_us);
  } else if (registers_[0][kMode] != kConfig) {
    ++violations_;
  } else {
    registers_[page_][address] = value;
  }
}

// Table 3-6. Leaving a mode for CONFIG clears all data.
void Bno055Model::set_mode(std::uint8_t mode, std::uint64_t now_us) {
  if (mode == registers_[0][kMode]) return;
  switch_us_ = now_us + (mode == kConfig ? 19'000 : 7'000);
  registers_[0][kMode] = mode;
  for (std::size_t i = 0; i < 18; ++i) registers_[0][kData + i] = 0;
}

}  // namespace verp::imu
