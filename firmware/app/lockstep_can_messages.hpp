#pragma once
#include <cstddef>
#include <cstdint>

#include "common/base/can_frame.hpp"
#include "common/base/crc32.hpp"
#include "common/base/fields.hpp"
#include "firmware/app/lockstep_messages.hpp"

/// The CAN bus of a twin in lockstep, over any CAN bus: a controller on a board or in an emulator,
/// and a PC whose simulated time stands still until the controller asks for more. Frames of the
/// robot's bus pass as they are, so that every tool that reads CANopen reads them; the messages of
/// the clock have extended identifiers, which CANopen does not use, and the lowest priority, so
/// that they leave after all that was to leave before. The controller's end is lockstep_can.hpp,
/// the PC's host/can/lockstep_server.hpp. All integers are little-endian.
///
///     1FFFFF00, 01, 02   Hello, 8 bytes each                 controller, until it is answered
///     1FFFFF08           HelloReply                          PC
///
///     goals, SYNC        as they are                         controller
///     1FFFFF10           CanAdvance, for each new poll       controller
///     TPDOs and others   as they are                         PC
///     1FFFFF18           CanAdvanced                         PC
///
/// One answer brings a burst: the frames that follow each other on the robot's bus without a rest,
/// after the first that arrives within the timeout; none, if none does. CAN looks after bits; what
/// can happen to frames on the way is loss, doubling and another order:
///  - A SYNC is on the twin's bus after all else that was sent between the same two polls: of one
///    controller's frames it may have overtaken the others on the way.
///  - Both ends say how many frames they sent, and the sum of their checks (sum_of()), which no
///    order changes. Frames to the twin that do not fit it are on its bus as they came, and it says
///    so (kFrameDamaged).
///  - An answer that does not fit is dropped and asked for again: the same CanAdvance, alone. The
///    twin keeps its last answer, and lets time go on for a new number only.
///  - A CanAdvance of which nothing came back is sent again after a while (half a second, then
///    longer, up to 2 s): sooner, and the answer of a PC under load would come twice, which a small
///    FIFO does not hold. A PC that finds it several times was that late, and answers once.
namespace verp::lockstep {

inline constexpr std::uint32_t kCanHelloId = 0x1FFFFF00;
inline constexpr std::uint32_t kCanHelloReplyId = 0x1FFFFF08;
inline constexpr std::uint32_t kCanAdvanceId = 0x1FFFFF10;
inline constexpr std::uint32_t kCanAdvancedId = 0x1FFFFF18;
/// For anybody, in real time too: one byte, 1, as register set_upright; the answer is one byte, 0,
/// or 1: a servo has torque.
inline constexpr std::uint32_t kCanSetUprightId = 0x1FFFFF20;
inline constexpr std::uint32_t kCanSetUprightReplyId = 0x1FFFFF28;
inline constexpr std::uint32_t kCanHelloParts = sizeof(Hello) / kMaxCanData;
static_assert(kCanHelloParts * kMaxCanData == sizeof(Hello));
/// Frames that one answer brings at most.
inline constexpr std::size_t kMaxBurst = 16;
/// And how much of an SJA1000's FIFO they may take, with what else the PC says to the controller's
/// node: 64 bytes, less a CanAdvanced. A controller that is emulated, or busy, finds all of it
/// there, unless somebody else asks it something just then; it asks for the answer again.
inline constexpr std::size_t kBurstRoom = 64 - 13;
/// What a frame takes of it: frame information, identifier, data.
constexpr std::size_t room_of(const CanFrame& frame) {
  return std::size_t{frame.extended ? 5u : 3u} + frame.size;
}

/// Flag of a CanAdvanced besides those in AdvanceFlag: the clock was not greeted, or began anew.
inline constexpr std::uint8_t kNotGreeted = 4;

struct CanAdvance {
  std::uint8_t sequence = 0;     ///< one more with each, modulo 256
  std::uint8_t sent = 0;         ///< frames sent since the one before, modulo 256
  std::uint16_t sent_sum = 0;    ///< of them, as sum_of()
  std::uint32_t timeout_us = 0;  ///< as CanBus::poll: since the last frame began on the wire
  VERP_FIELDS(sequence, sent, sent_sum, timeout_us)
};
VERP_PACKED(CanAdvance);
static_assert(sizeof(CanAdvance) == kMaxCanData);

struct CanAdvanced {
  std::uint8_t sequence = 0;     ///< of the CanAdvance that this answers
  std::uint8_t flags_count = 0;  ///< flags in the low three bits; frames of the burst above
  std::uint16_t burst_sum = 0;   ///< of them, as sum_of()
  std::uint32_t now_low_us = 0;  ///< bus time at the burst's end, modulo 2^32
  VERP_FIELDS(sequence, flags_count, burst_sum, now_low_us)
};
VERP_PACKED(CanAdvanced);
static_assert(sizeof(CanAdvanced) == kMaxCanData);
inline constexpr int kCanCountShift = 3;
static_assert(kMaxBurst < 256 >> kCanCountShift);

/// Check of one frame; those of several are added, modulo 2^16.
inline std::uint16_t sum_of(const CanFrame& frame) {
  const std::uint32_t head[2] = {frame.id, std::uint32_t{frame.size} |
                                               std::uint32_t{frame.extended} << 8 |
                                               std::uint32_t{frame.remote} << 9};
  const std::uint32_t crc = crc32(frame.data, frame.size, crc32(head, sizeof head));
  return static_cast<std::uint16_t>(crc ^ crc >> 16);
}

/// A frame of the clock.
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

/// True if the frame is such a message; then `payload` is what it says.
template <class Payload>
bool take_message(const CanFrame& frame, std::uint32_t id, Payload& payload) {
  if (!frame.extended || frame.remote || frame.id != id || frame.size != sizeof payload) {
    return false;
  }
  __builtin_memcpy(&payload, frame.data, sizeof payload);
  return true;
}

/// Whether a frame is of the clock, and none of the robot's bus.
constexpr bool is_clock_frame(const CanFrame& frame) {
  return frame.extended && frame.id >= kCanHelloId;
}

/// The parts of a Hello, in whatever order they come.
struct CanHello {
  Hello hello;
  std::uint32_t parts = 0;

  /// True once all parts are there; then begins anew.
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
