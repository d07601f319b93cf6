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

/// Each tick's inputs, body pose and joint efforts; save() computes State again.
class RunRecord {
 public:
  void add(const session::Tick& tick);
  void note(const std::string& what);
  std::size_t ticks() const { return ticks_.size(); }

  /// `actions`: the controller's library. Throws record::TraceError.
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
