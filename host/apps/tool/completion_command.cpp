#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>

#include "host/apps/cli/console.hpp"
#include "host/apps/cli/other_program.hpp"
#include "host/apps/tool/commands.hpp"
#include "host/boards/flash/recipe.hpp"
#include "host/robot/model/find.hpp"

namespace verp::tool {
namespace {

using cli::ShellWords;

bool takes_robot(const ShellWords& words) {
  return std::any_of(words.options.begin(), words.options.end(),
                     [](const auto& option) { return option.first == "--robot"; });
}

std::vector<ShellWords> all_words(const CLI::App& root) {
  std::vector<ShellWords> all = cli::shell_words_of(root);
  for (ShellWords& other : cli::words_of_others()) {
    std::erase_if(all, [&](const ShellWords& each) { return each.command == other.command; });
    all.push_back(std::move(other));
  }
  all.front().commands.emplace_back("test", "everything that is promised, checked");
  all.front().commands.emplace_back("python", "Debian's Python with libverp");
  all.push_back({.command = "python", .commands = {}, .options = {}});
  all.push_back({.command = "test",
                 .commands = {},
                 .options = {{"--only", "label"},
                             {"--filter", "names"},
                             {"--on", "board"},
                             {"--full", ""},
                             {"--complete", ""}}});
  return all;
}

std::string board_names() {
  std::string names;
  for (const flash::Recipe& each : flash::recipes())
    names += (names.empty() ? "" : " ") + std::string(each.board);
  return names;
}

std::string bash_words(const CLI::App& root) {
  std::string cases, commands;
  for (const ShellWords& each : all_words(root)) {
    std::string words;
    for (const auto& list : {each.commands, each.options}) {
      for (const auto& [name, ignored] : list) words += (words.empty() ? "" : " ") + name;
    }
    if (takes_robot(each)) words += fmt::format(" {}", fmt::join(model::model_names(), " "));
    cases += fmt::format("    '{}') words='{}' ;;\n", each.command, words);
    if (!each.command.empty()) commands += fmt::format("|{}", each.command);
  }
  return fmt::format(
      R"(_verp() {{
  local word words command= current=${{COMP_WORDS[COMP_CWORD]}} previous=${{COMP_WORDS[COMP_CWORD-1]}}
  for word in "${{COMP_WORDS[@]:1:COMP_CWORD-1}}"; do
    case "|{}|" in *"|${{command:+$command }}$word|"*) command=${{command:+$command }}$word ;; esac
  done
  case "$command" in
{}  esac
  case "$previous" in
    --board | --on) words='{}' ;;
    --robot) words='{}' ;;
    --report | --record | --output | -o) words= ;;
  esac
  COMPREPLY=($(compgen -W "$words" -- "$current"))
}}
complete -o default -F _verp verp ./verp
)",
      commands, cases, board_names(), fmt::join(model::model_names(), " "));
}

/// zsh can load bash's completion.
std::string zsh_words(const CLI::App& root) {
  return "autoload -U +X compinit && compinit\nautoload -U +X bashcompinit && bashcompinit\n" +
         bash_words(root);
}

std::string in_quotes(std::string text) {
  std::erase(text, '\'');
  return "'" + text + "'";
}

std::string fish_words(const CLI::App& root) {
  std::string out = "complete -c verp -f\n";
  for (const ShellWords& each : all_words(root)) {
    std::string seen = "__fish_use_subcommand";
    if (!each.command.empty()) {
      seen = "__fish_seen_subcommand_from " + each.command.substr(each.command.rfind(' ') + 1);
    }
    for (const auto& [name, does] : each.commands) {
      out += fmt::format("complete -c verp -n '{}' -a {} -d {}\n", seen, name, in_quotes(does));
    }
    for (const auto& [name, does] : each.options) {
      out += fmt::format("complete -c verp -n '{}' -l {} -F -d {}\n", seen, name.substr(2),
                         in_quotes(does));
    }
    if (takes_robot(each)) {
      out += fmt::format("complete -c verp -n '{}' -a '{}'\n", seen,
                         fmt::join(model::model_names(), " "));
    }
  }
  return out;
}

}  // namespace

cli::Subcommand add_completion(CLI::App& root) {
  CLI::App* app = root.add_subcommand(
      "completion", "Words for your shell's Tab key: eval \"$(./verp completion bash)\"");
  auto shell = std::make_shared<std::string>();
  app->add_option("SHELL", *shell, "bash, zsh or fish")
      ->required()
      ->check(CLI::IsMember({"bash", "zsh", "fish"}));
  return {app, [shell, &root] {
            cli::answer(*shell == "bash"  ? bash_words(root)
                        : *shell == "zsh" ? zsh_words(root)
                                          : fish_words(root));
            return int{cli::kGood};
          }};
}

}  // namespace verp::tool
