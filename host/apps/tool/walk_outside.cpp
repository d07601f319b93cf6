#include "host/apps/tool/walk_outside.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>

namespace verp::tool {

std::string driver_of(const session::WalkPlan& plan) {
  if (!plan.link.empty()) return plan.link;
  return plan.board.empty() ? "this PC" : plan.board;
}

cli::Json digest_json(const session::WalkPlan& plan, const session::WalkResult& result) {
  return plan.link.empty() ? cli::Json(fmt::format("0x{:016x}", result.digest)) : cli::Json();
}

sim::Vec2 way_of(const session::WalkPlan& plan, const session::WalkResult& result) {
  return result.end_m - plan.twin.start_m.head<2>();
}

std::string outside_text(const session::WalkPlan& plan, const session::WalkResult& result) {
  const auto line = [](const char* name, const std::string& value) {
    return fmt::format("  {:<18}{}\n", name, value);
  };
  const std::string end = result.interrupted        ? "interrupted"
                          : !result.failure.empty() ? "failed: " + result.failure
                                                    : "without a fall";
  const sim::Vec2 way_m = Eigen::Rotation2Dd(-plan.twin.start_yaw_rad) * way_of(plan, result);
  return fmt::format("{}: driven for {:.1f} s over {}, {}\n", plan.name, result.simulated_s,
                     plan.link, end) +
         line("ticks", fmt::format("{} of {} us", result.ticks, plan.params.period_us)) +
         line("went", fmt::format("{:+.2f} m ahead, {:+.2f} m to the left of where it stood",
                                  way_m.x(), way_m.y())) +
         line("real-time factor", fmt::format("{:.1f}", result.real_time_factor())) +
         line("digest", "its controller's, which tells it");
}

}  // namespace verp::tool
