#include "host/apps/cli/program.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <string>
#include <string_view>

#include "host/apps/cli/console.hpp"
#include "host/apps/cli/failure.hpp"
#include "host/apps/cli/interrupt.hpp"
#include "host/apps/cli/json.hpp"
#include "host/apps/cli/shell_words.hpp"
#include "host/apps/cli/suggest.hpp"
#include "host/trace/record/trace.hpp"

namespace verp::cli {
namespace {

constexpr std::size_t kColumn = 30;  // column of CLI11's descriptions
constexpr std::size_t kNarrow = 60;
constexpr std::size_t kIndentOfNarrow = 6;
constexpr int kElsewhere = 100, kLeast = 20;

/// The word, or if it does not fit, its longest part that fits and ends with a comma.
std::string_view first_piece(std::string_view word, std::size_t room) {
  if (word.size() <= room) return word;
  const std::size_t comma = word.rfind(',', room - 1);
  return comma == word.npos ? word : word.substr(0, comma + 1);
}

/// `first` and `text` in lines of at most `width`, indented by `indent` from the second.
std::string paragraph(std::string first, std::string_view text, std::size_t indent,
                      std::size_t width) {
  std::string out, line = std::move(first);
  bool bare = line.find_first_not_of(' ') == std::string::npos;
  while (!text.empty()) {
    const std::string_view word = first_piece(text.substr(0, text.find(' ')), width - indent);
    text.remove_prefix(word.size());
    if (text.starts_with(' ')) text.remove_prefix(1);
    if (word.empty()) continue;
    const bool space = !bare && line.back() != ' ';
    if (!bare && line.size() + (space ? 1 : 0) + word.size() > width) {
      while (line.back() == ' ') line.pop_back();
      out += line + '\n';
      line.assign(indent, ' ');
      line += word;
    } else {
      line += (space ? " " : "") + std::string(word);
    }
    bare = false;
  }
  return out + line + '\n';
}

std::string one_line(std::string_view line, std::size_t width) {
  const std::size_t start = std::min(line.find_first_not_of(' '), line.size());
  const bool described =
      start >= 2 && line.size() > kColumn && line[kColumn - 1] == ' ' && line[kColumn] != ' ';
  if (described && width >= kNarrow) {
    return paragraph(std::string(line.substr(0, kColumn)), line.substr(kColumn), kColumn, width);
  }
  if (!described) {
    return paragraph(std::string(start, ' '), line.substr(start), start + (start > 0 ? 2 : 0),
                     width);
  }
  std::string word(line.substr(0, kColumn));
  word.erase(word.find_last_not_of(' ') + 1);
  if (!word.empty()) word = paragraph("  ", word, 4, width);
  return word +
         paragraph(std::string(kIndentOfNarrow, ' '), line.substr(kColumn), kIndentOfNarrow, width);
}

/// COLUMNS, else the terminal's columns; 100 without a terminal.
int help_width() {
  int width = 0;
  winsize size{};
  if (const char* columns = std::getenv("COLUMNS")) width = std::atoi(columns);
  if (width <= 0 && ::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0) width = size.ws_col;
  return width <= 0 ? kElsewhere : std::max(width, kLeast);
}

/// Wraps CLI11's descriptions in their column; below 60 columns, under their word. Long words stay
/// whole.
std::string wrapped_help(std::string_view text, int width) {
  std::string out;
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(text.size(), line.size() + 1));
    const bool fits = line.size() <= static_cast<std::size_t>(width);
    out += fits ? std::string(line) + '\n' : one_line(line, static_cast<std::size_t>(width));
  }
  return out;
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

/// CLI11 reports argument counts; this says what is missing, unwanted or repeated.
std::string in_words(const CLI::ParseError& error) {
  const std::string line = error.what();
  if (const std::size_t end = line.find(" was given a disallowed flag"); end != line.npos) {
    return "--" + line.substr(0, end) + " takes no value";
  }
  if (line.starts_with("--robot is required")) {
    return "MODEL is required: a robot's name, or the path of its SDF file";
  }
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) == nullptr) return line;
  const std::string name = line.substr(0, line.find(':'));
  if (line.ends_with(" missing")) return name + " needs a value";
  if (line.find("At Most 1 ") != std::string::npos) return name + " is given more than once";
  return line;
}

/// An empty argument is probably an unset variable and must not select a default. Returns the error
/// text.
std::string empty_word(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    const std::string_view word = argv[i];
    const bool no_value = word.starts_with("--") && word.ends_with('=');
    if (!word.empty() && !no_value) continue;
    const std::string_view name = no_value ? word.substr(0, word.size() - 1) : argv[i - 1];
    return fmt::format("verp: the word after {} is empty; give a value or leave it out",
                       i == 1 && !no_value ? "verp" : name);
  }
  return "";
}

int answer_version(const std::string& version, bool json) {
  if (json) {
    Json object = Json::object();
    for (const auto& [key, value] : record::build_info()) object[key] = value;
    print_json(object);
  } else {
    answer(version + "\n");
  }
  return kGood;
}

int parse_failure(const CLI::App& root, const CLI::ParseError& error, bool json) {
  const CLI::App* app = addressed(root);
  if (error.get_exit_code() == 0) {  // --help, --version
    const auto* version = dynamic_cast<const CLI::CallForVersion*>(&error);
    if (version != nullptr) return answer_version(error.what(), json);
    answer(wrapped_help(app->help(app == &root ? "" : full_name(app->get_parent())), help_width()));
    return kGood;
  }
  std::string line = in_words(error);
  std::vector<std::string> names;
  for (const CLI::Option* option : app->get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  for (const CLI::App* inner : app->get_subcommands(nullptr)) names.push_back(inner->get_name());
  const std::vector<std::string> unknown = app->remaining();
  if (!unknown.empty()) {
    const std::string_view word = unknown.front();
    line = fmt::format("'{}' is not understood{}", word,
                       did_you_mean(word.substr(0, word.find('=')), names));
  }
  const std::string name = full_name(app);
  return fail(kBadInput, fmt::format("{}: {}; see `{} --help`", name, one_line(line), name), json);
}

int run(int argc, char** argv, AddCommands add_commands) {
  keep_failing_writes();
  const bool json = wants_json(argc, argv);
  if (const std::string line = empty_word(argc, argv); !line.empty()) {
    return fail(kBadInput, line, json);
  }
  CLI::App root("VERP: a humanoid robot's controller and its twin", "verp");
  root.set_version_flag("--version", "verp " + record::build_info().at("source_revision"));
  root.require_subcommand(1);
  const std::vector<Subcommand> commands = add_commands(root);
  // After the subcommands, which would inherit it.
  root.footer(
      "The launcher adds `./verp test`, which checks all promises, `./verp manual`, which builds "
      "the\nmanual, and `./verp python FILE`, which runs a Python program with libverp.");
  if (argc == 2 && argv[1] == std::string_view(kShellWords)) {
    answer(json_of(shell_words_of(root)).dump());
    return kGood;
  }
  try {
    root.parse(argc, argv);
    for (const Subcommand& command : commands) {
      if (command.app->parsed()) return command.run();
    }
  } catch (const CLI::ParseError& error) {
    return parse_failure(root, error, json);
  } catch (...) {
    const Failure failure = current_failure();
    return fail(failure.status, failure.line, json);
  }
  return kGood;
}

}  // namespace

int run_program(int argc, char** argv, AddCommands add_commands) {
  open_missing_streams();
  return after_the_answer(status_if_interrupted(run(argc, argv, add_commands)));
}

}  // namespace verp::cli
