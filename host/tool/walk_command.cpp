#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "host/model/find.hpp"
#include "host/model/load.hpp"
#include "host/model/params.hpp"
#include "host/report/report.hpp"
#include "host/tool/command.hpp"
#include "host/tool/interrupt.hpp"
#include "host/tool/walk_report.hpp"

namespace verp::tool {
namespace {

namespace fs = std::filesystem;

WalkPlan make_plan(const WalkOptions& options) {
  WalkPlan plan;
  plan.entity = model::load_robot(model::find_model(options.model));
  plan.params = model::make_params(plan.entity);
  apply_tuning(options, plan.params.tuning);
  plan.velocity = velocity_of(options, options.step_m);
  plan.walk_s = options.walk_s;
  plan.seed = options.seed;
  plan.board = options.board;
  return plan;
}

record::mcap::StringMap metadata(const WalkPlan& plan, const WalkOptions& options) {
  return {{"robot", plan.params.name},
          {"model_file", plan.entity.file},
          {"seed", std::to_string(plan.seed)},
          {"step_m", fmt::format("{}", options.step_m)},
          {"cycle_s", fmt::format("{}", options.cycle_s)},
          {"velocity", options.velocity_text},
          {"walk_s", fmt::format("{}", options.walk_s)},
          {"controller", options.board.empty() ? "this PC" : options.board}};
}

/// One walk with the multibody correction on or off.
WalkResult sweep_walk(WalkPlan plan, const WalkOptions& options, double step_m, bool multibody,
                      Progress& progress) {
  plan.velocity = velocity_of(options, step_m);
  plan.params.tuning.balance.multibody_enable = multibody ? 1.0f : 0.0f;
  const std::string label =
      fmt::format("step {:g} cm{}", 100 * step_m, multibody ? "" : ", no multibody");
  return walk(plan, nullptr, progress, label, false);
}

std::vector<report::SweepRow> sweep(const WalkPlan& plan, const WalkOptions& options,
                                    Progress& progress) {
  std::vector<report::SweepRow> rows;
  for (const double step_m : sweep_of(options)) {
    const WalkResult with = sweep_walk(plan, options, step_m, true, progress);
    const WalkResult without = sweep_walk(plan, options, step_m, false, progress);
    if (interrupted()) break;
    rows.push_back({step_m, with.metrics.speed_steady_m_s, with.metrics.zmp_bias_mean_mm,
                    without.metrics.zmp_bias_mean_mm, with.metrics.fallen, without.metrics.fallen});
  }
  return rows;
}

/// A trace in the report folder, unless it has a place of its own. Empty: none is wanted.
fs::path trace_file(const WalkOptions& options, const fs::path& folder) {
  if (!options.record_file.empty()) return options.record_file;
  return folder.empty() ? fs::path() : folder / "run.mcap";
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (fs::is_directory(folder)) return;
  throw ToolError(kBadInput,
                  fmt::format("{}: not a folder and cannot be made; choose another with --report",
                              folder.string()));
}

std::string write_report(const WalkPlan& plan, const WalkOptions& options, const WalkResult& result,
                         const std::vector<report::SweepRow>& rows, const fs::path& folder,
                         const fs::path& trace) {
  report::Run run = to_report(plan, options, result, rows);
  if (trace.parent_path() == folder) run.trace_file = trace.filename().string();
  const report::Written written = report::write_report(folder, run);
  if (!written.note.empty()) fmt::print(stderr, "{}\n", written.note);
  return written.page.string();
}

int run_walk(WalkOptions options) {
  const WalkPlan plan = make_plan(options);
  sweep_of(options);  // before the long run: a mistake in it is found now
  if (options.report_folder.empty() && !options.json) options.report_folder = "report";
  const fs::path folder = options.report_folder;
  if (!folder.empty()) make_folder(folder);

  const fs::path trace_path = trace_file(options, folder);
  std::unique_ptr<record::TraceWriter> trace;
  if (!trace_path.empty()) {
    trace = std::make_unique<record::TraceWriter>(
        trace_path, plan.params, metadata(plan, options),
        record::TraceOptions{.every_state = options.record_state});
  }
  Progress progress(!options.json);
  WalkResult result = walk(plan, trace.get(), progress, plan.params.name, !folder.empty());
  if (trace) {
    trace->close({{"digest", fmt::format("0x{:016x}", result.digest)},
                  {"failure", result.failure},
                  {"interrupted", result.interrupted ? "yes" : "no"}});
  }
  const std::vector<report::SweepRow> rows = sweep(plan, options, progress);
  progress.clear();
  result.interrupted = interrupted();  // in the walk or in the sweep
  for (const report::SweepRow& row : rows) {
    if (row.fallen && result.failure.empty()) {
      result.failure = fmt::format("fell in the sweep, at steps of {:g} m", row.step_m);
    }
  }

  std::string page;
  if (!folder.empty()) page = write_report(plan, options, result, rows, folder, trace_path);
  if (options.json) {
    Json json = to_json(plan, result, rows);
    if (!page.empty()) json["report"] = page;
    if (!trace_path.empty()) json["trace"] = trace_path.string();
    print_json(json);
  } else {
    fmt::print("{}", to_text(plan, result, rows));
    if (!page.empty()) fmt::print("  {:<18}{}\n", "report", page);
    if (!trace_path.empty()) fmt::print("  {:<18}{}\n", "trace", trace_path.string());
  }
  if (result.good() && !interrupted()) return kGood;
  fmt::print(stderr, "verp walk: {}{}\n", result.failure.empty() ? "interrupted" : result.failure,
             trace_path.empty()
                 ? ""
                 : fmt::format("; `verp trace export {}` shows the run", trace_path.string()));
  return kRunFailed;
}

}  // namespace

Subcommand add_walk(CLI::App& root) {
  CLI::App* app = root.add_subcommand("walk", "Walk in the twin: summary, trace and report");
  auto options = std::make_shared<WalkOptions>();
  declare(*app, *options);
  return {app, [options] { return run_walk(*options); }};
}

}  // namespace verp::tool
