#include "host/apps/tool/robot/register_value.hpp"
#include "host/apps/cli/exit_status.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>

namespace verp::tool {
namespace {

using dxl::controller::is_signed;
using dxl::controller::Type;
using dxl::controller::type_bytes;

cli::Json element(Type type, const std::uint8_t* bytes) {
  if (type == Type::kF32) {
    float value = 0;
    std::memcpy(&value, bytes, sizeof value);
    return value;
  }
  std::uint64_t raw = 0;
  const unsigned size = type_bytes(type);
  for (unsigned i = 0; i < size; ++i) raw |= std::uint64_t{bytes[i]} << (8 * i);
  if (type == Type::kI8) return static_cast<std::int8_t>(raw);
  if (type == Type::kI16) return static_cast<std::int16_t>(raw);
  if (type == Type::kI32) return static_cast<std::int32_t>(raw);
  return raw;
}

[[noreturn]] void refuse(const bus::NamedRegister& reg, const std::string& why) {
  throw cli::ToolError(cli::kBadInput, fmt::format("{}: {}", reg.name, why));
}

std::uint32_t parse_float(const bus::NamedRegister& reg, const std::string& word) {
  float value = 0;
  const char* end = word.data() + word.size();
  const auto [last, error] = std::from_chars(word.data(), end, value);
  if (error != std::errc() || last != end || !std::isfinite(value)) {
    refuse(reg, fmt::format("'{}' is not a number", word));
  }
  std::uint32_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  return bits;
}

std::int64_t parse_integer(const bus::NamedRegister& reg, const std::string& word) {
  const int bits = 8 * type_bytes(reg.type);
  const std::int64_t low = is_signed(reg.type) ? -(std::int64_t{1} << (bits - 1)) : 0;
  const std::int64_t high = (std::int64_t{1} << (bits - (is_signed(reg.type) ? 1 : 0))) - 1;
  const bool hex = word.starts_with("0x") || word.starts_with("0X");
  std::int64_t value = 0;
  const char* end = word.data() + word.size();
  const auto [last, error] =
      std::from_chars(word.data() + (hex ? 2 : 0), end, value, hex ? 16 : 10);
  if (error != std::errc() || last != end || value < low || value > high) {
    refuse(reg,
           fmt::format("'{}' does not fit; give a whole number from {} to {}", word, low, high));
  }
  return value;
}

}  // namespace

cli::Json json_value(const bus::NamedRegister& reg, const std::vector<std::uint8_t>& bytes) {
  if (reg.type == Type::kText) {
    return std::string(bytes.begin(), std::find(bytes.begin(), bytes.end(), 0));
  }
  if (reg.count == 1) return element(reg.type, bytes.data());
  cli::Json all = cli::Json::array();
  for (std::size_t i = 0; i < bytes.size(); i += type_bytes(reg.type)) {
    all.push_back(element(reg.type, bytes.data() + i));
  }
  return all;
}

std::string show_value(const bus::NamedRegister& reg, const std::vector<std::uint8_t>& bytes) {
  const cli::Json value = json_value(reg, bytes);
  if (value.is_string()) return value.get<std::string>();
  if (!value.is_array()) return value.dump();
  std::string text;
  for (const cli::Json& each : value) text += (text.empty() ? "" : " ") + each.dump();
  return text;
}

std::string with_unit(const std::string& shown, std::string_view unit) {
  if (unit.empty()) return shown;
  double scale = 0, value = 0;
  const auto [word, bad_scale] = std::from_chars(unit.data(), unit.data() + unit.size(), scale);
  if (bad_scale != std::errc()) return fmt::format("{} {}", shown, unit);
  const char* const end = shown.data() + shown.size();
  const auto [last, bad_value] = std::from_chars(shown.data(), end, value);
  const std::string scaled = fmt::format("{} x {}", shown, unit);
  if (bad_value != std::errc() || last != end) return scaled;  // several elements
  return fmt::format("{} = {:.6g}{}", scaled, value * scale,
                     std::string(word, unit.data() + unit.size()));
}

std::vector<std::uint8_t> parse_values(const bus::NamedRegister& reg,
                                       const std::vector<std::string>& words) {
  if (words.size() > reg.count) {
    refuse(reg, fmt::format("has {} element{}, not {}", reg.count, reg.count == 1 ? "" : "s",
                            words.size()));
  }
  std::vector<std::uint8_t> bytes;
  for (const std::string& word : words) {
    const std::uint64_t raw = reg.type == Type::kF32
                                  ? parse_float(reg, word)
                                  : static_cast<std::uint64_t>(parse_integer(reg, word));
    for (unsigned i = 0; i < type_bytes(reg.type); ++i) {
      bytes.push_back(static_cast<std::uint8_t>(raw >> (8 * i)));
    }
  }
  return bytes;
}

}  // namespace verp::tool
