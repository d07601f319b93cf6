// The words of a command, one a line, as far as their meaning: nothing is run.
#include <CLI/CLI.hpp>
#include <vector>

#include "host/apps/cli/failure.hpp"
#include "host/apps/cli/suggest.hpp"
#include "host/apps/tool/commands.hpp"
#include "tests/fuzz/fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace verp;
  std::vector<std::string> words;
  std::string_view text(reinterpret_cast<const char*>(data), size);
  for (std::size_t end = 0; end != text.npos; text.remove_prefix(end + 1)) {
    end = text.find('\n');
    words.emplace_back(text.substr(0, end));
    if (end == text.npos) break;
  }
  CLI::App root("fuzz", "verp");
  root.require_subcommand(1);
  const auto commands = {tool::add_walk(root), tool::add_replay(root), tool::add_diff(root),
                         tool::add_completion(root), tool::add_parameters(root)};
  std::vector<std::string> names;
  for (const cli::Subcommand& each : commands) names.push_back(each.app->get_name());
  cli::did_you_mean(words[0], names);
  std::reverse(words.begin(), words.end());  // CLI11 takes the last one first
  fuzz::refuses_only_by<CLI::ParseError>([&] { root.parse(words); });
  return 0;
}
