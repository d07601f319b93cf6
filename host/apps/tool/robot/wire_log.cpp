#include "host/apps/tool/robot/wire_log.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "common/protocol/canopen/cob_id.hpp"
#include "common/protocol/dynamixel2.hpp"
#include "common/protocol/feetech.hpp"
#include "host/run/session/not_up.hpp"
#include "host/run/session/session.hpp"

namespace verp::tool {
namespace {

constexpr const char* kPart = "bytes";  ///< without a header

using LineBytes = std::span<const std::uint8_t>;

std::string request_name(std::uint8_t instruction, std::uint8_t id, unsigned address) {
  switch (static_cast<dxl::Instruction>(instruction)) {  // Feetech's have the same numbers
    case dxl::Instruction::kPing:
      return fmt::format("ping {}", id);
    case dxl::Instruction::kRead:
      return fmt::format("read {} of {}", address, id);
    case dxl::Instruction::kWrite:
      return fmt::format("write {} of {}", address, id);
    case dxl::Instruction::kSyncRead:
      return fmt::format("sync read {}", address);
    case dxl::Instruction::kSyncWrite:
      return fmt::format("sync write {}", address);
    case dxl::Instruction::kFastSyncRead:
      return fmt::format("fast sync read {}", address);
    default:
      return fmt::format("instruction {:02X}", instruction);
  }
}

std::string serial_name(bool feetech, bool board, LineBytes bytes) {
  if (feetech) {
    if (bytes.size() < feetech::kInstructionBytes) return kPart;
    const unsigned address = bytes[feetech::kHeaderBytes + 1];
    return board ? request_name(bytes[feetech::kHeaderBytes], bytes[2], address)
                 : fmt::format("answer {}", bytes[2]);
  }
  const bool whole = bytes.size() >= dxl::kInstructionBytes &&
                     std::equal(std::begin(dxl::kHeader), std::end(dxl::kHeader), bytes.begin());
  if (!whole) return kPart;
  const std::uint8_t id = bytes[4];
  if (!board) return id == dxl::kBroadcast ? "fast answer" : fmt::format("answer {}", id);
  const unsigned address =
      bytes.size() > dxl::kInstructionBytes + 1 ? dxl::get_u16(&bytes[dxl::kHeaderBytes + 1]) : 0;
  return request_name(bytes[dxl::kHeaderBytes], id, address);
}

/// The name, and whether the controller sends it.
std::pair<std::string, bool> can_name(const CanFrame& frame) {
  using canopen::Service;
  const canopen::Connection at = canopen::connection_of(frame.id);
  switch (at.service) {
    case Service::kNmt:
      return {"NMT", true};
    case Service::kSync:
      return {fmt::format("SYNC {}", frame.size > 0 ? frame.data[0] : 0), true};
    case Service::kEmcy:
      return {fmt::format("EMCY {}", at.node), false};
    case Service::kTpdo:
      return {fmt::format("TPDO{} {}", at.number, at.node), false};
    case Service::kRpdo:
      return {fmt::format("RPDO{} {}", at.number, at.node), true};
    case Service::kSdoRequest:
      return {fmt::format("SDO to {}", at.node), true};
    case Service::kSdoResponse:
      return {fmt::format("SDO from {}", at.node), false};
    case Service::kHeartbeat:
      return {fmt::format("heartbeat {}", at.node), at.node == canopen::kMaxNode};
    default:
      return {fmt::format("COB-ID {:03X}", frame.id), false};
  }
}

class WireLog {
 public:
  explicit WireLog(session::Robot& robot) {
    if (robot.plan().params.bus_protocol == BusProtocol::kCia402) {
      robot.can().set_listener([this, &robot](const CanFrame& frame, auto begin_ns, auto end_ns) {
        const auto [name, board] = can_name(frame);
        const int tick = robot.can().ticking() ? static_cast<int>(robot.can().tick()) : -1;
        add({.board = board,
             .tick = tick,
             .name = name,
             .bytes = {frame.data, frame.data + frame.size}},
            begin_ns, end_ns);
      });
      return;
    }
    const bool feetech = robot.plan().params.bus_protocol == BusProtocol::kFeetech;
    robot.bus().set_listener(
        [=, this, &robot](bool master, LineBytes bytes, auto begin_ns, auto end_ns) {
          const int tick = robot.bus().ticking() ? static_cast<int>(robot.bus().tick()) : -1;
          add({.board = master,
               .tick = tick,
               .name = serial_name(feetech, master, bytes),
               .bytes = {bytes.begin(), bytes.end()}},
              begin_ns, end_ns);
        });
  }
  std::vector<WirePacket> packets;

 private:
  void add(WirePacket packet, std::uint64_t begin_ns, std::uint64_t end_ns) {
    packet.begin_us = 1e-3 * static_cast<double>(begin_ns);
    packet.end_us = 1e-3 * static_cast<double>(end_ns);
    packets.push_back(std::move(packet));
  }
};

/// Joins the devices' parts of one fast answer.
std::vector<WirePacket> joined(std::vector<WirePacket> packets) {
  std::vector<WirePacket> all;
  for (WirePacket& each : packets) {
    if (each.name == kPart && !all.empty() && all.back().end_us == each.begin_us) {
      all.back().end_us = each.end_us;
      all.back().bytes.insert(all.back().bytes.end(), each.bytes.begin(), each.bytes.end());
    } else {
      all.push_back(std::move(each));
    }
  }
  return all;
}

}  // namespace

std::vector<WirePacket> log_wire(const session::WalkPlan& plan, int end_tick, bool silent) {
  session::Session session;
  session::Robot& robot = session.add(plan);
  for (int id = 1; silent && id <= dxl::kMaxId; ++id) {
    robot.bus().set_connected(static_cast<std::uint8_t>(id), false);
  }
  WireLog log(robot);
  try {
    const auto begun = [&] { return log.packets.empty() ? -1 : log.packets.back().tick; };
    while (begun() < end_tick && session.tick() != nullptr) {
    }
  } catch (const session::NotUp&) {
    if (!silent) throw;
  }
  std::stable_sort(
      log.packets.begin(), log.packets.end(),
      [](const WirePacket& a, const WirePacket& b) { return a.begin_us < b.begin_us; });
  return joined(std::move(log.packets));
}

}  // namespace verp::tool
