#include "host/apps/cli/command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include <charconv>
#include <cmath>

namespace verp::cli {

CLI::Option* add_model(CLI::App& app, std::string& model) {
  return app.add_option("MODEL,--robot", model, "a robot by its name, or the path of its SDF file");
}

void add_bus_option(CLI::App& app, std::string& bus) {
  app.add_option("--bus", bus, "name of the robot's bus to use (default: its first)");
}

void add_json_flag(CLI::App& app, bool& json) {
  app.add_flag("--json", json, "one JSON object on stdout, everything else on stderr")
      ->disable_flag_override();  // else CLI11 would read --json=no as false
}

double parse_number(const std::string& text, double low, double high, const std::string& unit) {
  double value = 0;
  const char* first = text.data() + (text.starts_with('+') ? 1 : 0);
  const char* last = text.data() + text.size();
  const auto [end, error] = std::from_chars(first, last, value);
  const std::string space = unit.empty() ? "" : " ";
  if (error != std::errc() || end != last || !std::isfinite(value)) {
    throw CLI::ValidationError(fmt::format("'{}' is not a number; give {:.10g} to {:.10g}{}{}",
                                           text, low, high, space, unit));
  }
  if (value < low || value > high) {
    throw CLI::ValidationError(fmt::format("{} is out of range; give {:.10g} to {:.10g}{}{}", text,
                                           low, high, space, unit));
  }
  return value;
}

CLI::Validator number_between(double low, double high, const std::string& unit) {
  return CLI::Validator(
      [=](std::string& text) {
        try {
          parse_number(text, low, high, unit);
        } catch (const CLI::ValidationError& error) {
          return std::string(error.what());
        }
        return std::string();
      },
      fmt::format("{:g}..{:g}{}{}", low, high, unit.empty() ? "" : " ", unit));
}

CLI::Validator whole_number_between(std::uint64_t low, std::uint64_t high) {
  return CLI::Validator(
      [=](std::string& text) {
        std::uint64_t value = 0;
        const char* last = text.data() + text.size();
        const auto [end, error] = std::from_chars(text.data(), last, value);
        if (error != std::errc() || end != last) {
          return fmt::format("'{}' is not a whole number in digits; give {} to {}", text, low,
                             high);
        }
        if (value >= low && value <= high) return std::string();
        return fmt::format("{} is out of range; give {} to {}", text, low, high);
      },
      fmt::format("{}..{}", low, high));
}

}  // namespace verp::cli
