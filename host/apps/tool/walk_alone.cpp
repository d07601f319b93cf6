#include <fmt/format.h>

#include "host/apps/cli/exit_status.hpp"
#include "host/apps/tool/live_stream.hpp"
#include "host/apps/tool/own_controller.hpp"
#include "host/apps/tool/walk_cameras.hpp"
#include "host/apps/tool/walk_map.hpp"
#include "host/apps/tool/walk_plan.hpp"
#include "host/apps/tool/walk_radio.hpp"
#include "host/apps/tool/walk_seeds.hpp"

/// In the place of verp_walk_rest, in the program of a first walk. The launcher takes the program
/// of all words for these options, so that nobody who types ./verp reads this.
namespace verp::tool {
namespace {

[[noreturn]] void refuse(const char* option) {
  throw cli::ToolError(cli::kNoDevice,
                       fmt::format("verp: {} is not in this program, which does what a first "
                                   "walk waits for; ./verp builds the one that has it",
                                   option));
}

}  // namespace

struct LiveStream::Stream {};
LiveStream::LiveStream(const std::string&, const LiveOptions& options) {
  if (options.on) refuse("--live");
}
LiveStream::~LiveStream() = default;
record::mcap::Listener* LiveStream::robot(const std::string&) {
  return nullptr;
}
live::Server* LiveStream::server() {
  return nullptr;
}
void LiveStream::wait_for_viewer() {}
void LiveStream::run_beside_real_time() {}
void LiveStream::finish() {}
std::string LiveStream::text() const {
  return {};
}
void LiveStream::add_to(cli::Json&) const {}

struct WalkCameras::Seen {};
WalkCameras::WalkCameras(const WalkOptions&, WalkPlan&, const std::vector<WalkPlan>&,
                         const sim::WorldOptions&, record::TraceWriter*) {
  refuse("--cameras");
}
WalkCameras::~WalkCameras() = default;
void WalkCameras::watch(const WalkPlan&, session::Hooks&) {}
void WalkCameras::finish() {}
std::string WalkCameras::text(double) const {
  return {};
}
cli::Json WalkCameras::json() const {
  return {};
}
std::string WalkCameras::failure() const {
  return {};
}

std::function<session::Decide()> own_controller(const std::string&, bool) {
  refuse("--controller");
}

void take_controller(const std::string& folder, std::vector<session::WalkPlan>&, bool) {
  if (!folder.empty()) refuse("--controller");
}

void take_get_up_actions(session::WalkPlan&) {
  refuse("getting up (--get-up, --start)");
}

void check_board(const WalkOptions& options) {
  if (!options.board.empty()) refuse("a controller on an emulated board (--on)");
}

void check_radio(const WalkOptions& options, const session::WalkPlan&,
                 const std::vector<session::WalkPlan>&) {
  if (options.radio) refuse("--radio");
}

struct WalkRadio::Air {};
WalkRadio::WalkRadio(const WalkOptions&, session::Session&, std::size_t) {
  refuse("--radio");
}
WalkRadio::~WalkRadio() = default;
void WalkRadio::watch(const session::WalkPlan&, session::Hooks&) {}
void WalkRadio::join(const session::WalkPlan&, session::Robot&) {}
std::string WalkRadio::text() const {
  return {};
}
cli::Json WalkRadio::json() const {
  return {};
}

int walk_seeds(const WalkOptions&) {
  refuse("--seeds");
}

int walk_map(const WalkOptions&, WalkPlan, sim::WorldOptions) {
  refuse("--map");
}

}  // namespace verp::tool
