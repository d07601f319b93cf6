#include "host/twin/bus/order_packets.hpp"

#include "common/protocol/controller_table.hpp"
#include "common/protocol/dynamixel2.hpp"
#include "firmware/app/register_image.hpp"

namespace verp::bus {
namespace {

using app::reg;

void put16(std::vector<std::uint8_t>& bytes, int value) {
  bytes.push_back(static_cast<std::uint8_t>(value));
  bytes.push_back(static_cast<std::uint8_t>(value >> 8));
}

}  // namespace

void append_write(std::vector<std::uint8_t>& bytes, std::uint16_t address,
                  const std::vector<std::uint8_t>& data) {
  std::uint8_t packet[dxl::kMaxPacket];
  const std::size_t size = dxl::encode_write(packet, sizeof packet, dxl::controller::kDefaultId,
                                             address, data.data(), data.size());
  bytes.insert(bytes.end(), packet, packet + size);
}

// request to action_request are adjacent: one write carries one order.
std::size_t append_order(std::vector<std::uint8_t>& bytes, const app::OperatorOrder& order) {
  const Command& command = order.command;
  std::vector<std::uint8_t> data = {static_cast<std::uint8_t>(command.request), command.sequence};
  put16(data, command.vx_tenth_mm_s);
  put16(data, command.vy_tenth_mm_s);
  put16(data, command.wz_mrad_s);
  put16(data, command.head_pan_mrad);
  put16(data, command.head_tilt_mrad);
  data.resize(reg("head_mode") - reg("request"));  // no head target point
  data.push_back(static_cast<std::uint8_t>(dxl::controller::HeadMode::kAngles));
  data.push_back((order.flags & kEmergencyStop) != 0 ? 1 : 0);
  put16(data, order.action);
  append_write(bytes, reg("request"), data);
  if ((order.flags & kParameterWrite) == 0) return 1;
  std::vector<std::uint8_t> parameter;
  put16(parameter, order.parameter_id);
  put16(parameter, static_cast<int>(order.parameter_bits & 0xFFFF));
  put16(parameter, static_cast<int>(order.parameter_bits >> 16));
  append_write(bytes, reg("parameter_id"), parameter);
  return 2;
}

}  // namespace verp::bus
