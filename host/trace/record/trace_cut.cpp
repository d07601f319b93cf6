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

/// The range, the State to begin from, and the ticks' numbers.
class CutPlan {
 public:
  CutPlan(TraceFile& file, std::optional<double> from_s, std::optional<double> to_s)
      : finder_(file.head(), from_s, to_s), before_(file.head().before) {
    file.read({.tick = [&](const TickRecord& record) { tick(record.inputs.tick); },
               .keyframe = [&](const State& state) { keyframe(state); },
               .change = {},
               .body = {},
               .objects = {}});
    ticks_ = finder_.range();
    ticks_.first = first_;
  }

  const std::optional<State>& before() const { return before_; }
  TickRange ticks() const { return ticks_; }
  Cut cut(double period_s) const {
    return {.ticks = ticks_.last - ticks_.first + 1,
            .first_tick = first_tick_,
            .last_tick = last_tick_,
            .first_s = first_tick_ * period_s,
            .last_s = last_tick_ * period_s,
            .from_state = first_ > 0};
  }

 private:
  void tick(std::uint32_t tick) {
    if (count_++ == first_) first_tick_ = tick;
    finder_.add(tick);
    if (finder_.is_in()) last_tick_ = tick;
  }
  void keyframe(const State& state) {
    if (finder_.has_begun()) return;
    before_ = state;
    first_ = count_;
  }

  TickRangeFinder finder_;
  std::optional<State> before_;
  TickRange ticks_;
  std::size_t count_ = 0, first_ = 0;
  std::uint32_t first_tick_ = 0, last_tick_ = 0;
};

class Copy {
 public:
  Copy(const mcap::File& from, TickRange ticks, const Cut& cut, std::uint32_t period_us,
       mcap::Writer& to)
      : from_(from),
        to_(to),
        ticks_(ticks),
        first_ns_(std::uint64_t{cut.first_tick} * period_us * 1000),
        last_ns_(std::uint64_t{cut.last_tick} * period_us * 1000) {
    from_.find_channel(kTickTopic, tick_);
    add_channels();
  }

  void operator()(const mcap::Message& message) {
    if (message.channel == tick_) count_tick();
    if (!is_wanted(message)) return;
    // Messages before the first tick belong to the whole run.
    to_.add_message(channels_.at(message.channel), std::max(message.time_ns, first_ns_),
                    message.data);
  }

 private:
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

void add_heads(const TraceFile& trace, const Cut& cut, const std::optional<State>& before,
               mcap::Writer& to) {
  mcap::StringMap metadata = trace.head().metadata;
  metadata["cut_from"] = trace.head().file.string();
  metadata["cut"] = fmt::format("ticks {} to {}, {:.3f} s to {:.3f} s", cut.first_tick,
                                cut.last_tick, cut.first_s, cut.last_s);
  to.add_metadata(kMetadataName, metadata);
  // "result" describes the whole run, so it is left out.
  for (const auto& [name, attachment] : trace.file().attachments) {
    if (name == kStateAttachment || name == kStateLayoutAttachment) continue;
    to.add_attachment(name, attachment.media_type, attachment.data);
  }
  if (before) add_state(to, *before);
}

}  // namespace

Cut cut_trace(const std::filesystem::path& file, std::optional<double> from_s,
              std::optional<double> to_s, const std::filesystem::path& output,
              mcap::Compression compression) {
  TraceFile trace(file, Read::kStrict);
  const CutPlan plan(trace, from_s, to_s);
  const Cut cut = plan.cut(trace.head().period_s());
  mcap::Writer writer(output, trace.file().profile, "verp", compression);
  try {
    add_heads(trace, cut, plan.before(), writer);
    Copy copy(trace.file(), plan.ticks(), cut, trace.head().params.period_us, writer);
    trace.read([&](const mcap::File&, const mcap::Message& message) { copy(message); });
    writer.close();
  } catch (const TraceError&) {
    writer.discard();
    throw;
  }
  return cut;
}

}  // namespace verp::record
