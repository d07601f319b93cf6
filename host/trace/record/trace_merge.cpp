#include "host/trace/record/trace_merge.hpp"

#include <memory>

#include "host/trace/record/in_order.hpp"
#include "host/trace/record/team_channel.hpp"
#include "host/trace/record/trace_parts.hpp"

namespace verp::record {
namespace {

constexpr std::size_t kChunkMessages = 2000;

class Source {
 public:
  explicit Source(const NamedTrace& named)
      : named_(named), reader_(open_mcap(named.file)), file_(reader_.read()) {
    refuse_flaw(named.file, file_);
    refuse_no_trace(named.file, file_);
  }

  InOrder::Source in_order() { return {named_.file, &reader_}; }
  bool has_objects() const {
    std::uint16_t id = 0;
    return file_.find_channel(kObjectsTopic, id) != nullptr;
  }

  /// `common`: shared channels, by topic.
  void add_to(mcap::Writer& to, std::map<std::string, std::uint16_t>& common, bool objects) {
    to.add_metadata(std::string(kMetadataName) + "/" + named_.robot,
                    file_.metadata.at(kMetadataName));
    for (const auto& [name, attachment] : file_.attachments) {
      to.add_attachment(named_.robot + "/" + name, attachment.media_type, attachment.data);
    }
    for (const auto& [id, channel] : file_.channels) {
      if (channel.topic == kObjectsTopic && !objects) continue;
      const mcap::Schema& schema = file_.schemas.at(channel.schema);
      const TeamChannel& team =
          channels_.try_emplace(id, named_.robot, channel.topic, schema).first->second.team;
      if (!team.is_of_all() || !common.contains(team.topic())) {
        common[team.topic()] =
            to.add_channel(to.add_schema(schema.name, schema.encoding, schema.data), team.topic(),
                           channel.encoding);
      }
      channels_.at(id).id = common[team.topic()];
    }
  }

  /// False: the merged file does not have this message.
  bool write(const mcap::Message& message, mcap::Writer& to) const {
    const auto channel = channels_.find(message.channel);
    if (channel == channels_.end()) return false;
    const auto renamed = channel->second.team.message(message.data);
    if (!renamed) {
      throw TraceError(named_.file, message.offset, "a message that is none of its type",
                       "record the run again");
    }
    to.add_message(channel->second.id, message.time_ns, *renamed);
    return true;
  }

 private:
  const NamedTrace named_;
  mcap::Reader reader_;
  const mcap::File& file_;
  struct Channel {
    Channel(std::string_view robot, std::string_view topic, const mcap::Schema& schema)
        : team(robot, topic, schema) {}
    TeamChannel team;
    std::uint16_t id = 0;
  };
  std::map<std::uint16_t, Channel> channels_;
};

}  // namespace

std::size_t merge_traces(const std::vector<NamedTrace>& traces, const std::filesystem::path& output,
                         mcap::Compression compression) {
  std::vector<std::unique_ptr<Source>> sources;
  for (const NamedTrace& each : traces) sources.push_back(std::make_unique<Source>(each));
  mcap::Writer writer(output, "ros2", "verp", compression);
  std::size_t count = 0;
  try {
    std::map<std::string, std::uint16_t> common;
    bool objects = true;
    for (const auto& source : sources) {
      source->add_to(writer, common, objects);
      objects = objects && !source->has_objects();
    }
    std::vector<InOrder::Source> files;
    for (const auto& source : sources) files.push_back(source->in_order());
    InOrder messages(files);
    while (const auto next = messages.next()) {
      if (!sources[next->source]->write(next->message, writer)) continue;
      if (++count % kChunkMessages == 0) writer.flush();
    }
    writer.close();
  } catch (const TraceError&) {
    writer.discard();
    throw;
  }
  return count;
}

}  // namespace verp::record
