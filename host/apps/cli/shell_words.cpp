#include "host/apps/cli/shell_words.hpp"

#include <CLI/CLI.hpp>

namespace verp::cli {
namespace {

std::string first_line_of(const std::string& text) {
  return text.substr(0, text.find('\n'));
}

std::vector<std::string> names_of(const CLI::App& app) {
  std::vector<std::string> names = app.get_aliases();
  names.insert(names.begin(), app.get_name());
  return names;
}

void gather(const CLI::App& app, const std::string& command, std::vector<ShellWords>& all) {
  ShellWords words{.command = command, .commands = {}, .options = {}};
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames())
      words.options.emplace_back("--" + name, first_line_of(option->get_description()));
  }
  const auto inner = app.get_subcommands([](const CLI::App*) { return true; });
  for (const CLI::App* each : inner) {
    for (const std::string& name : names_of(*each))
      words.commands.emplace_back(name, first_line_of(each->get_description()));
  }
  all.push_back(words);
  for (const CLI::App* each : inner) {
    for (const std::string& name : names_of(*each))
      gather(*each, command + (command.empty() ? "" : " ") + name, all);
  }
}

}  // namespace

std::vector<ShellWords> shell_words_of(const CLI::App& root) {
  std::vector<ShellWords> all;
  gather(root, "", all);
  return all;
}

Json json_of(const std::vector<ShellWords>& words) {
  Json rows = Json::array();
  for (const ShellWords& each : words) rows.push_back({each.command, each.commands, each.options});
  return rows;
}

std::vector<ShellWords> shell_words_in(const Json& json) {
  std::vector<ShellWords> words;
  for (const Json& row : json) {
    ShellWords& each = words.emplace_back();
    row.at(0).get_to(each.command);
    row.at(1).get_to(each.commands);
    row.at(2).get_to(each.options);
  }
  return words;
}

}  // namespace verp::cli
