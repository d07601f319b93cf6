#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "host/trace/record/ros_messages.hpp"

namespace verp::record::ros {

extern const MessageType kRadio;  ///< a type of this project

struct Radio {
  std::uint32_t tick = 0;          ///< of the trace's robot
  std::string event;               ///< "said", "heard", or why it was not sent
  std::int32_t number = -1;        ///< equal in all traces of a run; -1: not sent
  std::int32_t from = 0, to = -1;  ///< robots; to -1: all
  std::string data;
};
std::string radio(const Radio& radio);
/// nullopt: another message.
std::optional<Radio> read_radio(std::string_view message);

}  // namespace verp::record::ros
