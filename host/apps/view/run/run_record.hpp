#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "common/record/tick_record.hpp"
#include "host/run/session/plan.hpp"
#include "host/trace/record/mcap_format.hpp"
#include "host/trace/record/ros_messages.hpp"

namespace verp::view {

/// A run in memory, so that who has watched it can still keep it: what went into each tick, and
/// where the body was and how hard its joints were driven. State is made again from that when it is
/// saved.
class RunRecord {
 public:
  void add(const session::Tick& tick);
  /// What was done to the twin after the last tick.
  void note(const std::string& what);
  std::size_t ticks() const { return ticks_.size(); }

  /// `actions`: image of the library that the controller had. Throws record::TraceError.
  void save(const std::filesystem::path& file, const Params& params,
            const record::mcap::StringMap& metadata,
            const std::vector<std::uint32_t>& actions = {}) const;

 private:
  struct Kept {
    TickRecord record;
    record::ros::BodyPose body;
    std::vector<double> effort_n_m;
    std::vector<std::string> notes = {};
  };
  std::vector<Kept> ticks_;
};

}  // namespace verp::view
