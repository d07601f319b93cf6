#include "host/os/imu/chips.hpp"

namespace verp::imu {
namespace {

constexpr ChipType kChips[] = {
    {Chip::kBno055,
     "bno055",
     0x00,
     0xA0,
     {0x28, 0x29},
     true,
     "RST high, PS0 and PS1 low for I2C, PS1 high for serial"},
    {Chip::kMpu6050, "mpu6050", 0x75, 0x68, {0x68, 0x69}, false, "AD0 low for 0x68, high for 0x69"},
    {Chip::kIcm42688p,
     "icm42688p",
     0x75,
     0x47,
     {0x68, 0x69},
     false,
     "CS high for I2C, AD0 low for 0x68, high for 0x69"},
};

}  // namespace

const ChipType& type_of(Chip chip) {
  return kChips[static_cast<std::size_t>(chip)];
}

const ChipType* find_chip(const std::string& name) {
  for (const ChipType& each : kChips) {
    if (name == each.name) return &each;
  }
  return nullptr;
}

std::string chip_names(bool with_uart) {
  std::string names;
  for (const ChipType& each : kChips) {
    if (!with_uart || each.has_uart) names += (names.empty() ? "" : ", ") + std::string(each.name);
  }
  return names;
}

const ChipType* identify(hal::RegisterBus& bus) {
  for (const ChipType& each : kChips) {
    std::uint8_t id = 0;
    if (bus.read(each.id_at, &id, 1) && id == each.id) return &each;
  }
  return nullptr;
}

}  // namespace verp::imu
