#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "host/trace/live/server.hpp"
#include "host/trace/record/mcap_writer.hpp"
#include "host/trace/record/team_channel.hpp"

namespace verp::live {

/// Streams a robot's trace, except the channels for `verp replay`, whose encoding is our own.
class RobotStream : public record::mcap::Listener {
 public:
  /// The server must outlive the stream. `robot`: its name among several (record::TeamChannel);
  /// empty: a single robot.
  explicit RobotStream(Server& server, std::string robot = {})
      : server_(server), robot_(std::move(robot)) {}

  void schema(std::uint16_t id, const record::mcap::Schema& schema) override;
  void channel(std::uint16_t id, const record::mcap::Channel& channel) override;
  void message(std::uint16_t channel, std::uint64_t time_ns, std::string_view data) override;

 private:
  struct Schema {
    std::string name, encoding, data;
  };
  struct Streamed {
    std::uint32_t id = 0;
    std::optional<record::TeamChannel> team;  ///< nullopt: a single robot
  };

  Server& server_;
  std::string robot_;
  std::map<std::uint16_t, Schema> schemas_;
  std::map<std::uint16_t, Streamed> channels_;
};

}  // namespace verp::live
