#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "host/apps/cli/console.hpp"
#include "host/apps/cli/exit_status.hpp"
#include "host/apps/cli/json.hpp"
#include "host/apps/tool/commands.hpp"
#include "host/apps/tool/own_controller.hpp"
#include "host/show/web/replay_page.hpp"
#include "host/study/report/files.hpp"
#include "host/trace/record/replay.hpp"
#include "host/trace/record/trace_parts.hpp"

namespace verp::tool {
namespace {

cli::Json to_json(const record::Divergence& divergence, const Params& params, const char* left,
                  const char* right) {
  cli::Json json = {{"tick", divergence.tick},
                    {"time_s", divergence.tick * (params.period_us * 1e-6)},
                    {"stage", divergence.stage},
                    {"field", nullptr},
                    {std::string("digest_") + left, divergence.left_digest},
                    {std::string("digest_") + right, divergence.right_digest},
                    {"fields_tick", divergence.fields_tick},
                    {"fields", cli::Json::array()}};
  if (!divergence.fields.empty()) json["field"] = divergence.fields.front().path;
  for (const record::FieldDifference& field : divergence.fields) {
    json["fields"].push_back({{"field", field.path}, {left, field.left}, {right, field.right}});
  }
  return json;
}

record::Trace load(const std::string& file, bool recover) {
  record::Trace trace =
      record::read_trace(file, recover ? record::Read::kRecover : record::Read::kStrict);
  if (!trace.warning.empty()) cli::complain(trace.warning);
  return trace;
}

struct ReplayOptions {
  std::string file, page, controller;
  bool json = false, recover = false;
};

int make_page(const ReplayOptions& options) {
  if (std::filesystem::path(options.page).extension() != ".html") {
    throw cli::ToolError(cli::kBadInput,
                         fmt::format("verp replay --page {}: a browser shows what ends in "
                                     ".html; name it so",
                                     options.page));
  }
  const web::Replay replay = web::replay_of(options.file);
  if (replay.html.empty())
    throw cli::ToolError(cli::kNoDevice, "verp replay --page: " + replay.note);
  if (!replay.note.empty()) cli::complain(replay.note);
  report::write_file(
      options.page,
      web::page_of(std::filesystem::path(options.file).filename().string(), replay.html));
  cli::print_answer(options.json, {{"trace", options.file}, {"page", options.page}},
                    options.page + "\n");
  return cli::kGood;
}

void refuse_other_controller(const ReplayOptions& options, const record::Trace& trace) {
  const auto recorded_by = trace.metadata.find("own_controller");
  if (!options.controller.empty() || recorded_by == trace.metadata.end() ||
      recorded_by->second.empty()) {
    return;
  }
  throw cli::ToolError(cli::kBadInput,
                       fmt::format("{}: was decided by a controller of somebody's own; "
                                   "replay it with --controller {}",
                                   options.file, recorded_by->second));
}

int run_replay(const ReplayOptions& options) {
  if (!options.page.empty()) return make_page(options);
  record::TraceFile file(options.file,
                         options.recover ? record::Read::kRecover : record::Read::kStrict);
  const record::Trace& trace = file.head();
  if (!trace.warning.empty()) cli::complain(trace.warning);
  refuse_other_controller(options, trace);
  record::StepFunction core;
  if (!options.controller.empty()) core = own_controller(options.controller, !options.json)();
  const record::ReplayResult result = record::replay(file, core);
  const bool equal = !result.divergence;
  if (options.json) {
    cli::Json json = {{"trace", options.file},
                      {"ticks", result.ticks},
                      {"equal", equal},
                      {"digest_recorded", fmt::format("0x{:016x}", result.recorded_digest)},
                      {"digest_replayed", fmt::format("0x{:016x}", result.replayed_digest)},
                      {"divergence", nullptr}};
    if (!equal)
      json["divergence"] = to_json(*result.divergence, trace.params, "recorded", "replayed");
    cli::print_json(json);
  } else if (equal) {
    cli::answer(
        fmt::format("{}: {} ticks ({:.2f} s), every stage the same bits, digest 0x{:016x}\n",
                    options.file, result.ticks,
                    static_cast<double>(result.ticks) * trace.period_s(), result.replayed_digest));
  }
  if (equal) return cli::kGood;
  const auto revision = trace.metadata.find("source_revision");
  const std::string version = record::core_of(trace);
  const auto build = record::build_info();
  cli::complain(
      fmt::format("{}: diverges at {}; it was recorded by revision {}{}, this is {}{}",
                  options.file, text(*result.divergence, trace.params, "recorded", "replayed"),
                  revision == trace.metadata.end() ? "unknown" : revision->second,
                  version.empty() ? "" : " with core " + version, build.at("source_revision"),
                  version.empty() ? "" : " with core " + build.at("core_version")));
  return cli::kRunFailed;
}

struct DiffOptions {
  std::string left, right;
  bool json = false, recover = false;
};

/// Different cores differ by intention; empty: same core, or unknown.
std::string of_two_cores(const std::string& a, const std::string& b) {
  if (a == b || a.empty() || b.empty()) return "";
  return fmt::format("; A is of core {} and B of core {}, which decide otherwise", a, b);
}

int run_diff(const DiffOptions& options) {
  const record::Trace left = load(options.left, options.recover);
  const record::Trace right = load(options.right, options.recover);
  const auto divergence = record::diff(left, right);
  const std::string core_a = record::core_of(left), core_b = record::core_of(right);
  if (options.json) {
    cli::Json json = {{"a", options.left},
                      {"b", options.right},
                      {"equal", !divergence},
                      {"ticks_a", left.ticks.size()},
                      {"ticks_b", right.ticks.size()},
                      {"core_a", core_a.empty() ? cli::Json() : cli::Json(core_a)},
                      {"core_b", core_b.empty() ? cli::Json() : cli::Json(core_b)},
                      {"divergence", nullptr}};
    if (divergence) json["divergence"] = to_json(*divergence, left.params, "a", "b");
    cli::print_json(json);
  } else if (!divergence) {
    cli::answer(fmt::format("{} and {}: equal, {} ticks, digest 0x{:016x}\n", options.left,
                            options.right, left.ticks.size(), left.digest()));
  } else {
    cli::answer(fmt::format("{} and {} differ at {}{}\n", options.left, options.right,
                            text(*divergence, left.params, "A", "B"),
                            of_two_cores(core_a, core_b)));
  }
  return divergence ? cli::kRunFailed : cli::kGood;
}

}  // namespace

cli::Subcommand add_replay(CLI::App& root) {
  CLI::App* app = root.add_subcommand(
      "replay", "Re-run the controller on a trace's inputs; exit 1 names the first difference");
  auto options = std::make_shared<ReplayOptions>();
  app->add_option("TRACE", options->file, "an .mcap file written by verp")->required();
  app->add_flag("--recover", options->recover, "take what stands before a truncation or damage");
  declare_controller(*app, options->controller);
  app->add_option("--page", options->page,
                  "write a page that shows the run in 3D instead, for any browser (.html)");
  cli::add_json_flag(*app, options->json);
  return {app, [options] { return run_replay(*options); }};
}

cli::Subcommand add_diff(CLI::App& root) {
  CLI::App* app = root.add_subcommand(
      "diff", "Name the first difference of two traces: robot, input, stage, field; exit 1 if any");
  auto options = std::make_shared<DiffOptions>();
  app->add_option("A", options->left, "a trace")->required();
  app->add_option("B", options->right, "another trace")->required();
  app->add_flag("--recover", options->recover, "take what stands before a truncation or damage");
  cli::add_json_flag(*app, options->json);
  return {app, [options] { return run_diff(*options); }};
}

}  // namespace verp::tool
