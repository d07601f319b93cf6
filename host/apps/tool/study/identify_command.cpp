#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <memory>
#include <numbers>

#include "host/apps/cli/console.hpp"
#include "host/apps/cli/exit_status.hpp"
#include "host/apps/cli/interrupt.hpp"
#include "host/apps/cli/json.hpp"
#include "host/apps/cli/other_program.hpp"
#include "host/apps/cli/progress.hpp"
#include "host/apps/tool/study/commands.hpp"
#include "host/os/files/whole.hpp"
#include "host/robot/model/find.hpp"
#include "host/robot/model/load.hpp"
#include "host/study/identify/identify.hpp"
#include "host/study/identify/motion.hpp"
#include "host/study/identify/words.hpp"
#include "host/study/identify/write.hpp"
#include "host/trace/record/trace.hpp"

namespace verp::tool {
namespace {

constexpr const char* kRobotOfMotion = "generic21";

struct IdentifyWords {
  std::string trace, robot, type, file, motion;
  double motion_s = 60;
  bool json = false;
};

/// A new file in a writable folder; checked before the fit, which takes minutes.
void require_place(const std::string& file) {
  if (std::filesystem::exists(file))
    throw cli::ToolError(cli::kBadInput, file + ": is there already; choose another name");
  const std::filesystem::path folder = std::filesystem::absolute(file).parent_path();
  if (!std::filesystem::is_directory(folder))
    throw cli::ToolError(cli::kBadInput,
                         fmt::format("{}: there is no folder {}", file, folder.string()));
  if (::access(folder.c_str(), W_OK) != 0)
    throw cli::ToolError(cli::kBadInput,
                         fmt::format("{}: {} takes no files of yours", file, folder.string()));
}

int make_motion(const IdentifyWords& words) {
  if (!words.motion.ends_with(".action"))
    throw cli::ToolError(cli::kBadInput, words.motion + ": motions end in .action; name it so");
  require_place(words.motion);
  const model::Entity entity =
      model::load_robot(model::find_model(words.robot.empty() ? kRobotOfMotion : words.robot));
  action::Document document = identify::motion_of(entity, {.length_s = words.motion_s, .seed = 1});
  document.name = std::filesystem::path(words.motion).stem().string();
  const files::Trouble trouble = files::replace(words.motion, action::text_of(document));
  if (trouble.any()) throw cli::ToolError(cli::kBadInput, words.motion + ": " + trouble.text());
  cli::print_answer(
      words.json, {{"motion", words.motion}, {"model", entity.name}},
      fmt::format("{}: a motion of {:.0f} s for {} in a stand; in the twin:\n"
                  "  verp action play {} --robot {} --held --gains 25 --record a.mcap\n",
                  words.motion, words.motion_s, entity.name, words.motion,
                  words.robot.empty() ? kRobotOfMotion : words.robot));
  return cli::kGood;
}

cli::Json json_of(const identify::Result& result) {
  constexpr double kDegrees = 180 / std::numbers::pi;
  cli::Json rows = cli::Json::array();
  for (const identify::Row& row : result.rows) {
    rows.push_back({{"number", row.name},
                    {"unit", row.unit},
                    {"was", row.was},
                    {"now", row.determined ? cli::Json(row.now) : cli::Json()},
                    {"error", row.determined ? cli::Json(row.error) : cli::Json()}});
  }
  const auto errors = [&](const identify::Errors& each) {
    return cli::Json{{"before_deg", kDegrees * each.before_rad},
                     {"after_deg", kDegrees * each.after_rad}};
  };
  return {{"type", result.type},
          {"joints", result.joints},
          {"length_s", result.length_s},
          {"fitted_until_s", result.fitted_until_s},
          {"numbers", rows},
          {"fitted", errors(result.fitted)},
          {"held_out", errors(result.held_out)}};
}

int run_identify(const IdentifyWords& words) {
  if (!words.motion.empty()) return make_motion(words);
  if (words.trace.empty()) {
    throw cli::ToolError(cli::kBadInput,
                         "verp identify: no trace; give one, or --motion FILE for what to record");
  }
  if (!words.file.empty()) require_place(words.file);
  const record::Trace trace = record::read_trace(words.trace);
  const std::filesystem::path file =
      model::find_model(words.robot.empty() ? std::string(trace.params.name) : words.robot);
  const model::Entity entity = model::load_robot(file);
  cli::catch_interrupts();
  cli::Progress progress(!words.json);
  survey::Watch watch;
  watch.interrupted = cli::interrupted;
  watch.went_on = [&](double share) { progress.show(share, "twins told what the robot was told"); };
  const identify::Result result =
      identify::identify(entity, trace, {.type = words.type, .held_out = 0.25}, watch);
  progress.clear();
  if (result.interrupted) throw cli::ToolError(cli::kRunFailed, "verp identify: interrupted");
  cli::Json json = json_of(result);
  std::string text = identify::text_of(result);
  if (!words.file.empty()) {
    const std::string type =
        identify::write(result, file, words.file, "verp identify " + words.trace);
    json["file"] = words.file;
    json["written_type"] = type;
    text += fmt::format("{}: the robot with servos of type {}\n", words.file, type);
  }
  cli::print_answer(words.json, json, text);
  return cli::kGood;
}

}  // namespace

cli::Subcommand add_identify(CLI::App& root) {
  CLI::App* app = cli::declare_other(root, "identify");
  auto words = std::make_shared<IdentifyWords>();
  app->add_option("TRACE", words->trace, "a trace of the robot in a stand, all joints moving");
  app->add_option("--robot", words->robot,
                  "the robot by its name, or the path of its SDF file; default: by the trace");
  app->add_option("--type", words->type, "of the servos, where the robot has several");
  app->add_option("--write", words->file, "write the robot's file with the new numbers there");
  app->add_option("--motion", words->motion, "write a motion to record there (NAME.action)")
      ->excludes("TRACE")
      ->excludes("--write");
  app->add_option("--for", words->motion_s, "length of that motion, s")
      ->check(cli::number_between(5, 240, "s"))
      ->capture_default_str();
  cli::add_json_flag(*app, words->json);
  return {app, [words] { return run_identify(*words); }};
}

}  // namespace verp::tool
