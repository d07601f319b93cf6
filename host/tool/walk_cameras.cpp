#include "host/tool/walk_cameras.hpp"

#include <fmt/format.h>

#include "host/tool/exit_status.hpp"

namespace verp::tool {
namespace {

record::TraceWriter& need_trace(const WalkPlan& plan, record::TraceWriter* trace) {
  if (plan.entity.cameras.empty()) {
    throw ToolError(kBadInput,
                    fmt::format("verp walk: --cameras: {} has none; give one of its links in {} a "
                                "<sensor type=\"camera\">",
                                plan.entity.name, plan.entity.file));
  }
  if (trace != nullptr) return *trace;
  throw ToolError(
      kBadInput,
      "verp walk: --cameras: pictures go into a trace, and there is none; give --record");
}

}  // namespace

WalkCameras::WalkCameras(const WalkOptions& options, WalkPlan& plan,
                         const std::vector<WalkPlan>& others, const sim::WorldOptions& world,
                         record::TraceWriter* trace)
    : trace_(need_trace(plan, trace)) {
  plan.twin.cameras = true;
  camera::Stage stage{.robots = {{plan.entity.file, plan.twin.seed}},
                      .world_file = world.scenery == nullptr ? "" : world.scenery->file};
  for (const WalkPlan& other : others) stage.robots.push_back({other.entity.file, other.twin.seed});
  const auto pace =
      options.real_time ? camera::Rig::Pace::kNeverWaits : camera::Rig::Pace::kEveryPicture;
  try {
    rig_ = std::make_unique<camera::Rig>(camera::find_program(), stage, pace);
  } catch (const camera::CameraError& error) {
    throw ToolError(kNoDevice, error.what());
  }
}

void WalkCameras::watch(const WalkPlan& plan, session::Hooks& hooks) {
  recorder_ = std::make_unique<camera::Recorder>(*rig_, plan.entity, plan.params, trace_);
  hooks.exposed = [this](const sim::Exposure& exposure, std::uint64_t stamp_ns) {
    recorder_->exposed(exposure, stamp_ns);
  };
}

void WalkCameras::finish() {
  recorder_->finish();
}

std::string WalkCameras::text(double run_s) const {
  std::string out = fmt::format("  {:<18}{} pictures, {:.2f} of a core while it walked", "cameras",
                                recorder_->pictures(), rig_->processor_s() / run_s);
  if (rig_->dropped() > 0) out += fmt::format("; {} left out to keep real time", rig_->dropped());
  return out + "\n";
}

Json WalkCameras::json() const {
  return {{"pictures", recorder_->pictures()},
          {"dropped", rig_->dropped()},
          {"processor_s", rig_->processor_s()}};
}

}  // namespace verp::tool
