#include "host/trace/live/robot_stream.hpp"

#include "host/trace/record/trace.hpp"

namespace verp::live {

void RobotStream::schema(std::uint16_t id, const record::mcap::Schema& schema) {
  schemas_[id] = {std::string(schema.name), std::string(schema.encoding), std::string(schema.data)};
}

void RobotStream::channel(std::uint16_t id, const record::mcap::Channel& channel) {
  const Schema& schema = schemas_.at(channel.schema);
  if (schema.encoding == "verp") return;
  Streamed streamed;
  std::string topic(channel.topic);
  if (!robot_.empty()) {
    streamed.team.emplace(robot_, topic,
                          record::mcap::Schema{schema.name, schema.encoding, schema.data});
    topic = streamed.team->topic();
  }
  const bool is_of_all = streamed.team && streamed.team->is_of_all();
  const auto known = is_of_all ? server_.find_channel(topic) : std::nullopt;
  if (known && topic == record::kObjectsTopic) return;  // another robot's stream sends them
  streamed.id = known ? *known
                      : server_.add_channel({.id = 0,
                                             .topic = topic,
                                             .encoding = std::string(channel.encoding),
                                             .schema_name = schema.name,
                                             .schema_encoding = schema.encoding,
                                             .schema = schema.data});
  channels_.emplace(id, std::move(streamed));
}

void RobotStream::message(std::uint16_t channel, std::uint64_t time_ns, std::string_view data) {
  const auto to = channels_.find(channel);
  if (to == channels_.end()) return;
  const Streamed& streamed = to->second;
  if (!streamed.team) return server_.send(streamed.id, time_ns, data);
  if (const auto renamed = streamed.team->message(data))
    server_.send(streamed.id, time_ns, *renamed);
}

}  // namespace verp::live
