#include "host/os/imu/imu_place.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <vector>

#include "host/os/imu/chips.hpp"
#include "host/os/link/endpoint.hpp"

namespace verp::imu {
namespace {

[[noreturn]] void refuse(const std::string& text, const std::string& why) {
  throw link::EndpointError("--imu " + text + ": " + why);
}

std::vector<std::string> pieces(std::string_view text, char separator) {
  std::vector<std::string> all;
  for (;;) {
    const std::size_t end = std::min(text.find(separator), text.size());
    all.emplace_back(text.substr(0, end));
    if (end == text.size()) return all;
    text.remove_prefix(end + 1);
  }
}

/// A signed axis as a column; zero: no axis.
std::array<float, 3> axis_of(std::string word) {
  const float sign = word.starts_with('-') ? -1.0F : 1.0F;
  if (word.starts_with('-') || word.starts_with('+')) word.erase(0, 1);
  std::array<float, 3> axis{};
  if (word.size() == 1 && word[0] >= 'x' && word[0] <= 'z') {
    axis[static_cast<std::size_t>(word[0] - 'x')] = sign;
  }
  return axis;
}

float determinant(const std::array<float, 9>& m) {
  return m[0] * (m[4] * m[8] - m[5] * m[7]) - m[1] * (m[3] * m[8] - m[5] * m[6]) +
         m[2] * (m[3] * m[7] - m[4] * m[6]);
}

std::array<float, 9> mount_of(const std::string& text, const std::string& value) {
  const std::vector<std::string> words = pieces(value, ':');
  std::array<float, 9> rows{};
  for (std::size_t column = 0; column < 3 && words.size() == 3; ++column) {
    const std::array<float, 3> axis = axis_of(words[column]);
    for (std::size_t row = 0; row < 3; ++row) rows[3 * row + column] = axis[row];
  }
  const float volume = determinant(rows);
  if (volume == -1) refuse(text, "mount=" + value + " is a left hand's; turn the sign of one axis");
  if (volume != 1) {
    refuse(text, "mount=" + value +
                     " must say where the chip's x, y and z point, as mount=-y:x:z: x ahead, y "
                     "left, z up");
  }
  return rows;
}

std::uint8_t address_of(const std::string& text, const std::string& value, const ChipType& type) {
  char* end = nullptr;
  const long address = std::strtol(value.c_str(), &end, 0);
  if (value.empty() || *end != '\0' ||
      (address != type.addresses[0] && address != type.addresses[1])) {
    char wanted[64];
    std::snprintf(wanted, sizeof wanted, "a %s has address 0x%02x or 0x%02x", type.name,
                  type.addresses[0], type.addresses[1]);
    refuse(text, wanted);
  }
  return static_cast<std::uint8_t>(address);
}

}  // namespace

const char* name_of(Chip chip) {
  return type_of(chip).name;
}

ImuPlace parse_imu(const std::string& text) {
  constexpr const char* kForms =
      "write bus, none, i2c:/dev/i2c-1,CHIP[,address=0x29][,mount=-y:x:z] or "
      "serial:/dev/ttyUSB0,bno055[,mount=-y:x:z]";
  const std::vector<std::string> words = pieces(text, ',');
  ImuPlace place;
  place.serial = text.starts_with("serial:");
  if ((!place.serial && !text.starts_with("i2c:")) || words.size() < 2) refuse(text, kForms);
  place.device = words[0].substr(words[0].find(':') + 1);
  if (place.device.empty()) refuse(text, kForms);
  const ChipType* type = find_chip(words[1]);
  if (type == nullptr || (place.serial && !type->has_uart)) {
    refuse(text, "no chip '" + words[1] + "' " + (place.serial ? "on a serial port" : "on I2C") +
                     "; choose one of: " + chip_names(place.serial));
  }
  place.chip = type->chip;
  place.address = type->addresses[0];
  for (std::size_t i = 2; i < words.size(); ++i) {
    const std::string value = words[i].substr(std::min(words[i].find('=') + 1, words[i].size()));
    if (words[i].starts_with("address=") && !place.serial) {
      place.address = address_of(text, value, *type);
    } else if (words[i].starts_with("mount=")) {
      place.body_imu = mount_of(text, value);
    } else {
      refuse(text, "'" + words[i] + "' is unknown; " + kForms);
    }
  }
  return place;
}

std::string to_text(const ImuPlace& place) {
  char at[32] = "";
  if (!place.serial) std::snprintf(at, sizeof at, ", address 0x%02x", place.address);
  return std::string(name_of(place.chip)) + " on " + place.device + at;
}

}  // namespace verp::imu
