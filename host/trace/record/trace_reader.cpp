#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <type_traits>

#include "common/model/image.hpp"
#include "host/trace/record/fields.hpp"
#include "host/trace/record/mcap_reader.hpp"
#include "host/trace/record/ros_messages.hpp"
#include "host/trace/record/trace.hpp"
#include "host/trace/record/trace_parts.hpp"

namespace verp::record {
namespace {

namespace fs = std::filesystem;

template <class T>
const std::string& layout_of(const char* name) {
  static const std::string text = describe_layout<T>(name);  // once: 30 kB for Params
  return text;
}

std::string writer_of(const mcap::StringMap& metadata) {
  const auto revision = metadata.find("source_revision");
  return revision == metadata.end() ? "another revision" : "revision " + revision->second;
}

/// Builds a Trace from a parsed file; every error names a byte.
class Loader {
 public:
  Loader(const fs::path& path, const mcap::File& file) : path_(path), file_(file) {
    trace_.file = path;
  }

  Trace load() {
    load_metadata();
    load_params();
    load_actions();
    load_state();
    std::uint16_t tick_id = 0, state_id = 0;
    const bool keyframes = find_channels(tick_id, state_id);
    std::uint16_t changed_id = 0, tf_id = 0;
    const bool changed = file_.find_channel(kChangedTopic, changed_id) != nullptr;
    const bool bodies = file_.find_channel("/tf", tf_id) != nullptr;
    std::uint16_t objects_id = 0;
    const bool objects = file_.find_channel(kObjectsTopic, objects_id) != nullptr;
    for (const mcap::Message& message : file_.messages) {
      if (objects && message.channel == objects_id) add_objects(message);
      if (message.channel == tick_id) add_tick(message);
      if (changed && message.channel == changed_id) add_change(message);
      if (bodies && message.channel == tf_id) add_body(message);
      if (keyframes && message.channel == state_id) add_keyframe(message);
    }
    return std::move(trace_);
  }

 private:
  [[noreturn]] void refuse(std::uint64_t offset, const std::string& problem,
                           const std::string& remedy) const {
    throw TraceError(path_, offset, problem, remedy);
  }

  void load_metadata() {
    refuse_no_trace(path_, file_);
    trace_.metadata = file_.metadata.at(kMetadataName);
    const std::string& format = trace_.metadata["format"];
    if (format != kTraceFormat) {
      refuse(0, "trace format '" + format + "', this verp reads '" + kTraceFormat + "'",
             "read it with verp of " + writer_of(trace_.metadata));
    }
  }

  void load_params() {
    const auto found = file_.attachments.find(kParamsAttachment);
    if (found == file_.attachments.end()) {
      refuse(0, "the attachment 'params' (the robot) is missing", "record the run again");
    }
    const std::string_view bytes = found->second.data;
    const auto layout = file_.attachments.find("params.layout");
    const bool same_layout =
        layout == file_.attachments.end() || layout->second.data == layout_of<Params>("Params");
    if (bytes.size() != sizeof(Params) || !same_layout) {
      refuse(found->second.offset,
             fmt::format("a Params image of {} bytes with other fields than this verp's {} bytes",
                         bytes.size(), sizeof(Params)),
             "read it with verp of " + writer_of(trace_.metadata));
    }
    std::memcpy(&trace_.params, bytes.data(), sizeof(Params));
    bool sound = is_well_formed(trace_.params) && trace_.params.period_us > 0;
    for_each_leaf(trace_.params, [&](const auto& value) {
      if constexpr (std::is_floating_point_v<std::remove_cvref_t<decltype(value)>>) {
        sound = sound && std::isfinite(value);
      }
    });
    if (!sound)
      refuse(found->second.offset, "the Params image is not a robot", "record the run again");
  }

  void load_actions() {
    const auto found = file_.attachments.find(kActionsAttachment);
    if (found == file_.attachments.end()) return;
    const std::string_view bytes = found->second.data;
    trace_.actions.resize(bytes.size() / 4);
    std::memcpy(trace_.actions.data(), bytes.data(), 4 * trace_.actions.size());
    const auto fault = action::check_library(trace_.actions.data(), 4 * trace_.actions.size());
    if (fault == action::LibraryFault::kNone) return;
    refuse(found->second.offset,
           fmt::format("the action library is {}",
                       action::kLibraryFaultNames[static_cast<int>(fault)]),
           "read it with verp of " + writer_of(trace_.metadata));
  }

