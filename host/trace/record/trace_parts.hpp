#pragma once
#include <filesystem>
#include <functional>
#include <span>

#include "host/trace/record/mcap_reader.hpp"
#include "host/trace/record/trace.hpp"

namespace verp::record {

/// Throws TraceError for a missing file, a folder, a device.
mcap::Reader open_mcap(const std::filesystem::path& file,
                       mcap::Damage damage = mcap::Damage::kEnds);

void refuse_flaw(const std::filesystem::path& path, const mcap::File& file);

/// Throws TraceError for other MCAP files, such as merged traces.
void refuse_no_trace(const std::filesystem::path& path, const mcap::File& file);

/// What a pass over a trace gives; any of them may be empty.
struct TraceRecords {
  std::function<void(const TickRecord&)> tick;
  // Of the tick before:
  std::function<void(const State&)> keyframe;
  std::function<void(const std::string&)> change;
  std::function<void(const ros::BodyPose&)> body;
  std::function<void(std::vector<ros::ObjectPose>)> objects;
};

/// A trace on the disk. Holds one chunk of it.
class TraceFile {
 public:
  /// Looks at every byte. Throws TraceError like read_trace().
  TraceFile(const std::filesystem::path& path, Read mode);

  /// Without ticks and what belongs to them.
  const Trace& head() const { return head_; }
  std::size_t ticks() const { return ticks_; }
  const mcap::File& file() const { return reader_.file(); }
  /// All messages, as often as needed. Throws TraceError if another program changes the file.
  void read(const mcap::OnMessage& on_message);
  void read(const TraceRecords& to);

 private:
  Trace head_;
  mcap::Reader reader_;
  std::size_t ticks_ = 0;
};

}  // namespace verp::record
