#include "host/trace/record/trace_recover.hpp"

#include "host/trace/record/trace_parts.hpp"

namespace verp::record {
namespace {

constexpr std::size_t kChunkBytes = 1u << 17;

void add_heads(const TraceFile& trace, mcap::Writer& to) {
  mcap::StringMap run = trace.head().metadata;
  for (const auto& [key, value] : build_info()) {
    run.try_emplace("recorded_" + key, run.contains(key) ? run[key] : "unknown");
    run[key] = value;
  }
  to.add_metadata(kMetadataName, run);
  for (const auto& [name, attachment] : trace.file().attachments)
    to.add_attachment(name, attachment.media_type, attachment.data);
}

std::map<std::uint16_t, std::uint16_t> add_channels(const mcap::File& from, mcap::Writer& to) {
  std::map<std::uint16_t, std::uint16_t> schemas, channels;
  for (const auto& [id, schema] : from.schemas)
    schemas[id] = to.add_schema(schema.name, schema.encoding, schema.data);
  for (const auto& [id, channel] : from.channels)
    channels[id] = to.add_channel(schemas.at(channel.schema), channel.topic, channel.encoding);
  return channels;
}

void copy(TraceFile& trace, mcap::Writer& to) {
  add_heads(trace, to);
  const auto channels = add_channels(trace.file(), to);
  trace.read([&](const mcap::File&, const mcap::Message& message) {
    to.add_message(channels.at(message.channel), message.time_ns, message.data);
    if (to.open_bytes() >= kChunkBytes) to.flush();
  });
  mcap::StringMap result{{"recovered_from", trace.head().file.string()}};
  if (!trace.head().warning.empty()) result["recovered_damage"] = trace.head().warning;
  for (const auto& [name, entries] : trace.file().metadata) {
    if (name == "result") result.insert(entries.begin(), entries.end());
  }
  to.add_metadata("result", result);
  to.close();
}

}  // namespace

Recovered recover_trace(const std::filesystem::path& file, const std::filesystem::path& output,
                        mcap::Compression compression) {
  TraceFile trace(file, Read::kSalvage);
  mcap::Writer writer(output, trace.file().profile, "verp", compression);
  try {
    copy(trace, writer);
  } catch (const TraceError&) {  // the original is intact
    writer.discard();
    throw;
  }
  return {.ticks = trace.ticks(),
          .messages = trace.file().messages,
          .channels = trace.file().channels.size(),
          .left_out = trace.file().left_out,
          .warning = trace.head().warning};
}

}  // namespace verp::record
