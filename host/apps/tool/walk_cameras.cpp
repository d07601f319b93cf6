#include "host/apps/tool/walk_cameras.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "host/apps/cli/exit_status.hpp"
#include "host/show/camera/recorder.hpp"

namespace verp::tool {
namespace {

record::TraceWriter& need_trace(const WalkPlan& plan, record::TraceWriter* trace) {
  if (plan.entity.cameras.empty()) {
    throw cli::ToolError(
        cli::kBadInput,
        fmt::format("verp walk: --cameras: {} has none; give one of its links in {} a "
                    "<sensor type=\"camera\">",
                    plan.entity.name, plan.entity.file));
  }
  if (trace != nullptr) return *trace;
  throw cli::ToolError(
      cli::kBadInput,
      "verp walk: --cameras: pictures go into a trace, and there is none; give --record");
}

}  // namespace

struct WalkCameras::Seen {
  record::TraceWriter& trace;
  std::unique_ptr<camera::Rig> rig = {};
  std::unique_ptr<camera::Recorder> recorder = {};
};

WalkCameras::WalkCameras(Walk& walk, record::TraceWriter* trace)
    : seen_(new Seen{need_trace(walk.run.plans.front(), trace)}) {
  walk.run.plans.front().twin.cameras = true;
  const sim::WorldOptions& world = walk.run.world;
  camera::Stage stage{.robots = {},
                      .world_file = world.scenery == nullptr ? "" : world.scenery->file};
  for (const WalkPlan& plan : walk.run.plans)
    stage.robots.push_back({plan.entity.file, plan.twin.seed});
  const auto pace =
      walk.scenario.real_time ? camera::Rig::Pace::kNeverWaits : camera::Rig::Pace::kEveryPicture;
  try {
    seen_->rig = std::make_unique<camera::Rig>(camera::find_program(), stage, pace);
  } catch (const camera::CameraError& error) {
    throw cli::ToolError(cli::kNoDevice, error.what());
  }
}

WalkCameras::~WalkCameras() = default;

void WalkCameras::join(std::size_t index, const WalkPlan& plan, session::Hooks& hooks) {
  if (index != 0) return;
  seen_->recorder =
      std::make_unique<camera::Recorder>(*seen_->rig, plan.entity, plan.params, seen_->trace);
  hooks.exposed = [this](const sim::Exposure& exposure, std::uint64_t stamp_ns) {
    seen_->recorder->exposed(exposure, stamp_ns);
  };
}

void WalkCameras::end(session::Session&) {
  seen_->recorder->finish();
}

std::string WalkCameras::text(double run_s) const {
  const auto pictures =
      static_cast<double>(std::max<std::uint64_t>(1, seen_->recorder->pictures()));
  std::string out =
      fmt::format("  {:<18}{} pictures, {:.1f} ms of a core each, {:.2f} of a core while it walked",
                  "cameras", seen_->recorder->pictures(),
                  1e3 * seen_->rig->processor_s() / pictures, seen_->rig->processor_s() / run_s);
  if (seen_->rig->dropped() > 0)
    out += fmt::format("; {} left out to keep real time", seen_->rig->dropped());
  return out + "\n";
}

std::string WalkCameras::failure() const {
  return seen_->recorder ? seen_->recorder->failure() : "";
}

cli::Json WalkCameras::json() const {
  return {{"pictures", seen_->recorder->pictures()},
          {"dropped", seen_->rig->dropped()},
          {"processor_s", seen_->rig->processor_s()}};
}

}  // namespace verp::tool
