#include "host/trace/live/protocol.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "host/trace/record/mcap_format.hpp"

namespace verp::live {
namespace {

using Json = nlohmann::ordered_json;
using record::mcap::Bytes;

constexpr std::uint8_t kMessageData = 1, kTime = 2;
constexpr std::size_t kShown = 60;  // characters quoted in an answer

std::string text_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// Throws nlohmann's exceptions unless it has 32 bits.
std::uint32_t id_of(const Json& json) {
  const auto id = json.get<std::uint64_t>();
  if (!json.is_number_unsigned() || id > UINT32_MAX)
    throw Json::other_error::create(501, "an id is a whole number of 32 bits", &json);
  return static_cast<std::uint32_t>(id);
}

}  // namespace

std::string server_info(std::string_view name) {
  return text_of({{"op", "serverInfo"},
                  {"name", name},
                  {"capabilities", {"time"}},
                  {"supportedEncodings", Json::array()},
                  {"metadata", Json::object()}});
}

std::string advertise(const std::vector<Channel>& channels) {
  Json all = Json::array();
  for (const Channel& each : channels) {
    all.push_back({{"id", each.id},
                   {"topic", each.topic},
                   {"encoding", each.encoding},
                   {"schemaName", each.schema_name},
                   {"schemaEncoding", each.schema_encoding},
                   {"schema", each.schema}});
  }
  return text_of({{"op", "advertise"}, {"channels", all}});
}

std::string status(Level level, std::string_view message, std::string_view id) {
  Json json = {{"op", "status"}, {"level", static_cast<int>(level)}, {"message", message}};
  if (!id.empty()) json["id"] = id;
  return text_of(json);
}

std::string message_data(std::uint32_t subscription, std::uint64_t time_ns, std::string_view data) {
  return Bytes().u8(kMessageData).u32(subscription).u64(time_ns).raw(data).data;
}

std::string time(std::uint64_t time_ns) {
  return Bytes().u8(kTime).u64(time_ns).data;
}

Request parse_request(std::string_view text) {
  Request request;
  try {
    const Json json = Json::parse(text);
    const auto op = json.at("op").get<std::string>();
    if (op == "subscribe") {
      for (const Json& each : json.at("subscriptions"))
        request.subscribe.emplace_back(id_of(each.at("id")), id_of(each.at("channelId")));
    } else if (op == "unsubscribe") {
      for (const Json& each : json.at("subscriptionIds"))
        request.unsubscribe.push_back(id_of(each));
    } else {
      request.refused = fmt::format(
          "'{}' is not offered: a robot is watched here, not steered; subscribe and unsubscribe",
          op.substr(0, kShown));
    }
  } catch (const Json::exception& error) {
    request = {};
    request.refused =
        fmt::format("not understood: {}", std::string_view(error.what()).substr(0, 2 * kShown));
  }
  return request;
}

}  // namespace verp::live
