#pragma once
#include <cstdint>
#include <functional>
#include <string>

#include "host/apps/cli/exit_status.hpp"

namespace CLI {
class App;
class Option;
class Validator;
}  // namespace CLI

namespace verp::cli {

/// A subcommand: its options, and what to run once they are parsed. `run` returns the exit status
/// or throws.
struct Subcommand {
  CLI::App* app;
  std::function<int()> run;
};

/// Adds --json. With it stdout holds one JSON object and nothing else; everything for people goes
/// to stderr.
void add_json_flag(CLI::App& app, bool& json);

/// Adds MODEL, the robot, everywhere by these words; --robot MODEL is the same.
CLI::Option* add_model(CLI::App& app, std::string& model);

/// Adds --bus: which of the robot's buses is used, by name.
void add_bus_option(CLI::App& app, std::string& bus);

/// Parses all of `text` as a decimal number within [low, high]; throws CLI::ValidationError with
/// the range otherwise (also for NaN, infinity and trailing characters).
double parse_number(const std::string& text, double low, double high, const std::string& unit);

/// A check for CLI options that take one number: same rules as parse_number.
CLI::Validator number_between(double low, double high, const std::string& unit);

/// A check for CLI options that take a whole number, written in digits only.
CLI::Validator whole_number_between(std::uint64_t low, std::uint64_t high);

}  // namespace verp::cli
