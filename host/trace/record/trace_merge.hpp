#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "host/trace/record/mcap_writer.hpp"

namespace verp::record {

/// A trace, and what its robot is called among others: letters, digits, _.
struct NamedTrace {
  std::string robot;
  std::filesystem::path file;
};

/// Several robots' traces as one MCAP file for viewers: each message under /ROBOT/..., its frames
/// as ROBOT/frame, all in the frame "world" and on one time. Transforms are on one topic, /tf, as
/// ROS has them; the world's things are the first's that has any. Returns how many messages. Throws
/// TraceError.
std::size_t merge_traces(const std::vector<NamedTrace>& traces, const std::filesystem::path& output,
                         mcap::Compression compression = mcap::Compression::kNone);

}  // namespace verp::record