  void load_state() {
    const auto found = file_.attachments.find(kStateAttachment);
    if (found == file_.attachments.end()) return;
    const auto layout = file_.attachments.find(kStateLayoutAttachment);
    if (found->second.data.size() != sizeof(State) || layout == file_.attachments.end() ||
        layout->second.data != layout_of<State>("State")) {
      refuse(found->second.offset,
             "it begins in the midst of a run, with a State of other fields than this verp's",
             "read it with verp of " + writer_of(trace_.metadata));
    }
    std::memcpy(&trace_.before.emplace(), found->second.data.data(), sizeof(State));
  }

  /// Returns whether State has our layout; TickRecord must.
  bool find_channels(std::uint16_t& tick_id, std::uint16_t& state_id) const {
    const mcap::Channel* tick = file_.find_channel(kTickTopic, tick_id);
    if (tick == nullptr) {
      if (file_.flaw && file_.messages.empty()) {
        tick_id = state_id = 0xFFFF;
        return false;
      }
      refuse(0, std::string("has no channel ") + kTickTopic, "give a file written by verp");
    }
    const auto schema = file_.schemas.find(tick->schema);
    if (schema == file_.schemas.end() ||
        schema->second.data != layout_of<TickRecord>("TickRecord")) {
      refuse(0, "ticks with other fields than this verp's Inputs",
             "read it with verp of " + writer_of(trace_.metadata));
    }
    const mcap::Channel* state = file_.find_channel(kStateTopic, state_id);
    if (state == nullptr) return false;
    const auto state_schema = file_.schemas.find(state->schema);
    return state_schema != file_.schemas.end() &&
           state_schema->second.data == layout_of<State>("State");
  }

  void add_tick(const mcap::Message& message) {
    if (message.data.size() != sizeof(TickRecord)) {
      refuse(message.offset,
             fmt::format("a tick of {} bytes, not {}", message.data.size(), sizeof(TickRecord)),
             "record the run again");
    }
    if (message.sequence != trace_.ticks.size()) {
      refuse(message.offset, fmt::format("tick number {} is missing", trace_.ticks.size()),
             "record the run again");
    }
    std::memcpy(&trace_.ticks.emplace_back(), message.data.data(), sizeof(TickRecord));
  }

  void add_keyframe(const mcap::Message& message) {
    if (message.data.size() != sizeof(State) || trace_.ticks.empty()) {
      refuse(message.offset, "a State that belongs to no tick", "record the run again");
    }
    Keyframe& keyframe = trace_.keyframes.emplace_back();
    keyframe.index = trace_.ticks.size() - 1;
    std::memcpy(&keyframe.state, message.data.data(), sizeof(State));
  }

  void add_change(const mcap::Message& message) {
    const auto what = ros::read_string(message.data);
    if (!what || trace_.ticks.empty()) {
      refuse(message.offset, "a change that belongs to no tick", "record the run again");
    }
    trace_.changes.push_back({trace_.ticks.back().inputs.tick, *what});
  }

  /// Replay never reads poses: invalid ones are ignored.
  void add_body(const mcap::Message& message) {
    const std::optional<ros::BodyPose> pose = ros::body_pose(message.data);
    if (pose && !trace_.ticks.empty()) trace_.bodies.push_back({trace_.ticks.size() - 1, *pose});
  }

  void add_objects(const mcap::Message& message) {
    std::vector<ros::ObjectPose> objects = ros::read_objects(message.data);
    if (!objects.empty() && !trace_.ticks.empty())
      trace_.objects.push_back({trace_.ticks.size() - 1, std::move(objects)});
  }

