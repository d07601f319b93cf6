#include "host/trace/record/trace_cut.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "host/trace/record/tick_range.hpp"
#include "host/trace/record/trace_parts.hpp"
#include "host/trace/record/trace_writer.hpp"

namespace verp::record {
namespace {

constexpr std::uint64_t kCutChunkTicks = 125;
constexpr std::string_view kStaticTopic = "/tf_static";  ///< camera poses of the whole run

class Copy {
 public:
  Copy(const Trace& trace, const mcap::File& from, TickRange ticks, mcap::Writer& to)
      : from_(from),
        to_(to),
        ticks_(ticks),
        first_ns_(time_ns(trace, ticks.first)),
        last_ns_(time_ns(trace, ticks.last)) {
    from_.find_channel(kTickTopic, tick_);
    add_channels();
  }

  void messages() {
    for (const mcap::Message& message : from_.messages) {
      if (message.channel == tick_) count_tick();
      if (!is_wanted(message)) continue;
      // Messages before the first tick belong to the whole run.
      to_.add_message(channels_.at(message.channel), std::max(message.time_ns, first_ns_),
                      message.data);
    }
  }

 private:
  static std::uint64_t time_ns(const Trace& trace, std::size_t index) {
    return std::uint64_t{trace.ticks[index].inputs.tick} * trace.params.period_us * 1000;
  }

  void add_channels() {
    std::map<std::uint16_t, std::uint16_t> schemas;
    for (const auto& [id, channel] : from_.channels) {
      if (!schemas.contains(channel.schema)) {
        const mcap::Schema& schema = from_.schemas.at(channel.schema);
        schemas[channel.schema] = to_.add_schema(schema.name, schema.encoding, schema.data);
      }
      channels_[id] = to_.add_channel(schemas[channel.schema], channel.topic, channel.encoding);
    }
  }

  void count_tick() {
    if (seen_++ > ticks_.first && (seen_ - 1 - ticks_.first) % kCutChunkTicks == 0) to_.flush();
  }

  /// Our messages follow their tick in the file. Others count by time: a camera's message comes
  /// late.
  bool is_wanted(const mcap::Message& message) const {
    const mcap::Channel& channel = from_.channels.at(message.channel);
    if (seen_ == 0 || channel.topic == kStaticTopic) return true;
    if (channel.topic.starts_with("/verp/")) {
      return seen_ > ticks_.first && seen_ <= ticks_.last + 1;
    }
    return message.time_ns >= first_ns_ && message.time_ns <= last_ns_;
  }

  const mcap::File& from_;
  mcap::Writer& to_;
  const TickRange ticks_;
  const std::uint64_t first_ns_, last_ns_;
  std::uint16_t tick_ = 0;
  std::map<std::uint16_t, std::uint16_t> channels_;
  std::size_t seen_ = 0;  ///< ticks read so far
};

void add_heads(const Trace& trace, const mcap::File& from, const Cut& cut,
               const std::optional<State>& before, mcap::Writer& to) {
  mcap::StringMap metadata = trace.metadata;
  metadata["cut_from"] = trace.file.string();
  metadata["cut"] = fmt::format("ticks {} to {}, {:.3f} s to {:.3f} s", cut.first_tick,
                                cut.last_tick, cut.first_s, cut.last_s);
  to.add_metadata(kMetadataName, metadata);
  // "result" describes the whole run, so it is left out.
  for (const auto& [name, attachment] : from.attachments) {
    if (name == kStateAttachment || name == kStateLayoutAttachment) continue;
    to.add_attachment(name, attachment.media_type, attachment.data);
  }
  if (before) add_state(to, *before);
}

}  // namespace

Cut cut_trace(const std::filesystem::path& file, std::optional<double> from_s,
              std::optional<double> to_s, const std::filesystem::path& output,
              mcap::Compression compression) {
  const std::string bytes = read_trace_bytes(file);
  const mcap::File from = mcap::parse(bytes);
  const Trace trace = trace_of(file, from, Read::kStrict);
  TickRange ticks = ticks_between(trace, from_s, to_s);
  std::optional<State> before = trace.before;
  const auto kept = std::lower_bound(
      trace.keyframes.begin(), trace.keyframes.end(), ticks.first,
      [](const Keyframe& keyframe, std::size_t index) { return keyframe.index < index; });
  const bool from_state = kept != trace.keyframes.begin();
  ticks.first = from_state ? std::prev(kept)->index + 1 : 0;
  if (from_state) before = std::prev(kept)->state;

  const auto tick = [&](std::size_t index) { return trace.ticks[index].inputs.tick; };
  const Cut cut{.ticks = ticks.last - ticks.first + 1,
                .first_tick = tick(ticks.first),
                .last_tick = tick(ticks.last),
                .first_s = tick(ticks.first) * trace.period_s(),
                .last_s = tick(ticks.last) * trace.period_s(),
                .from_state = from_state};
  mcap::Writer writer(output, from.profile, "verp", compression);
  try {
    add_heads(trace, from, cut, before, writer);
    Copy(trace, from, ticks, writer).messages();
    writer.close();
  } catch (const TraceError&) {
    writer.discard();
    throw;
  }
  return cut;
}

}  // namespace verp::record
