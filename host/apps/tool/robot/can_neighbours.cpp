#include "host/apps/tool/robot/can_neighbours.hpp"

#include <fmt/format.h>

#include <utility>

#include "common/protocol/canopen/robot_plan.hpp"

namespace verp::tool {
namespace {

/// A drive answers once a tick. Late answers and another program's SYNC add some.
constexpr std::uint64_t kMoreAnswers = 50;
/// A drive that boots is silent until it is set up and started, which takes more ticks.
constexpr std::uint64_t kBootTicks = 2;

}  // namespace

void CanNeighbours::sent(const CanFrame& frame) {
  const bool first = frame.id == canopen::kSyncId && (frame.size == 0 || frame.data[0] == 1);
  if (first) ++ticks_;
}

bool CanNeighbours::is_doubled(const Drive& drive) const {
  const bool goes_on =
      drive.booted_in != 0 && ticks_ > drive.booted_in && ticks_ <= drive.booted_in + kBootTicks;
  return goes_on || drive.answers > ticks_ + kMoreAnswers;
}

void CanNeighbours::came(const CanFrame& frame) {
  if (!canopen::is_canopen(frame)) return;
  if (canopen::plan::is_of_master(frame) && !std::exchange(master_named_, true)) {
    news_ = fmt::format(
        "another program talks as a master on this bus (identifier 0x{:03X}): end it", frame.id);
  }
  const canopen::Connection from = canopen::connection_of(frame.id);
  const int joint = nodes_.slot_of(from.node);
  if (joint < 0 || !app::is_joint(joint)) return;
  Drive& drive = drive_[joint];
  if (from.service == canopen::Service::kHeartbeat && frame.size == 1 && frame.data[0] == 0) {
    drive.booted_in = ticks_;
  }
  if (from.service != canopen::Service::kTpdo || from.number != 1) return;
  ++drive.answers;
  if (!is_doubled(drive) || std::exchange(drive.named, true)) return;
  news_ = fmt::format("another device or program has node id {} ({}): end it, or change its id",
                      from.node, params_.joint[joint].name);
}

std::string CanNeighbours::news() {
  return std::exchange(news_, {});
}

}  // namespace verp::tool