  const fs::path& path_;
  const mcap::File& file_;
  Trace trace_;
};

std::string lost_text(const mcap::File& file) {
  std::uint16_t id = 0;
  std::uint64_t ticks = 0;
  if (file.find_channel(kTickTopic, id) != nullptr) {
    for (const mcap::Message& message : file.messages) ticks += message.channel == id;
  }
  std::string text = fmt::format("{} ticks before it are whole", ticks);
  if (!file.flaw->truncated) return text;
  const std::uint64_t share = ticks == 0 ? 1 : (file.messages.size() + ticks - 1) / ticks;
  const std::uint64_t lost = (file.flaw->lost_messages + share - 1) / share;
  return text +
         (lost > 0 ? fmt::format(", about {} more are lost", lost) : ", later ones are lost");
}

}  // namespace

std::string read_trace_bytes(const fs::path& file) {
  std::error_code error;
  if (fs::is_directory(file, error))
    throw TraceError(file, "is a folder", "name the .mcap file in it");
  if (fs::exists(file, error) && !fs::is_regular_file(file, error))
    throw TraceError(file, "is not a regular file", "name a .mcap file");
  std::ifstream in(file, std::ios::binary);
  if (!in) {
    throw TraceError(file, "no such file, or it cannot be opened",
                     "check the path; `verp walk --record F.mcap` writes a trace");
  }
  return {std::istreambuf_iterator<char>(in), {}};
}

void refuse_no_trace(const fs::path& path, const mcap::File& file) {
  if (file.metadata.contains(kMetadataName)) return;
  const auto merged = file.metadata.lower_bound(std::string(kMetadataName) + "/");
  if (merged != file.metadata.end() && merged->first.starts_with(kMetadataName)) {
    throw TraceError(path, 0, "several robots' traces as one, for viewers",
                     "give one of those that it was made of");
  }
  throw TraceError(path, 0, "an MCAP file, but not a VERP trace (no metadata record 'verp')",
                   "give a file written by verp");
}

void refuse_flaw(const fs::path& path, const mcap::File& file) {
  if (!file.flaw) return;
  throw TraceError(path, file.flaw->offset, file.flaw->what,
                   "take an intact copy or record the run again");
}

std::string core_of(const Trace& trace) {
  // A recovered trace has its digests' version and its rewriter's.
  for (const char* key : {"recorded_core_version", "core_version"}) {
    const auto found = trace.metadata.find(key);
    if (found != trace.metadata.end()) return found->second == "unknown" ? "" : found->second;
  }
  return "";
}

Trace read_trace(const fs::path& path, Read mode) {
  const std::string bytes = read_trace_bytes(path);
  return trace_of(path, mcap::parse(bytes), mode);
}

Trace trace_of(const fs::path& path, const mcap::File& file, Read mode) {
  std::uint16_t id = 0;
  const bool salvage = !file.attachments.empty() && file.find_channel(kTickTopic, id) != nullptr;
  if (file.flaw && (mode == Read::kStrict || !salvage)) {
    throw TraceError(path, file.flaw->offset,
                     file.flaw->what + (salvage ? " (" + lost_text(file) + ")" : ""),
                     salvage ? "`verp trace recover` keeps those, or take an intact copy"
                             : "take an intact copy or record the run again");
  }
  Trace trace = Loader(path, file).load();
  if (file.flaw) {
    trace.warning = fmt::format("{}: byte {}: {}; {}", path.string(), file.flaw->offset,
                                file.flaw->what, lost_text(file));
  }
  return trace;
}

std::size_t for_each_picture(const fs::path& path,
                             const std::function<void(const RecordedPicture&)>& show) {
  const std::string bytes = read_trace_bytes(path);
  const mcap::File file = mcap::parse(bytes);
  refuse_flaw(path, file);
  std::size_t count = 0;
  for (const mcap::Message& message : file.messages) {
    const mcap::Channel& channel = file.channels.at(message.channel);
    const std::string_view type = file.schemas.at(channel.schema).name;
    const bool compressed = type == ros::kCompressedImage.name;
    if (!compressed && type != ros::kImage.name) continue;
    auto picture = compressed ? ros::read_compressed(message.data) : ros::read_image(message.data);
    if (!picture) {
      throw TraceError(path, message.offset, "a picture that is none", "record the run again");
    }
    show({std::string(channel.topic), message.time_ns, std::move(*picture)});
    ++count;
  }
  return count;
}

}  // namespace verp::record
