#include "host/run/session/intervention.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "host/robot/model/number.hpp"

namespace verp::session {
namespace {

constexpr double kMostForce_n = 1e5, kMostPush_s = 3600;

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

double number(std::string_view text, const char* what, double low, double high) {
  const auto value = model::parse_number(trimmed(text));
  if (!value) throw std::invalid_argument(fmt::format("{} '{}' is not a number", what, text));
  if (*value >= low && *value <= high) return *value;
  throw std::invalid_argument(
      fmt::format("{} {:g} is out of range; give {:g} to {:g}", what, *value, low, high));
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  while (true) {
    const std::size_t end = text.find(separator);
    parts.push_back(text.substr(0, end));
    if (end == text.npos) return parts;
    text.remove_prefix(end + 1);
  }
}

std::vector<std::string_view> words(std::string_view text) {
  std::vector<std::string_view> found;
  for (const std::string_view word : split(text, ' ')) {
    if (!word.empty()) found.push_back(word);
  }
  return found;
}

/// Takes the time and its colon.
double take_time(std::string_view& text, const char* example) {
  constexpr double kDay_s = 86400;
  const std::size_t colon = text.find(':');
  if (colon == text.npos)
    throw std::invalid_argument(
        fmt::format("there is no time before a colon; example: {}", example));
  const double at_s = number(text.substr(0, colon), "the time", 0, kDay_s);
  text.remove_prefix(colon + 1);
  return at_s;
}

}  // namespace

Intervention read_push(const std::string& text) {
  constexpr const char* kExample = "'2.5: body 0,30,0 N for 0.1'";
  std::string_view rest = text;
  Intervention out{
      .kind = Intervention::Kind::kPush, .at_s = take_time(rest, kExample), .name = {}};
  const std::vector<std::string_view> word = words(rest);
  const bool with_s = word.size() == 6 && word[5] == "s";
  if ((word.size() != 5 && !with_s) || word[2] != "N" || word[3] != "for") {
    throw std::invalid_argument(
        fmt::format("that is not T: LINK fx,fy,fz N for S; example: {}", kExample));
  }
  out.name = word[0];
  const std::vector<std::string_view> force = split(word[1], ',');
  if (force.size() != 3)
    throw std::invalid_argument(fmt::format("'{}' is not fx,fy,fz; example: 0,30,0", word[1]));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    out.force_world_n[static_cast<int>(axis)] =
        number(force[axis], "the force in N", -kMostForce_n, kMostForce_n);
  }
  out.for_s = number(word[4], "the push's length in s", 0.001, kMostPush_s);
  return out;
}

Intervention read_setting(const std::string& text) {
  constexpr const char* kExample = "'2.5: body.mass_kg=2'";
  std::string_view rest = text;
  Intervention out{.kind = Intervention::Kind::kSet, .at_s = take_time(rest, kExample), .name = {}};
  const std::size_t equals = rest.find('=');
  if (equals == rest.npos)
    throw std::invalid_argument(fmt::format("that is not T: NAME=VALUE; example: {}", kExample));
  out.name = trimmed(rest.substr(0, equals));
  out.value = number(rest.substr(equals + 1), "the value", -1e12, 1e12);
  return out;
}

std::string in_words(const Intervention& i) {
  if (i.kind == Intervention::Kind::kSet) return fmt::format("set {}={}", i.name, i.value);
  const sim::Vec3& f = i.force_world_n;
  return fmt::format("push {} {},{},{} N for {} s", i.name, f.x(), f.y(), f.z(), i.for_s);
}

void check(const Intervention& i, const sim::Quantities& quantities) {
  i.kind == Intervention::Kind::kSet ? quantities.check(i.name, i.value)
                                     : quantities.check_push(i.name);
}

void apply(const Intervention& i, sim::Quantities& quantities) {
  i.kind == Intervention::Kind::kSet ? quantities.set(i.name, i.value)
                                     : quantities.push(i.name, i.force_world_n, i.for_s);
}

}  // namespace verp::session
