#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "host/apps/cli/command.hpp"
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
#include "host/robot/model/load_error.hpp"
#include "host/run/scenario/expand.hpp"
#include "host/study/survey/interval.hpp"
#include "host/study/tune/tune.hpp"
#include "host/study/tune/write.hpp"

namespace verp::tool {
namespace {

constexpr int kQuickGenerations = 8, kGenerations = 40;
constexpr int kQuickChecks = 10, kChecks = 30;
constexpr double kPhysicsStep_ms = 2;  // `verp walk` has 1 ms

struct TuneWords {
  std::string model, file;
  double speed_m_s = 0.2;
  std::uint64_t seed = 1;
  bool quick = false, json = false;
};

cli::Json json_of(const tune::Check& check) {
  const survey::Interval share = survey::interval_of(static_cast<std::uint64_t>(check.walked),
                                                     static_cast<std::uint64_t>(check.of));
  return {{"walked", check.walked},
          {"of", check.of},
          {"interval", {share.low, share.high}},
          {"zmp_bias_mm", check.bias_mm ? cli::Json(*check.bias_mm) : cli::Json()},
          {"speed_m_s", check.speed_m_s ? cli::Json(*check.speed_m_s) : cli::Json()}};
}

cli::Json json_of(const tune::Result& result, const TuneWords& words) {
  cli::Json numbers = cli::Json::array();
  for (const tune::Number& each : result.numbers)
    numbers.push_back({{"number", each.name},
                       {"was", std::stod(fmt::format("{}", each.was))},
                       {"now", std::stod(fmt::format("{}", each.now))}});
  return {
      {"asked_m_s", words.speed_m_s},   {"numbers", numbers},    {"before", json_of(result.before)},
      {"after", json_of(result.after)}, {"limit", result.limit}, {"walks", result.walks}};
}

std::string text_of(const char* when, const tune::Check& check) {
  const survey::Interval share = survey::interval_of(static_cast<std::uint64_t>(check.walked),
                                                     static_cast<std::uint64_t>(check.of));
  std::string text = fmt::format("  {:<8}{:>3} of {} random robots walk ({:.0f} to {:.0f} %)", when,
                                 check.walked, check.of, 100 * share.low, 100 * share.high);
  if (check.bias_mm) {
    text += fmt::format(", ZMP bias {:.1f} mm, {:.3f} m/s", *check.bias_mm,
                        check.speed_m_s.value_or(0));
  }
  return text + "\n";
}

std::string text_of(const tune::Result& result, const TuneWords& words, const std::string& name) {
  std::string text = fmt::format("{}: {} walks at {:g} m/s\n", name, result.walks, words.speed_m_s);
  for (const tune::Number& each : result.numbers)
    text += fmt::format("  {:<28}{:>10.4g} -> {:.4g}\n", each.name, each.was, each.now);
  if (result.numbers.empty()) text += "  nothing better was found than the numbers it has\n";
  text += text_of("before", result.before);
  if (!result.numbers.empty()) text += text_of("after", result.after);
  return text;
}

std::filesystem::path folder_of(const std::filesystem::path& file) {
  return std::filesystem::weakly_canonical(std::filesystem::absolute(file)).parent_path();
}

/// Checked before the search: the robot's file can be written there and loads with its includes.
void require_place(const std::string& file, const std::filesystem::path& robot_file) {
  std::error_code error;
  if (std::filesystem::exists(file, error))
    throw cli::ToolError(cli::kBadInput, file + ": is there already; choose another name");
  const files::Trouble trouble = files::create(file, files::read(robot_file).value_or(""));
  if (trouble.any()) throw cli::ToolError(cli::kBadInput, file + ": " + trouble.text());
  try {
    model::load_robot_on_any_bus(file, "");
  } catch (const model::LoadError& refused) {
    std::filesystem::remove(file, error);
    throw cli::ToolError(cli::kBadInput,
                         fmt::format("verp tune: --write {}: {}; write it beside {}", file,
                                     refused.what(), robot_file.string()));
  }
  std::filesystem::remove(file, error);
}

int run_tune(const TuneWords& words) {
  const std::filesystem::path robot_file = model::find_model(words.model);
  if (!words.file.empty()) require_place(words.file, robot_file);
  scenario::Robot robot;
  robot.orders = scenario::Velocity{.vx_m_s = words.speed_m_s, .vy_m_s = 0, .wz_rad_s = 0};
  const session::WalkPlan plan =
      scenario::plan_of(robot, 0, model::load_robot_on_any_bus(robot_file, ""));
  const sim::WorldOptions world =
      scenario::world_of({.file = {}, .physics_step_ms = kPhysicsStep_ms});
  cli::catch_interrupts();
  cli::Progress progress(!words.json);
  survey::Watch watch;
  watch.interrupted = cli::interrupted;
  watch.went_on = [&](double share) { progress.show(share, "walks in the twin"); };
  const tune::Result result =
      tune::tune(plan, world,
                 {.speed_m_s = words.speed_m_s,
                  .generations = words.quick ? kQuickGenerations : kGenerations,
                  .checks = words.quick ? kQuickChecks : kChecks,
                  .seed = words.seed},
                 watch);
  progress.clear();
  if (result.interrupted) throw cli::ToolError(cli::kRunFailed, "verp tune: interrupted");
  cli::Json json = json_of(result, words);
  std::string text = text_of(result, words, plan.entity.name);
  if (!words.file.empty() && result.limit.empty()) {
    tune::write(result.numbers, robot_file, words.file);
    json["file"] = words.file;
    text += fmt::format("{0}: the robot with these numbers; verp walk {0} --velocity {1:g},0,0\n",
                        words.file, words.speed_m_s);
    if (folder_of(words.file) != folder_of(robot_file))
      text += "its actions stay where they are: copy the folder `actions`, too\n";
  }
  cli::print_answer(words.json, json, text);
  if (result.limit.empty()) return cli::kGood;
  cli::complain(
      fmt::format("verp tune: {} walks at {:g} m/s with nothing that was tried; what stops it "
                  "is {}",
                  plan.entity.name, words.speed_m_s, result.limit));
  return cli::kRunFailed;
}

}  // namespace

cli::Subcommand add_tune(CLI::App& root) {
  CLI::App* app = cli::declare_other(root, "tune");
  auto words = std::make_shared<TuneWords>();
  cli::add_model(*app, words->model)->required();
  app->add_option("--speed", words->speed_m_s, "to walk ahead at, m/s")
      ->check(cli::number_between(0.02, 2, "m/s"))
      ->capture_default_str();
  app->add_flag("--quick", words->quick, "a first gait, in minutes");
  app->add_option("--write", words->file, "write the robot's file with the new numbers there");
  app->add_option("--seed", words->seed, "of the search")
      ->check(cli::whole_number_between(0, 4294967295))
      ->capture_default_str();
  cli::add_json_flag(*app, words->json);
  return {app, [words] { return run_tune(*words); }};
}

}  // namespace verp::tool
