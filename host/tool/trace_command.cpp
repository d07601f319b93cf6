#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <utility>

#include "host/files/csv_field.hpp"
#include "host/record/decisions.hpp"
#include "host/record/fields.hpp"
#include "host/record/joint_speeds.hpp"
#include "host/record/replay.hpp"
#include "host/record/trace_writer.hpp"
#include "host/tool/command.hpp"
#include "host/tool/console.hpp"
#include "host/tool/json.hpp"
#include "host/tool/trace_pictures.hpp"

namespace verp::tool {
namespace {

struct TraceCommandOptions {
  std::string file, output;
  bool json = false, recover = false, states = false;
};

std::string joint_name(const JointParams& joint) {
  return {joint.name, ::strnlen(joint.name, kNameLength)};
}

record::Trace load(const TraceCommandOptions& options) {
  record::Trace trace = record::read_trace(
      options.file, options.recover ? record::Read::kRecover : record::Read::kStrict);
  if (!trace.warning.empty()) complain(trace.warning);
  return trace;
}

void refuse_same_file(const TraceCommandOptions& options) {
  std::error_code error;
  if (options.output.empty() || !std::filesystem::equivalent(options.file, options.output, error)) {
    return;
  }
  throw ToolError(kBadInput,
                  options.output + ": that is the trace itself; name another file with -o");
}

int info(const TraceCommandOptions& options) {
  const record::Trace trace = load(options);
  const double duration_s = static_cast<double>(trace.ticks.size()) * trace.period_s();
  const std::string digest = fmt::format("0x{:016x}", trace.digest());
  if (options.json) {
    Json metadata = Json::object();
    for (const auto& [key, value] : trace.metadata) metadata[key] = value;
    Json changes = Json::array();
    for (const record::Change& each : trace.changes) {
      changes.push_back(
          {{"tick", each.tick}, {"time_s", each.tick * trace.period_s()}, {"what", each.what}});
    }
    print_json(
        {{"trace", options.file},
         {"model", std::string(trace.params.name, ::strnlen(trace.params.name, kNameLength))},
         {"ticks", trace.ticks.size()},
         {"period_us", trace.params.period_us},
         {"duration_s", duration_s},
         {"joints", trace.params.joint_count},
         {"kept_states", trace.keyframes.size()},
         {"digest", digest},
         {"changes", changes},
         {"metadata", metadata}});
    return kGood;
  }
  answer(
      fmt::format("{}\n  {} ticks of {} us: {:.2f} s\n  {} joints, {} kept States\n  digest {}\n",
                  options.file, trace.ticks.size(), trace.params.period_us, duration_s,
                  trace.params.joint_count, trace.keyframes.size(), digest));
  for (const record::Change& each : trace.changes) {
    answer(fmt::format("  after tick {}, {:.2f} s: {}\n", each.tick, each.tick * trace.period_s(),
                       each.what));
  }
  for (const auto& [key, value] : trace.metadata) answer(fmt::format("  {}: {}\n", key, value));
  return kGood;
}

void write_decision_names(const Params& params, bool states, std::ostream& out) {
  out << ",mode,gait_phase,gait_state,stance,faults,roll_rad,pitch_rad";
  for (int j = 0; j < params.joint_count; ++j) {
    out << ',' << files::csv_field("rad_s." + joint_name(params.joint[j]));
  }
  for (int j = 0; j < params.joint_count; ++j) {
    out << ',' << files::csv_field("goal_rad." + joint_name(params.joint[j]));
  }
  if (!states) return;
  for (const auto& [name, ignored] : record::print_fields(State{})) out << ",state." << name;
}

void write_decision(const Outputs* o, std::ostream& out) {
  if (o == nullptr) {
    out << ",,,,,,,";
    return;
  }
  out << fmt::format(",{},{},{},{},{},{:.4f},{:.4f}", o->mode, o->gait_phase, o->gait_state,
                     o->stance, o->faults, 1e-4 * o->tilt_tenth_mrad[0],
                     1e-4 * o->tilt_tenth_mrad[1]);
}

void tell_of_other_decisions(const record::Trace& trace, std::uint32_t tick) {
  complain(
      fmt::format("{}: from tick {} on this program decides otherwise than the one that "
                  "recorded it: goals and phases are left empty; `verp replay` names why",
                  trace.file.string(), tick));
}

/// One line a tick, SI units, sensor axes as the IMU has them.
void write_csv(const record::Trace& trace, bool states, std::ostream& out) {
  const Params& params = trace.params;
  out << "tick,time_s,flags";
  for (const char* axis : {"x", "y", "z"}) out << ",gyro_imu_rad_s." << axis;
  for (const char* axis : {"x", "y", "z"}) out << ",accel_imu_m_s2." << axis;
  for (const char* foot : {"left", "right"}) {
    for (int i = 0; i < kFootSensors; ++i) out << ",foot_n." << foot << i;
  }
  for (int j = 0; j < params.joint_count; ++j) {
    out << ',' << files::csv_field("rad." + joint_name(params.joint[j]));
  }
  write_decision_names(params, states, out);
  out << '\n';
  record::Decisions decisions(trace);
  bool told = false;
  record::JointSpeeds speeds(params);
  const std::size_t state_fields = states ? record::print_fields(State{}).size() : 0;
  for (const TickRecord& record : trace.ticks) {
    const Inputs& in = record.inputs;
    out << fmt::format("{},{:.6f},{}", in.tick, in.tick * trace.period_s(), in.flags);
    for (const auto count : in.gyro_count) {
      out << fmt::format(",{:.6g}", static_cast<float>(count) * params.imu.gyro_rad_s_per_count);
    }
    for (const auto count : in.accel_count) {
      out << fmt::format(",{:.6g}", static_cast<float>(count) * params.imu.accel_m_s2_per_count);
    }
    for (const auto& foot : in.foot_count) {
      for (const auto count : foot) {
        out << fmt::format(",{:.6g}", static_cast<float>(count) * params.feet.newton_per_count);
      }
    }
    for (int j = 0; j < params.joint_count; ++j) {
      out << fmt::format(",{:.6f}", record::ros::joint_rad(params.joint[j], in.position_count[j]));
    }
    const Outputs* made = decisions.at(record);
    if (made == nullptr && !std::exchange(told, true)) tell_of_other_decisions(trace, in.tick);
    write_decision(made, out);
    for (const double rad_s : speeds.after(in)) out << fmt::format(",{:.5g}", rad_s);
    for (int j = 0; j < params.joint_count; ++j) {
      out << (made == nullptr ? std::string(",")
                              : fmt::format(",{:.6f}", record::ros::joint_rad(
                                                           params.joint[j], made->goal_count[j])));
    }
    if (states && made != nullptr) {
      for (const auto& [name, value] : record::print_fields(decisions.state())) out << ',' << value;
    } else {
      out << std::string(state_fields, ',');
    }
    out << '\n';
  }
}

/// A file appears whole or not at all; devices and pipes get it as it comes.
void write_whole(const record::Trace& trace, bool states, const std::filesystem::path& file) {
  namespace fs = std::filesystem;
  std::error_code error;
  const bool direct = fs::exists(file, error) && !fs::is_regular_file(file, error);
  fs::path part = file;
  if (!direct) part += "." + std::to_string(::getpid()) + ".part";
  std::ofstream out(part);
  if (!out) {
    throw ToolError(
        kBadInput, file.string() + ": cannot be written; choose a folder that exists and is yours");
  }
  write_csv(trace, states, out);
  out.close();
  if (out && !direct) fs::rename(part, file, error);
  if (out && (direct || !error)) return;
  if (!direct) fs::remove(part, error);
  throw ToolError(kRunFailed,
                  file.string() + ": cannot be written to its end; free space, or write elsewhere");
}

int export_csv(const TraceCommandOptions& options) {
  refuse_same_file(options);
  const record::Trace trace = load(options);
  if (options.output.empty() || options.output == "-") {
    write_csv(trace, options.states, std::cout);
    return kGood;
  }
  write_whole(trace, options.states, options.output);
  return kGood;
}

int recover(const TraceCommandOptions& options) {
  refuse_same_file(options);
  const record::Trace trace = record::read_trace(options.file, record::Read::kRecover);
  record::mcap::StringMap run = trace.metadata;
  for (const auto& [key, value] : record::build_info()) {
    run["recorded_" + key] = run.contains(key) ? run[key] : "unknown";
    run.erase(key);
  }
  record::TraceWriter writer(options.output, trace.params, run, {.actions = trace.actions});
  // States are kept again where they stand; a damaged trace's fault bits are not known, so only
  // those.
  std::size_t next = 0, change = 0;
  for (std::size_t i = 0; i < trace.ticks.size(); ++i) {
    const bool kept = next < trace.keyframes.size() && trace.keyframes[next].index == i;
    writer.append(trace.ticks[i], kept ? &trace.keyframes[next].state : nullptr);
    next += kept ? 1 : 0;
    for (;
         change < trace.changes.size() && trace.changes[change].tick == trace.ticks[i].inputs.tick;
         ++change) {
      writer.note(trace.changes[change].tick, trace.changes[change].what);
    }
  }
  writer.close({{"recovered_from", options.file}});
  complain(trace.warning.empty() ? options.file + ": is whole" : trace.warning);
  answer(fmt::format("{}: {} ticks\n", options.output, trace.ticks.size()));
  return kGood;
}

}  // namespace

Subcommand add_trace(CLI::App& root) {
  CLI::App* app =
      root.add_subcommand("trace", "Look into a trace, export it, recover what a crash left");
  app->require_subcommand(1);
  auto options = std::make_shared<TraceCommandOptions>();
  const auto add = [&](const char* name, const char* description) {
    CLI::App* inner = app->add_subcommand(name, description);
    inner->add_option("TRACE", options->file, "an .mcap file written by verp")->required();
    return inner;
  };
  CLI::App* show = add("info", "robot, length, digest, and how it was made");
  CLI::App* csv = add(
      "export", "ticks as CSV in SI units: what was measured, and what the controller made of it");
  csv->add_option("-o,--output", options->output, "file; default: stdout");
  csv->add_flag("--state", options->states, "every field of the controller's State, too");
  for (CLI::App* inner : {show, csv}) {
    inner->add_flag("--recover", options->recover,
                    "take what stands before a truncation or damage");
  }
  add_json_flag(*show, options->json);
  CLI::App* mend =
      add("recover", "write what stands before a truncation or damage as a whole trace");
  mend->add_option("-o,--output", options->output, "file")->required();
  CLI::App* pictures = add("pictures", "what its cameras saw (`verp walk --cameras`), as files");
  pictures->add_option("-o,--output", options->output, "folder")->required();
  return {app, [=] {
            if (show->parsed()) return info(*options);
            if (pictures->parsed()) return write_pictures(options->file, options->output);
            return csv->parsed() ? export_csv(*options) : recover(*options);
          }};
}

}  // namespace verp::tool
