#include "host/trace/record/ros_radio.hpp"

#include "host/trace/record/cdr.hpp"

namespace verp::record::ros {

const MessageType kRadio = {"verp_msgs/msg/Radio", R"(uint32 tick
string event
int32 number
int32 from_robot
int32 to_robot
uint8[] data
)"};

std::string radio(const Radio& radio) {
  return Cdr()
      .put(radio.tick)
      .text(radio.event)
      .put(radio.number)
      .put(radio.from)
      .put(radio.to)
      .put(static_cast<std::uint32_t>(radio.data.size()))
      .bytes(radio.data)
      .take();
}

std::optional<Radio> read_radio(std::string_view message) {
  CdrReader in(message);
  Radio radio;
  radio.tick = in.get<std::uint32_t>();
  radio.event = in.text();
  radio.number = in.get<std::int32_t>();
  radio.from = in.get<std::int32_t>();
  radio.to = in.get<std::int32_t>();
  const auto size = in.get<std::uint32_t>();
  radio.data = in.bytes(size);
  if (!in.good) return std::nullopt;
  return radio;
}

}  // namespace verp::record::ros
