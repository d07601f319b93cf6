#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// Foxglove's WebSocket protocol, server's side:
/// https://github.com/foxglove/ws-protocol/blob/main/docs/spec.md
namespace verp::live {

struct Channel {
  std::uint32_t id = 0;
  std::string topic, encoding, schema_name, schema_encoding, schema;
};

enum class Level { kInfo = 0, kWarning = 1, kError = 2 };

/// Text messages, in JSON.
std::string server_info(std::string_view name);
std::string advertise(const std::vector<Channel>& channels);
/// A status with an `id` replaces the last one with that `id`.
std::string status(Level level, std::string_view message, std::string_view id = {});

/// Binary messages.
std::string message_data(std::uint32_t subscription, std::uint64_t time_ns, std::string_view data);
std::string time(std::uint64_t time_ns);

struct Request {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> subscribe;  ///< subscription and channel
  std::vector<std::uint32_t> unsubscribe;                          ///< subscriptions
  std::string refused;                                             ///< fault; empty: valid
};

/// Total: invalid input sets `refused`.
Request parse_request(std::string_view text);

}  // namespace verp::live
