#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "host/trace/record/mcap_writer.hpp"

namespace verp::record {

/// A trace and its robot's name: letters, digits, _.
struct NamedTrace {
  std::string robot;
  std::filesystem::path file;
};

/// Merges several robots' traces into one MCAP file for viewers, on one time axis. Topics become
/// /ROBOT/..., frames ROBOT/frame; all share the frame "world". Transforms are on one topic, /tf,
/// as in ROS. World objects are those of the first trace that has any. Returns the number of
/// messages. Throws TraceError.
std::size_t merge_traces(const std::vector<NamedTrace>& traces, const std::filesystem::path& output,
                         mcap::Compression compression = mcap::Compression::kNone);

}  // namespace verp::record
