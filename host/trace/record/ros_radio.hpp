#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "host/trace/record/ros_messages.hpp"

/// What robots say to each other by radio, as a ROS 2 message in CDR.
namespace verp::record::ros {

extern const MessageType kRadio;  ///< verp_msgs/msg/Radio, a type of this project

struct Radio {
  std::uint32_t tick = 0;    ///< of the robot in whose trace it stands
  std::string event;         ///< "said", "heard", or why a message was not sent
  std::int32_t number = -1;  ///< of the message, the same in all traces of a run; -1: not sent
  std::int32_t from = 0, to = -1;  ///< robots; to -1: everybody
  std::string data;
};
std::string radio(const Radio& radio);
/// What radio() was given. None: it is no such message.
std::optional<Radio> read_radio(std::string_view message);

}  // namespace verp::record::ros
