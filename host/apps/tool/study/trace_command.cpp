#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cstring>
#include <memory>

#include "host/apps/cli/console.hpp"
#include "host/apps/cli/interrupt.hpp"
#include "host/apps/cli/json.hpp"
#include "host/apps/cli/other_program.hpp"
#include "host/apps/tool/study/commands.hpp"
#include "host/apps/tool/study/trace_pictures.hpp"
#include "host/apps/tool/study/trace_words.hpp"
#include "host/apps/tool/walk_options.hpp"
#include "host/trace/record/trace_cut.hpp"
#include "host/trace/record/trace_writer.hpp"

namespace verp::tool {
namespace {

int info(const TraceWords& words) {
  const record::Trace trace = load_trace(words);
  const double duration_s = static_cast<double>(trace.ticks.size()) * trace.period_s();
  const std::string digest = fmt::format("0x{:016x}", trace.digest());
  if (words.json) {
    cli::Json metadata = cli::Json::object();
    for (const auto& [key, value] : trace.metadata) metadata[key] = value;
    cli::Json changes = cli::Json::array();
    for (const record::Change& each : trace.changes) {
      changes.push_back(
          {{"tick", each.tick}, {"time_s", each.tick * trace.period_s()}, {"what", each.what}});
    }
    cli::print_json(
        {{"trace", words.file},
         {"model", std::string(trace.params.name, ::strnlen(trace.params.name, kNameLength))},
         {"ticks", trace.ticks.size()},
         {"period_us", trace.params.period_us},
         {"duration_s", duration_s},
         {"joints", trace.params.joint_count},
         {"kept_states", trace.keyframes.size()},
         {"digest", digest},
         {"changes", changes},
         {"metadata", metadata}});
    return cli::kGood;
  }
  cli::answer(
      fmt::format("{}\n  {} ticks of {} us: {:.2f} s\n  {} joints, {} kept States\n  digest {}\n",
                  words.file, trace.ticks.size(), trace.params.period_us, duration_s,
                  trace.params.joint_count, trace.keyframes.size(), digest));
  for (const record::Change& each : trace.changes) {
    cli::answer(fmt::format("  after tick {}, {:.2f} s: {}\n", each.tick,
                            each.tick * trace.period_s(), each.what));
  }
  for (const auto& [key, value] : trace.metadata)
    cli::answer(fmt::format("  {}: {}\n", key, value));
  return cli::kGood;
}

int recover(const TraceWords& words) {
  refuse_same_file(words);
  const record::Trace trace = record::read_trace(words.file, record::Read::kRecover);
  record::mcap::StringMap run = trace.metadata;
  for (const auto& [key, value] : record::build_info()) {
    run["recorded_" + key] = run.contains(key) ? run[key] : "unknown";
    run.erase(key);
  }
  record::TraceWriter writer(
      words.output, trace.params, run,
      {.actions = trace.actions, .compress = words.compress, .before = trace.before});
  // A damaged trace's fault bits are unknown: states keep their places.
  std::size_t next = 0, change = 0;
  const auto write = [&] {
    for (std::size_t i = 0; i < trace.ticks.size(); ++i) {
      const bool kept = next < trace.keyframes.size() && trace.keyframes[next].index == i;
      writer.append(trace.ticks[i], kept ? &trace.keyframes[next].state : nullptr);
      next += kept ? 1 : 0;
      for (; change < trace.changes.size() &&
             trace.changes[change].tick == trace.ticks[i].inputs.tick;
           ++change) {
        writer.note(trace.changes[change].tick, trace.changes[change].what);
      }
    }
    writer.close({{"recovered_from", words.file}});
  };
  try {
    write();
  } catch (const record::TraceError&) {  // the original is intact
    writer.discard();
    throw;
  }
  cli::complain(trace.warning.empty() ? words.file + ": is whole" : trace.warning);
  cli::answer(fmt::format("{}: {} ticks\n", words.output, trace.ticks.size()));
  return cli::kGood;
}

int cut(const TraceWords& words) {
  refuse_same_file(words);
  if (!words.from_s && !words.to_s) {
    throw cli::ToolError(cli::kBadInput, "verp trace cut: give --from, --to, or both");
  }
  const record::Cut made =
      record::cut_trace(words.file, words.from_s, words.to_s, words.output, compression_of(words));
  std::string text = fmt::format("{}: {} ticks, {:.3f} s to {:.3f} s", words.output, made.ticks,
                                 made.first_s, made.last_s);
  if (words.from_s && made.first_s < *words.from_s) {
    text +=
        fmt::format("; begins {:.3f} s before --from, {}, so that it can be replayed",
                    *words.from_s - made.first_s,
                    made.from_state ? "at the last State that was kept" : "where the trace does");
  }
  cli::answer(text + '\n');
  return cli::kGood;
}

}  // namespace

cli::Subcommand add_trace(CLI::App& root) {
  CLI::App* app = cli::declare_other(root, "trace");
  app->require_subcommand(1);
  auto words = std::make_shared<TraceWords>();
  const auto add = [&](const char* name, const char* description) {
    CLI::App* inner = app->add_subcommand(name, description);
    inner->add_option("TRACE", words->file, "an .mcap file written by verp")->required();
    return inner;
  };
  const auto add_time = [&](CLI::App* inner) {
    const auto seconds = cli::number_between(0, 1e7, "s");
    inner->add_option("--from", words->from_s, "s, as `trace export` has it")->check(seconds);
    inner->add_option("--to", words->to_s, "s")->check(seconds);
  };
  CLI::App* show = add("info", "robot, length, digest, and how it was made");
  CLI::App* csv = add(
      "export", "ticks as CSV in SI units: what was measured, and what the controller made of it");
  csv->alias("csv");
  csv->add_option("-o,--output", words->output, "file; default: stdout");
  csv->add_flag("--state", words->states, "every field of the controller's State, too");
  CLI::App* plot = add("plot", "signals over time as a picture");
  plot->add_option("--signal", words->signals,
                   "a column of `trace export --state`, or some: 'rad.*knee*'; any number of times")
      ->expected(1)
      ->allow_extra_args(false)
      ->take_all();
  plot->add_flag("--list", words->list, "print the names of all signals instead");
  plot->add_option("-o,--output", words->output, "FILE.png or FILE.svg");
  CLI::App* part = add("cut", "a part of it as a trace of its own, which replays");
  part->add_option("-o,--output", words->output, "file")->required();
  for (CLI::App* inner : {plot, part}) add_time(inner);
  for (CLI::App* inner : {show, csv, plot}) {
    inner->add_flag("--recover", words->recover, "take what stands before a truncation or damage");
  }
  cli::add_json_flag(*show, words->json);
  CLI::App* mend =
      add("recover", "write what stands before a truncation or damage as a whole trace");
  mend->add_option("-o,--output", words->output, "file")->required();
  CLI::App* join = app->add_subcommand("merge", "several robots' traces as one file for viewers");
  join->add_option("TRACES", words->files,
                   "FILE or NAME=FILE of each robot: its topics and frames begin with NAME")
      ->required();
  join->add_option("-o,--output", words->output, "file")->required();
  for (CLI::App* inner : {part, mend, join}) {
    inner->add_flag("--compress", words->compress, kCompress);
  }
  CLI::App* pictures = add("pictures", "what its cameras saw (`verp walk --cameras`), as files");
  pictures->add_option("-o,--output", words->output, "folder")->required();
  CLI::App* again = add("play", "to viewers on this PC, as fast as it was: --live");
  declare_live(*again, words->live);
  words->live.on = true;
  again->add_option("--rate", words->rate, "times as fast as it was")
      ->check(cli::number_between(0.01, 100, ""))
      ->capture_default_str();
  return {app, [=] {
            if (again->parsed()) {
              cli::catch_interrupts();
              return play(*words);
            }
            if (show->parsed()) return info(*words);
            if (plot->parsed()) return plot_trace(*words);
            if (part->parsed()) return cut(*words);
            if (join->parsed()) return merge(*words);
            if (pictures->parsed()) return write_pictures(words->file, words->output);
            return csv->parsed() ? export_csv(*words) : recover(*words);
          }};
}

}  // namespace verp::tool
