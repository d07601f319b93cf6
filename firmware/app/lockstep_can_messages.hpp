#pragma once
#include <cstddef>
#include <cstdint>

#include "common/base/can_frame.hpp"
#include "common/base/crc32.hpp"
#include "common/base/fields.hpp"
#include "firmware/app/lockstep_messages.hpp"

/// The CAN bus of a twin in lockstep, over any CAN bus: the PC's simulated time stands still until
/// the controller asks for more. Frames of the robot's bus pass unchanged, so that any CANopen tool
/// can read them. Clock messages have extended identifiers at the lowest priority, so that they
/// leave last. Ends: lockstep_can.hpp, and on the PC host/twin/can/lockstep_server.hpp.
/// Little-endian.
///
///     1FFFFF00, 01, 02   Hello, 8 bytes each                 controller, until it is answered
///     1FFFFF08           HelloReply                          PC
///
///     goals, SYNC        as they are                         controller
///     1FFFFF10           CanAdvance, for each new poll       controller
///     TPDOs and others   as they are                         PC
///     1FFFFF18           CanAdvanced                         PC
///
/// One answer brings a burst: the first frame within the timeout and those that follow it on the
/// robot's bus without a pause; possibly none. Frames may be lost, doubled or reordered:
///  - The twin sends a SYNC after all other frames of the same two polls, which it may have
///    overtaken.
///  - Both ends state how many frames they sent and the sum of their checks (sum_of()), in any
///    order. If frames to the twin do not match, it uses them as received and sets kFrameDamaged.
///  - The controller drops a mismatched answer and repeats its CanAdvance alone. The twin keeps
///    its last answer and advances time only for a new number.
///  - The controller repeats an unanswered CanAdvance after half a second, then later, up to 2 s.
///    Sooner, a loaded PC's answer would come twice and overflow a small FIFO.
namespace verp::lockstep {

inline constexpr std::uint32_t kCanHelloId = 0x1FFFFF00;
inline constexpr std::uint32_t kCanHelloReplyId = 0x1FFFFF08;
inline constexpr std::uint32_t kCanAdvanceId = 0x1FFFFF10;
inline constexpr std::uint32_t kCanAdvancedId = 0x1FFFFF18;
/// For any client, in real time too: one byte, 1, as register set_upright. The answer: 0, or 1 if a
/// servo has torque.
inline constexpr std::uint32_t kCanSetUprightId = 0x1FFFFF20;
inline constexpr std::uint32_t kCanSetUprightReplyId = 0x1FFFFF28;
inline constexpr std::uint32_t kCanHelloParts = sizeof(Hello) / kMaxCanData;
static_assert(kCanHelloParts * kMaxCanData == sizeof(Hello));
inline constexpr std::size_t kMaxBurst = 16;
/// Part of an SJA1000's 64-byte FIFO for a burst; a CanAdvanced needs the rest. If another client
/// fills it, the controller asks again.
inline constexpr std::size_t kBurstRoom = 64 - 13;
/// In a FIFO: frame information, identifier, data.
constexpr std::size_t room_of(const CanFrame& frame) {
  return std::size_t{frame.extended ? 5u : 3u} + frame.size;
}

/// Beside AdvanceFlag: the clock was not greeted, or restarted.
inline constexpr std::uint8_t kNotGreeted = 4;

struct CanAdvance {
  std::uint8_t sequence = 0;     ///< one more each time, modulo 256
  std::uint8_t sent = 0;         ///< frames since the previous one, modulo 256
  std::uint16_t sent_sum = 0;    ///< sum_of() of those frames
  std::uint32_t timeout_us = 0;  ///< as CanBus::poll: since the last frame began
  VERP_FIELDS(sequence, sent, sent_sum, timeout_us)
};
VERP_PACKED(CanAdvance);
static_assert(sizeof(CanAdvance) == kMaxCanData);

struct CanAdvanced {
  std::uint8_t sequence = 0;     ///< of the CanAdvance that this answers
  std::uint8_t flags_count = 0;  ///< flags: low three bits; above: frames of the burst
  std::uint16_t burst_sum = 0;   ///< sum_of() of the burst
  std::uint32_t now_low_us = 0;  ///< bus time at the burst's end, modulo 2^32
  VERP_FIELDS(sequence, flags_count, burst_sum, now_low_us)
};
VERP_PACKED(CanAdvanced);
static_assert(sizeof(CanAdvanced) == kMaxCanData);
inline constexpr int kCanCountShift = 3;
static_assert(kMaxBurst < 256 >> kCanCountShift);

/// Check of one frame; add those of several modulo 2^16.
inline std::uint16_t sum_of(const CanFrame& frame) {
  const std::uint32_t head[2] = {frame.id, std::uint32_t{frame.size} |
                                               std::uint32_t{frame.extended} << 8 |
                                               std::uint32_t{frame.remote} << 9};
  const std::uint32_t crc = crc32(frame.data, frame.size, crc32(head, sizeof head));
  return static_cast<std::uint16_t>(crc ^ crc >> 16);
}

template <class Payload>
CanFrame can_message(std::uint32_t id, const Payload& payload) {
  static_assert(sizeof payload <= kMaxCanData);
  CanFrame frame;
  frame.id = id;
  frame.extended = true;
  frame.size = sizeof payload;
  __builtin_memcpy(frame.data, &payload, sizeof payload);
  return frame;
}

/// True if the frame is this message; copies its `payload`.
template <class Payload>
bool take_message(const CanFrame& frame, std::uint32_t id, Payload& payload) {
  if (!frame.extended || frame.remote || frame.id != id || frame.size != sizeof payload) {
    return false;
  }
  __builtin_memcpy(&payload, frame.data, sizeof payload);
  return true;
}

constexpr bool is_clock_frame(const CanFrame& frame) {
  return frame.extended && frame.id >= kCanHelloId;
}

/// Collects the parts of a Hello in any order.
struct CanHello {
  Hello hello;
  std::uint32_t parts = 0;

  /// True once all are there; then it starts again.
  bool take(const CanFrame& frame) {
    std::uint8_t part[kMaxCanData];
    for (std::uint32_t i = 0; i < kCanHelloParts; ++i) {
      if (!take_message(frame, kCanHelloId + i, part)) continue;
      __builtin_memcpy(reinterpret_cast<std::uint8_t*>(&hello) + i * kMaxCanData, part,
                       kMaxCanData);
      parts |= 1u << i;
    }
    if (parts != (1u << kCanHelloParts) - 1) return false;
    parts = 0;
    return true;
  }
};

}  // namespace verp::lockstep
