#include "host/robot/model/number.hpp"

#include <charconv>
#include <cmath>
#include <limits>

namespace verp::model {
namespace {

constexpr double kLargestFloat = std::numeric_limits<float>::max();
constexpr std::string_view kSpace = " \t\r\n";

std::string_view trim(std::string_view text) {
  const auto first = text.find_first_not_of(kSpace);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kSpace) - first + 1);
}

}  // namespace

std::optional<double> parse_number(std::string_view text) {
  text = trim(text);
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0;
  const char* end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, value);
  // Rejects numbers beyond float32.
  if (result.ec != std::errc() || result.ptr != end || !(std::abs(value) <= kLargestFloat)) {
    return std::nullopt;
  }
  return value;
}

std::optional<std::vector<double>> parse_numbers(std::string_view text) {
  std::vector<double> values;
  for (text = trim(text); !text.empty(); text = trim(text)) {
    const auto length = std::min(text.find_first_of(kSpace), text.size());
    const auto value = parse_number(text.substr(0, length));
    if (!value) return std::nullopt;
    values.push_back(*value);
    text.remove_prefix(length);
  }
  return values;
}

bool is_infinity(std::string_view text) {
  text = trim(text);
  if (text.starts_with('+') || text.starts_with('-')) text.remove_prefix(1);
  return text == "inf";
}

}  // namespace verp::model
