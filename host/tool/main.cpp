#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "host/board/board_error.hpp"
#include "host/model/load_error.hpp"
#include "host/record/trace.hpp"
#include "host/report/report.hpp"
#include "host/tool/command.hpp"
#include "host/tool/console.hpp"
#include "host/tool/interrupt.hpp"

namespace verp::tool {
namespace {

/// Letters to change, add or drop to get from one word to the other.
std::size_t edit_distance(std::string_view from, std::string_view to) {
  std::vector<std::size_t> row(to.size() + 1);
  for (std::size_t j = 0; j < row.size(); ++j) row[j] = j;
  for (std::size_t i = 0; i < from.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < to.size(); ++j) {
      const std::size_t replace = diagonal + (from[i] == to[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replace, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

/// "; did you mean --step?" when one of `names` is near the word that was not understood.
std::string suggestion(std::string_view word, const std::vector<std::string>& names) {
  const std::string* best = nullptr;
  std::size_t best_distance = 3;
  for (const std::string& name : names) {
    const std::size_t distance = edit_distance(word.substr(0, word.find('=')), name);
    if (distance < best_distance) best = &name, best_distance = distance;
  }
  return best == nullptr ? "" : fmt::format("; did you mean {}?", *best);
}

std::string one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

bool wants_json(int argc, char** argv) {
  return std::any_of(argv, argv + argc, [](std::string_view a) { return a == "--json"; });
}

int fail(int status, const std::string& line, bool json) {
  complain(one_line(line));
  if (json) print_json({{"error", one_line(line)}, {"exit", status}});
  return status;
}

/// The deepest subcommand the command line names.
const CLI::App* addressed(const CLI::App& root) {
  const CLI::App* app = &root;
  for (auto inner = app->get_subcommands(); !inner.empty(); inner = app->get_subcommands()) {
    app = inner.front();
  }
  return app;
}

std::string full_name(const CLI::App* app) {
  if (app->get_parent() == nullptr) return "verp";
  return full_name(app->get_parent()) + " " + app->get_name();
}

int parse_failure(const CLI::App& root, const CLI::ParseError& error, bool json) {
  const CLI::App* app = addressed(root);
  if (error.get_exit_code() == 0) {  // --help, --version
    const auto* version = dynamic_cast<const CLI::CallForVersion*>(&error);
    answer(version != nullptr ? std::string(error.what()) + "\n" : app->help());
    return kGood;
  }
  std::string line = error.what();
  std::vector<std::string> names;
  for (const CLI::Option* option : app->get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  for (const CLI::App* inner : app->get_subcommands(nullptr)) names.push_back(inner->get_name());
  const std::vector<std::string> unknown = app->remaining();
  if (!unknown.empty()) {
    line = fmt::format("'{}' is not understood{}", unknown.front(),
                       suggestion(unknown.front(), names));
  }
  const std::string name = full_name(app);
  return fail(kBadInput, fmt::format("{}: {}; see `{} --help`", name, one_line(line), name), json);
}

int run(int argc, char** argv) {
  catch_interrupts();
  const bool json = wants_json(argc, argv);
  CLI::App root("VERP: a humanoid robot's controller and its twin", "verp");
  root.set_version_flag("--version", "verp " + record::build_info().at("source_revision"));
  root.require_subcommand(1);
  const std::vector<Subcommand> commands = {add_walk(root),  add_replay(root), add_diff(root),
                                            add_check(root), add_export(root), add_trace(root),
                                            add_bench(root)};
  // After the subcommands, which would have it too.
  root.footer("Besides, the launcher has `./verp test`: everything that is promised, checked.");
  try {
    root.parse(argc, argv);
    for (const Subcommand& command : commands) {
      if (command.app->parsed()) return command.run();
    }
  } catch (const CLI::ParseError& error) {
    return parse_failure(root, error, json);
  } catch (const ToolError& error) {
    return fail(error.status(), error.what(), json);
  } catch (const model::LoadError& error) {
    return fail(kBadInput, error.what(), json);
  } catch (const board::BoardError& error) {
    return fail(kNoDevice, error.what(), json);
  } catch (const record::TraceError& error) {
    return fail(kBadInput, error.what(), json);
  } catch (const report::ReportError& error) {
    return fail(kBadInput, error.what(), json);
  } catch (const std::exception& error) {
    return fail(kRunFailed, fmt::format("verp: unexpected: {}; please report it", error.what()),
                json);
  }
  return kGood;
}

}  // namespace
}  // namespace verp::tool

int main(int argc, char** argv) {
  verp::tool::open_missing_streams();
  const int status = verp::tool::run(argc, argv);
  return verp::tool::after_the_answer(status);
}
