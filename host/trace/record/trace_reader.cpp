#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <memory>
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

/// What a Trace may take in memory: an hour of a walk takes a twentieth.
constexpr std::size_t kMostHeld = std::size_t{2} << 30;

template <class T>
const std::string& layout_of(const char* name) {
  static const std::string text = describe_layout<T>(name);  // once: 30 kB for Params
  return text;
}

std::string writer_of(const mcap::StringMap& metadata) {
  const auto revision = metadata.find("source_revision");
  return revision == metadata.end() ? "another revision" : "revision " + revision->second;
}

/// Makes a Trace's head of a file; every error names a byte.
class Head {
 public:
  Head(const fs::path& path, const mcap::File& file) : path_(path), file_(file) {
    trace_.file = path;
  }

  Trace load() {
    load_metadata();
    load_params();
    load_actions();
    load_state();
    check_ticks();
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

  void check_ticks() const {
    std::uint16_t id = 0;
    const mcap::Channel* tick = file_.find_channel(kTickTopic, id);
    if (tick == nullptr)
      refuse(0, std::string("has no channel ") + kTickTopic, "give a file written by verp");
    if (file_.schemas.at(tick->schema).data != layout_of<TickRecord>("TickRecord")) {
      refuse(0, "ticks with other fields than this verp's Inputs",
             "read it with verp of " + writer_of(trace_.metadata));
    }
  }

  const fs::path& path_;
  const mcap::File& file_;
  Trace trace_;
};

class Pass {
 public:
  Pass(const fs::path& path, const mcap::File& file, const TraceRecords& to)
      : path_(path), to_(to) {
    for (const auto& [id, channel] : file.channels) {
      if (channel.topic == kTickTopic) what_[id] = &Pass::tick;
      if (channel.topic == kStateTopic && to.keyframe &&
          file.schemas.at(channel.schema).data == layout_of<State>("State"))
        what_[id] = &Pass::keyframe;
      if (channel.topic == kChangedTopic && to.change) what_[id] = &Pass::change;
      if (channel.topic == "/tf" && to.body) what_[id] = &Pass::body;
      if (channel.topic == kObjectsTopic && to.objects) what_[id] = &Pass::objects;
    }
  }

  void operator()(const mcap::Message& message) {
    const auto found = what_.find(message.channel);
    if (found != what_.end()) (this->*found->second)(message);
  }

 private:
  [[noreturn]] void refuse(const mcap::Message& message, const std::string& problem) const {
    throw TraceError(path_, message.offset, problem, "record the run again");
  }

  void tick(const mcap::Message& message) {
    if (message.data.size() != sizeof(TickRecord)) {
      refuse(message,
             fmt::format("a tick of {} bytes, not {}", message.data.size(), sizeof(TickRecord)));
    }
    if (message.sequence != ticks_)
      refuse(message, fmt::format("tick number {} is missing", ticks_));
    ++ticks_;
    if (!to_.tick) return;
    TickRecord record;
    std::memcpy(&record, message.data.data(), sizeof record);
    to_.tick(record);
  }

  void keyframe(const mcap::Message& message) {
    if (message.data.size() != sizeof(State) || ticks_ == 0)
      refuse(message, "a State that belongs to no tick");
    State state;
    std::memcpy(&state, message.data.data(), sizeof state);
    to_.keyframe(state);
  }

  void change(const mcap::Message& message) {
    const auto what = ros::read_string(message.data);
    if (!what || ticks_ == 0) refuse(message, "a change that belongs to no tick");
    to_.change(*what);
  }

  /// Replay never reads poses: invalid ones are ignored.
  void body(const mcap::Message& message) {
    const std::optional<ros::BodyPose> pose = ros::body_pose(message.data);
    if (pose && ticks_ > 0) to_.body(*pose);
  }

  void objects(const mcap::Message& message) {
    std::vector<ros::ObjectPose> objects = ros::read_objects(message.data);
    if (!objects.empty() && ticks_ > 0) to_.objects(std::move(objects));
  }

  const fs::path& path_;
  const TraceRecords& to_;
  std::map<std::uint16_t, void (Pass::*)(const mcap::Message&)> what_;
  std::size_t ticks_ = 0;
};

std::string lost_text(const mcap::File& file, std::size_t ticks) {
  const std::string text = fmt::format("{} ticks before it are whole", ticks);
  if (file.data_whole) return text + ", and all messages are";
  if (!file.flaw->truncated) return text;
  return text + (file.flaw->in_chunk ? ", later ones are lost" : ", later ones, if any, are lost");
}

std::string left_out_text(const mcap::File& file, std::size_t ticks) {
  const mcap::LeftOut& gap = file.left_out;
  std::string text = fmt::format("left out: {} damaged record{} of {} bytes", gap.records,
                                 gap.records == 1 ? "" : "s", gap.bytes);
  if (gap.messages > 0)
    text += fmt::format(", and {} messages of channels that only they declare", gap.messages);
  text += fmt::format("; {} ticks are whole", ticks);
  if (!file.end) return text;
  return text + fmt::format("; ends at byte {}: {}", file.end->offset, file.end->what);
}

}  // namespace

