#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "host/trace/record/ros_messages.hpp"

/// Radio messages of robots, as a ROS 2 message in CDR.
namespace verp::record::ros {

extern const MessageType kRadio;  ///< verp_msgs/msg/Radio, a type of this project

struct Radio {
  std::uint32_t tick = 0;          ///< of the robot whose trace has the message
  std::string event;               ///< "said", "heard", or why a message was not sent
  std::int32_t number = -1;        ///< message number, equal in all traces of a run; -1: not sent
  std::int32_t from = 0, to = -1;  ///< robots; to -1: all
  std::string data;
};
std::string radio(const Radio& radio);
/// Decodes radio(). nullopt: not such a message.
std::optional<Radio> read_radio(std::string_view message);

}  // namespace verp::record::ros
