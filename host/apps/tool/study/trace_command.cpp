#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cstring>
#include <memory>
#include <vector>

#include "host/apps/cli/console.hpp"
#include "host/apps/cli/interrupt.hpp"
#include "host/apps/cli/json.hpp"
#include "host/apps/cli/other_program.hpp"
#include "host/apps/tool/study/commands.hpp"
#include "host/apps/tool/study/trace_pictures.hpp"
#include "host/apps/tool/study/trace_words.hpp"
#include "host/apps/tool/walk_options.hpp"
#include "host/trace/record/trace_cut.hpp"
#include "host/trace/record/trace_parts.hpp"
#include "host/trace/record/trace_recover.hpp"

namespace verp::tool {
namespace {

struct Story {
  std::uint64_t digest = 0;
  std::size_t kept_states = 0;
  std::vector<record::Change> changes;
};

Story story_of(record::TraceFile& trace) {
  Story story{trace.head().digest(), 0, {}};
  std::uint32_t tick = 0;
  trace.read({.tick =
                  [&](const TickRecord& record) {
                    tick = record.inputs.tick;
                    story.digest = record.digest.chain;
                  },
              .keyframe = [&](const State&) { ++story.kept_states; },
              .change =
                  [&](const std::string& what) {
                    story.changes.push_back({tick, what});
                  },
              .body = {},
              .objects = {}});
  return story;
}

cli::Json json_of(const TraceWords& words, const record::TraceFile& trace, const Story& story) {
  const record::Trace& head = trace.head();
  cli::Json metadata = cli::Json::object();
  for (const auto& [key, value] : head.metadata) metadata[key] = value;
  cli::Json changes = cli::Json::array();
  for (const record::Change& each : story.changes) {
    changes.push_back(
        {{"tick", each.tick}, {"time_s", each.tick * head.period_s()}, {"what", each.what}});
  }
  return {{"trace", words.file},
          {"model", std::string(head.params.name, ::strnlen(head.params.name, kNameLength))},
          {"ticks", trace.ticks()},
          {"period_us", head.params.period_us},
          {"duration_s", static_cast<double>(trace.ticks()) * head.period_s()},
          {"joints", head.params.joint_count},
          {"kept_states", story.kept_states},
          {"digest", fmt::format("0x{:016x}", story.digest)},
          {"changes", changes},
          {"metadata", metadata}};
}

int info(const TraceWords& words) {
  record::TraceFile trace(words.file,
                          words.recover ? record::Read::kRecover : record::Read::kStrict);
  const record::Trace& head = trace.head();
  if (!head.warning.empty()) cli::complain(head.warning);
  const Story story = story_of(trace);
  if (words.json) {
    cli::print_json(json_of(words, trace, story));
    return cli::kGood;
  }
  cli::answer(fmt::format(
      "{}\n  {} ticks of {} us: {:.2f} s\n  {} joints, {} kept States\n  digest 0x{:016x}\n",
      words.file, trace.ticks(), head.params.period_us,
      static_cast<double>(trace.ticks()) * head.period_s(), head.params.joint_count,
      story.kept_states, story.digest));
  for (const record::Change& each : story.changes) {
    cli::answer(fmt::format("  after tick {}, {:.2f} s: {}\n", each.tick,
                            each.tick * head.period_s(), each.what));
  }
  for (const auto& [key, value] : head.metadata) cli::answer(fmt::format("  {}: {}\n", key, value));
  return cli::kGood;
}

int recover(const TraceWords& words) {
  refuse_same_file(words);
  const record::Recovered made =
      record::recover_trace(words.file, words.output, compression_of(words));
  cli::complain(made.warning.empty() ? words.file + ": is whole" : made.warning);
  cli::answer(fmt::format("{}: {} ticks, {} messages of {} channels\n", words.output, made.ticks,
                          made.messages, made.channels));
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
      add("recover", "write every whole message of a cut or damaged trace as a whole trace");
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
