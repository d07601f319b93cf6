#include "host/apps/tool/radio_words.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <sstream>
#include <utility>

#include "host/apps/cli/command.hpp"
#include "host/apps/cli/exit_status.hpp"

namespace verp::tool {

radio::Conditions radio_of(const std::string& command, const std::string& text) {
  radio::Conditions radio;
  const std::pair<const char*, double*> numbers[] = {
      {"range_m", &radio.range_m}, {"loss", &radio.loss},       {"fade", &radio.fade},
      {"fade_s", &radio.fade_s},   {"delay_s", &radio.delay_s}, {"jitter_s", &radio.jitter_s},
      {"bytes_s", &radio.bytes_s}};
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    const std::size_t equals = word.find('=');
    double* number = nullptr;
    std::string names;
    for (const auto& [name, value] : numbers) {
      if (word.substr(0, equals) == name) number = value;
      names += (names.empty() ? "" : ", ") + std::string(name);
    }
    if (number == nullptr || equals == std::string::npos) {
      throw cli::ToolError(cli::kBadInput,
                           fmt::format("{} --radio '{}': that is not NAME=VALUE with "
                                       "a name out of: {}",
                                       command, word, names));
    }
    try {
      *number = cli::parse_number(word.substr(equals + 1), 0, 1e9, "");
      radio::check(radio);
    } catch (const std::invalid_argument& error) {
      throw cli::ToolError(cli::kBadInput,
                           fmt::format("{} --radio '{}': {}", command, word, error.what()));
    } catch (const CLI::Error& error) {
      throw cli::ToolError(cli::kBadInput,
                           fmt::format("{} --radio '{}': {}", command, word, error.what()));
    }
  }
  return radio;
}

}  // namespace verp::tool
