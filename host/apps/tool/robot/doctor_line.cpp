#include "host/apps/tool/robot/doctor_line.hpp"

#include <algorithm>
#include <numeric>

#include "common/protocol/control_table.hpp"
#include "common/protocol/dynamixel2.hpp"
#include "common/protocol/feetech.hpp"
#include "common/protocol/feetech_table.hpp"
#include "host/os/link/system_clock.hpp"

namespace verp::tool {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::uint32_t kPing_us = 253 * 3'000 + 16'000;  // as bus::Client waits
constexpr std::uint32_t kOldPing_us = 20'000;
constexpr std::uint8_t kOldIds = 30;  // a robot's ids begin at 1

// Protocol 1: FF FF, id, length, instruction or error, parameters, checksum (e-Manual, "DYNAMIXEL
// Protocol 1.0").
constexpr std::uint8_t kOldPing = 1;
constexpr std::size_t kOldPacket = 6;

std::uint8_t old_checksum(const std::uint8_t* from_id) {
  return static_cast<std::uint8_t>(~(from_id[0] + from_id[1] + from_id[2]));
}

std::set<int> old_answers(const Bytes& heard) {
  std::set<int> ids;
  for (std::size_t at = 0; at + kOldPacket <= heard.size(); ++at) {
    const std::uint8_t* packet = heard.data() + at;
    const bool begins = packet[0] == 0xFF && packet[1] == 0xFF && packet[2] <= dxl::kMaxId;
    if (begins && packet[3] == 2 && packet[5] == old_checksum(packet + 2)) ids.insert(packet[2]);
  }
  return ids;
}

Bytes hear(link::Link& link, std::uint32_t time_us) {
  Bytes heard;
  const std::uint64_t end_ns = link::monotonic_ns() + std::uint64_t{time_us} * 1000;
  for (std::uint64_t now_ns = 0; (now_ns = link::monotonic_ns()) < end_ns;) {
    std::uint8_t piece[512];
    const auto left_us = static_cast<std::uint32_t>((end_ns - now_ns) / 1000);
    const std::size_t count = link.read(piece, sizeof piece, left_us);
    heard.insert(heard.end(), piece, piece + count);
    if (heard.size() > (1U << 20)) break;  // noise without an end
  }
  return heard;
}

LineAnswer ask(link::Link& link, const Bytes& frame, std::uint32_t time_us) {
  link.write(frame.data(), frame.size(), time_us);
  return take_apart(frame, hear(link, time_us));
}

Bytes old_ping(std::uint8_t id) {
  Bytes frame = {0xFF, 0xFF, id, 2, kOldPing, 0};
  frame[5] = old_checksum(frame.data() + 2);
  return frame;
}

}  // namespace

LineAnswer take_apart(const Bytes& sent, Bytes heard) {
  LineAnswer answer;
  answer.echo = !sent.empty() && heard.size() >= sent.size() &&
                std::equal(sent.begin(), sent.end(), heard.begin());
  if (answer.echo) {
    heard.erase(heard.begin(), heard.begin() + static_cast<std::ptrdiff_t>(sent.size()));
  }
  answer.bytes = heard.size();
  dxl::Parser parser;
  std::size_t sound = 0;
  for (const std::uint8_t byte : heard) {
    for (bool more = parser.push(byte); more; more = parser.next()) {
      sound += parser.packet().size +
               (parser.packet().is_status() ? dxl::kStatusBytes : dxl::kInstructionBytes);
      if (parser.packet().is_status()) {
        answer.ids.insert(parser.packet().id);
      } else {
        answer.master = true;
      }
    }
  }
  answer.garbage = answer.bytes - std::min(answer.bytes, sound);
  answer.damaged = parser.crc_errors();
  answer.old_ids = old_answers(heard);
  return answer;
}

LineAnswer listen(link::Link& link, std::uint32_t time_us) {
  return take_apart({}, hear(link, time_us));
}

LineAnswer ping_one(link::Link& link, int id, std::uint32_t time_us) {
  Bytes frame(dxl::kInstructionBytes);
  dxl::encode_ping(frame.data(), frame.size(), static_cast<std::uint8_t>(id));
  return ask(link, frame, time_us);
}

LineAnswer read_one(link::Link& link, int id, std::uint32_t time_us) {
  Bytes frame(dxl::kInstructionBytes + 4);
  dxl::encode_read(frame.data(), frame.size(), static_cast<std::uint8_t>(id),
                   dxl::address::kPresentPosition, 4);
  return ask(link, frame, time_us);
}

LineAnswer read_one_feetech(link::Link& link, int id, std::uint32_t time_us) {
  std::uint8_t frame[16];
  const std::size_t size = feetech::encode_read(frame, sizeof frame, static_cast<std::uint8_t>(id),
                                                feetech::address::kPresentPosition, 2);
  return ask(link, {frame, frame + size}, time_us);
}

LineAnswer ping_all(link::Link& link) {
  return ping_one(link, dxl::kBroadcast, kPing_us);
}

LineAnswer ping_all_old(link::Link& link) {
  LineAnswer answer = ask(link, old_ping(dxl::kBroadcast), 10 * kOldPing_us);
  for (std::uint8_t id = 1; id <= kOldIds && answer.old_ids.empty(); ++id) {
    answer = ask(link, old_ping(id), kOldPing_us);
  }
  return answer;
}

}  // namespace verp::tool
