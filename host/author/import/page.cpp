#include <fmt/format.h>

#include <filesystem>

#include "host/author/import/import.hpp"

namespace verp::import {
namespace {

namespace fs = std::filesystem;
using Sureness = Finding::Sureness;

const char* word(Sureness sureness) {
  return sureness == Sureness::kRead       ? "read"
         : sureness == Sureness::kMeasured ? "measured"
                                           : "**guessed**";
}

}  // namespace

std::string page_of(const Imported& robot, const Wish& wish) {
  std::string out = fmt::format(
      "# {}\n\nFrom `{}`, which is not changed. {}`robot.sdf` wraps it.\n\n", robot.name,
      fs::path(wish.maker_file.empty() ? wish.file : wish.maker_file).filename().string(),
      wish.maker_file.empty()
          ? ""
          : "`" + fs::path(wish.file).filename().string() + "` says the same as URDF; ");
  if (!robot.refusal.empty()) out += fmt::format("**It does not load yet:** {}\n\n", robot.refusal);
  if (!robot.picture.empty()) {
    out += fmt::format("![{0}, standing]({1})\n\n", robot.name, robot.picture);
  } else if (!robot.no_picture.empty()) {
    out += fmt::format("There is no picture: {}\n\n", robot.no_picture);
  }
  out += "| what | found | how | please check |\n|---|---|---|---|\n";
  for (const Finding& each : robot.findings)
    out += fmt::format("| {} | {} | {} | {} |\n", each.what, each.value, word(each.sureness),
                       each.check);
  if (!robot.left_out.empty()) out += "\n## Changed or left out\n\n";
  for (const std::string& each : robot.left_out) out += "- " + each + "\n";
  return out;
}

}  // namespace verp::import
