#pragma once
#include <string>
#include <utility>
#include <vector>

#include "host/apps/cli/json.hpp"

namespace CLI {
class App;
}  // namespace CLI

namespace verp::cli {

/// Words after one command ("bus read"; empty: the root).
struct ShellWords {
  std::string command;
  std::vector<std::pair<std::string, std::string>> commands, options;  ///< with their descriptions
};

/// The only argument with which a program prints its words for `verp completion`.
constexpr const char* kShellWords = "--shell-words";

std::vector<ShellWords> shell_words_of(const CLI::App& root);

Json json_of(const std::vector<ShellWords>& words);
std::vector<ShellWords> shell_words_in(const Json& json);

}  // namespace verp::cli
