#include "host/record/trace_merge.hpp"

#include <algorithm>
#include <memory>

#include "host/record/ros_frames.hpp"
#include "host/record/ros_messages.hpp"
#include "host/record/trace_parts.hpp"

namespace verp::record {
namespace {

constexpr std::size_t kChunkMessages = 2000;
constexpr std::string_view kDescriptionTopic = "/robot_description";

/// Whose messages tell by their frames of whom they are.
bool is_of_all(std::string_view topic) {
  return topic == "/tf" || topic == "/tf_static" || topic == kObjectsTopic;
}

/// One of the traces, with where its messages go.
class Source {
 public:
  explicit Source(const NamedTrace& named)
      : named_(named), bytes_(read_trace_bytes(named.file)), file_(mcap::parse(bytes_)) {
    refuse_flaw(named.file, file_);
    refuse_no_trace(named.file, file_);
  }

  const mcap::File& file() const { return file_; }
  bool has_objects() const {
    std::uint16_t id = 0;
    return file_.find_channel(kObjectsTopic, id) != nullptr;
  }

  /// `common`: channels that all robots share, by topic.
  void add_to(mcap::Writer& to, std::map<std::string, std::uint16_t>& common, bool objects) {
    to.add_metadata(std::string(kMetadataName) + "/" + named_.robot,
                    file_.metadata.at(kMetadataName));
    for (const auto& [name, attachment] : file_.attachments) {
      to.add_attachment(named_.robot + "/" + name, attachment.media_type, attachment.data);
    }
    for (const auto& [id, channel] : file_.channels) {
      if (channel.topic == kObjectsTopic && !objects) continue;
      const bool shared = is_of_all(channel.topic);
      const std::string topic =
          shared ? std::string(channel.topic) : "/" + named_.robot + std::string(channel.topic);
      const mcap::Schema& schema = file_.schemas.at(channel.schema);
      if (!shared || !common.contains(topic)) {
        common[topic] = to.add_channel(to.add_schema(schema.name, schema.encoding, schema.data),
                                       topic, channel.encoding);
      }
      channels_[id] = common[topic];
      if (schema.encoding == "ros2msg" && channel.topic != kObjectsTopic) {
        definitions_[id] = std::make_unique<ros::Definition>(schema.data);
      }
    }
  }

  /// False: it is no message of the merged file.
  bool write(const mcap::Message& message, mcap::Writer& to) const {
    const auto channel = channels_.find(message.channel);
    if (channel == channels_.end()) return false;
    const auto definition = definitions_.find(message.channel);
    if (definition == definitions_.end()) {
      to.add_message(channel->second, message.time_ns, message.data);
      return true;
    }
    const std::string prefix = named_.robot + "/";
    auto renamed = definition->second->with_frames(message.data, prefix);
    if (!renamed) {
      throw TraceError(named_.file, message.offset, "a message that is none of its type",
                       "record the run again");
    }
    if (file_.channels.at(message.channel).topic == kDescriptionTopic) {
      const auto urdf = ros::read_string(message.data);
      renamed = ros::string(ros::urdf_with_links(urdf.value_or(""), prefix));
    }
    to.add_message(channel->second, message.time_ns, *renamed);
    return true;
  }

 private:
  const NamedTrace named_;
  const std::string bytes_;
  const mcap::File file_;
  std::map<std::uint16_t, std::uint16_t> channels_;
  std::map<std::uint16_t, std::unique_ptr<ros::Definition>> definitions_;
};

struct Place {
  const Source* source;
  const mcap::Message* message;
};

std::vector<Place> in_order(const std::vector<std::unique_ptr<Source>>& sources) {
  std::vector<Place> all;
  for (const auto& source : sources) {
    for (const mcap::Message& message : source->file().messages) {
      all.push_back({source.get(), &message});
    }
  }
  std::stable_sort(all.begin(), all.end(), [](const Place& a, const Place& b) {
    return a.message->time_ns < b.message->time_ns;
  });
  return all;
}

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
    for (const Place& each : in_order(sources)) {
      if (!each.source->write(*each.message, writer)) continue;
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