mcap::Reader open_mcap(const fs::path& file, mcap::Damage damage) {
  std::error_code error;
  if (fs::is_directory(file, error))
    throw TraceError(file, "is a folder", "name the .mcap file in it");
  if (fs::exists(file, error) && !fs::is_regular_file(file, error))
    throw TraceError(file, "is not a regular file", "name a .mcap file");
  auto in = std::make_unique<std::ifstream>(file, std::ios::binary);
  if (!*in) {
    throw TraceError(file, "no such file, or it cannot be opened",
                     "check the path; `verp walk --record F.mcap` writes a trace");
  }
  return mcap::Reader(std::move(in), damage);
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

/// Robot and ticks are whole, whatever else is damaged.
bool is_useful(const mcap::File& file) {
  std::uint16_t id = 0;
  return file.attachments.contains(kParamsAttachment) &&
         file.find_channel(kTickTopic, id) != nullptr;
}

/// `verp trace recover` goes on behind a damaged chunk.
bool has_use_behind_damage(const fs::path& path) {
  mcap::Reader reader = open_mcap(path, mcap::Damage::kLeftOut);
  return is_useful(reader.read([](const mcap::File&, const mcap::Message&) {}));
}

TraceFile::TraceFile(const fs::path& path, Read mode)
    : reader_(
          open_mcap(path, mode == Read::kSalvage ? mcap::Damage::kLeftOut : mcap::Damage::kEnds)) {
  const mcap::File& file =
      reader_.read([&](const mcap::File& so_far, const mcap::Message& message) {
        ticks_ += so_far.channels.at(message.channel).topic == kTickTopic ? 1 : 0;
      });
  const bool salvage = is_useful(file);
  if (file.flaw && (mode == Read::kStrict || !salvage)) {
    const bool behind = !salvage && mode == Read::kStrict && has_use_behind_damage(path);
    throw TraceError(path, file.flaw->offset,
                     file.flaw->what + (salvage ? " (" + lost_text(file, ticks_) + ")" : ""),
                     salvage  ? "`verp trace recover` keeps those, or take an intact copy"
                     : behind ? "`verp trace recover` keeps what is whole, or take an intact copy"
                              : "take an intact copy or record the run again");
  }
  head_ = Head(path, file).load();
  if (file.flaw) {
    const bool gap = file.left_out.records > 0;
    head_.warning =
        fmt::format("{}: byte {}: {}; {}", path.string(), file.flaw->offset, file.flaw->what,
                    gap ? left_out_text(file, ticks_) : lost_text(file, ticks_));
  }
}

void TraceFile::read(const mcap::OnMessage& on_message) {
  const std::uint64_t messages = file().messages;
  if (reader_.read(on_message).messages == messages) return;
  throw TraceError(head_.file, "another program changes it", "wait until it is written");
}

void TraceFile::read(const TraceRecords& to) {
  Pass pass(head_.file, file(), to);
  read([&](const mcap::File&, const mcap::Message& message) { pass(message); });
}

Trace read_trace(const fs::path& path, Read mode) {
  TraceFile file(path, mode);
  Trace trace = file.head();
  const auto last = [&] { return trace.ticks.size() - 1; };
  std::size_t left = kMostHeld;
  const auto hold = [&](std::size_t bytes) {
    if (bytes > left) {
      throw TraceError(
          path, fmt::format("takes more than the {} bytes of memory that this may", kMostHeld),
          "cut it first: `verp trace cut`");
    }
    left -= bytes;
  };
  hold(std::min(file.ticks(), kMostHeld) * sizeof(TickRecord));
  trace.ticks.reserve(file.ticks());
  file.read({.tick = [&](const TickRecord& tick) { trace.ticks.push_back(tick); },
             .keyframe =
                 [&](const State& state) {
                   hold(sizeof(Keyframe));
                   trace.keyframes.push_back({last(), state});
                 },
             .change =
                 [&](const std::string& what) {
                   hold(sizeof(Change) + what.size());
                   trace.changes.push_back({trace.ticks.back().inputs.tick, what});
                 },
             .body =
                 [&](const ros::BodyPose& pose) {
                   hold(sizeof(BodyAt));
                   trace.bodies.push_back({last(), pose});
                 },
             .objects =
                 [&](std::vector<ros::ObjectPose> objects) {
                   hold(sizeof(ObjectsAt) + objects.size() * sizeof(ros::ObjectPose));
                   trace.objects.push_back({last(), std::move(objects)});
                 }});
  return trace;
}

std::size_t for_each_picture(const fs::path& path,
                             const std::function<void(const RecordedPicture&)>& show) {
  mcap::Reader reader = open_mcap(path);
  refuse_flaw(path, reader.read());
  std::size_t count = 0;
  reader.read([&](const mcap::File& file, const mcap::Message& message) {
    const mcap::Channel& channel = file.channels.at(message.channel);
    const std::string_view type = file.schemas.at(channel.schema).name;
    const bool compressed = type == ros::kCompressedImage.name;
    if (!compressed && type != ros::kImage.name) return;
    auto picture = compressed ? ros::read_compressed(message.data) : ros::read_image(message.data);
    if (!picture) {
      throw TraceError(path, message.offset, "a picture that is none", "record the run again");
    }
    show({std::string(channel.topic), message.time_ns, std::move(*picture)});
    ++count;
  });
  return count;
}

}  // namespace verp::record
