#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "host/trace/record/mcap_writer.hpp"

namespace verp::record {

/// The robot's name: letters, digits, _.
struct NamedTrace {
  std::string robot;
  std::filesystem::path file;
};

/// Several robots' traces in one file for viewers, on one time axis. Topics /ROBOT/..., frames
/// ROBOT/frame; "world" is shared. World objects: the first trace's that has any. Returns the
/// number of messages. Throws TraceError.
std::size_t merge_traces(const std::vector<NamedTrace>& traces, const std::filesystem::path& output,
                         mcap::Compression compression = mcap::Compression::kNone);

}  // namespace verp::record
