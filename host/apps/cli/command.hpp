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

/// `run` returns the exit status or throws.
struct Subcommand {
  CLI::App* app;
  std::function<int()> run;
};

/// Adds --json. With it stdout holds one JSON object only; other text goes to stderr.
void add_json_flag(CLI::App& app, bool& json);

/// The argument MODEL and --robot MODEL, which is the same.
CLI::Option* add_model(CLI::App& app, std::string& model);

void add_bus_option(CLI::App& app, std::string& bus);

/// All of `text` as a decimal number within [low, high]. Otherwise throws CLI::ValidationError with
/// the range, also for NaN, infinity and trailing characters.
double parse_number(const std::string& text, double low, double high, const std::string& unit);

CLI::Validator number_between(double low, double high, const std::string& unit);

CLI::Validator whole_number_between(std::uint64_t low, std::uint64_t high);

}  // namespace verp::cli
