#include "host/apps/tool/robot/new_controller.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <memory>
#include <regex>

#include "host/apps/cli/console.hpp"
#include "host/os/files/places.hpp"
#include "host/os/files/whole.hpp"

namespace verp::tool {
namespace {

namespace fs = std::filesystem;

struct NewControllerWords {
  std::string name, in = ".";
};

constexpr std::size_t kLongest = 40;
constexpr const char* kFiles[] = {"README.md",      "CMakeLists.txt",      "controller.hpp",
                                  "controller.cpp", "controller_test.cpp", ".gitignore"};

void check_name(const std::string& name) {
  const auto plain = [](unsigned char c) { return c < 128 && (std::isalnum(c) != 0 || c == '_'); };
  if (!name.empty() && name.size() <= kLongest &&
      std::isdigit(static_cast<unsigned char>(name[0])) == 0 &&
      std::all_of(name.begin(), name.end(), plain)) {
    return;
  }
  throw cli::ToolError(cli::kBadInput,
                       fmt::format("verp new controller: '{}' is no name; give up to {} letters, "
                                   "digits and _, a letter first",
                                   name, kLongest));
}

std::string filled_in(const std::string& text, const std::string& name) {
  static const std::regex kName("\\bNAME\\b"), kRoot("@VERP_ROOT@");
  return std::regex_replace(std::regex_replace(text, kName, name), kRoot,
                            files::source_dir().string());
}

std::string template_of(const std::string& file) {
  if (file == ".gitignore") return "build/\nreport/\n";
  const fs::path source = files::source_dir() / "host/run/own/template" / file;
  if (const std::optional<std::string> text = files::read(source)) return *text;
  throw cli::ToolError(
      cli::kBadInput,
      fmt::format("verp new controller: {} is not there: a controller is built on VERP's "
                  "sources, so begin with the ./verp of a clone",
                  source.string()));
}

int new_controller(const NewControllerWords& words) {
  check_name(words.name);
  std::error_code error;
  const fs::path folder = fs::absolute(words.in, error) / words.name;
  if (fs::exists(folder, error)) {
    throw cli::ToolError(cli::kBadInput,
                         fmt::format("{}: is there already; choose another name, or another "
                                     "place with --in",
                                     folder.lexically_normal().string()));
  }
  template_of(kFiles[0]);  // throws early
  fs::create_directories(folder, error);
  if (error) {
    throw cli::ToolError(cli::kBadInput,
                         fmt::format("{}: cannot be made ({}); choose another place with --in",
                                     folder.lexically_normal().string(), error.message()));
  }
  for (const char* file : kFiles) {
    if (files::write(folder / file, filled_in(template_of(file), words.name))) continue;
    throw cli::ToolError(cli::kBadInput,
                         fmt::format("{}: cannot be written; choose another place with --in",
                                     (folder / file).lexically_normal().string()));
  }
  const std::string place = (fs::path(words.in) / words.name).lexically_normal().string();
  cli::answer(fmt::format("{}: laid out; {}/README.md says what is where\n", place, place));
  cli::answer(
      fmt::format("`verp walk --controller {0}` walks it; with --on mps2_an386 on an emulated "
                  "board, and `verp flash --controller {0}` writes it into one\n",
                  place));
  return cli::kGood;
}

}  // namespace

cli::Subcommand add_new_controller(CLI::App& parent) {
  CLI::App* app = parent.add_subcommand(
      "controller",
      "a folder with a controller for the robots: walked, emulated and flashed by "
      "--controller");
  auto words = std::make_shared<NewControllerWords>();
  app->add_option("NAME", words->name, "of the controller, and of its folder")->required();
  app->add_option("--in", words->in, "folder (default: the working folder)");
  return {app, [words] { return new_controller(*words); }};
}

}  // namespace verp::tool
