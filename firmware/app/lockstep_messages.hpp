#pragma once
#include <cstddef>
#include <cstdint>

#include "common/base/fields.hpp"
#include "common/protocol/dynamixel2.hpp"

/// The servo bus of a twin in lockstep, over a byte stream: the PC's simulated time stands still
/// until the controller asks for more. Everything is Dynamixel Protocol 2.0: bus frames unchanged,
/// and packets to and from the twin's clock, device 201. Ends: lockstep_bus.hpp, and on the PC
/// host/twin/bus/lockstep_server.hpp. Little-endian; offsets count before stuffing.
///
/// Hello, repeated until answered: a Write to address 64.
///
///     FF FF FD 00  C9  length  03  40 00  Hello (24 bytes)                  CRC      controller
///     FF FF FD 00  C9  length  55  00     HelloReply (4)                    CRC      PC
///
/// A Hello starts a session and discards answers of an earlier one. Before the first, the twin may
/// serve a master in real time. The reply names the first difference between both ends; the error
/// field is then Data Range (4).
///
/// A controller without this project's core leaves all but `version` 0; the twin refuses it if a
/// user checks every tick against that core.
///
/// Advance, for each FrameBus::poll(): the frames sent since the last one, then a Write to address
/// 96. The PC returns the bytes from the bus, then the clock's status packet. A control tick:
///
///     Sync Write goals, Sync Write torque (of the tick before), Sync Read positions   controller
///     FF FF FD 00  C9  length  03  60 00  Advance (12)                      CRC      controller
///     bytes of the bus: the servos' status packets                                   PC
///     FF FF FD 00  C9  length  55  00     Advanced (16)                     CRC      PC
///     Sync Read sensors, Advance; status packets, Advanced
///
/// Here a status packet that answers a Write carries data. A clock that was not greeted answers
/// Advance with Access (7) and no data: the twin restarted, and so must the controller.
///
/// Damage. The wall clock only decides when to ask again.
///  - A frame damaged on its way is damaged on the bus: the controller's timeout passes in
///    simulated time. The twin detects it by `sent` and `sent_crc`, sets kFrameDamaged and counts
///    it. A frame that vanishes still takes its time on the wire.
///  - The controller repeats an unanswered Advance, alone and with the same number, after 50 ms,
///    then later, up to 1 s.
///  - Likewise after a damaged answer (no valid status packet, or `size` and `crc` do not match the
///    bytes before it), at once if a status packet came. The twin keeps its last answer; only a new
///    number advances time. So the controller gets exactly the bytes of the bus, and their time.
///  - Late answers to earlier numbers are dropped with their bytes.
///  - A packet's header cannot occur within another packet, so a wrong length hides nothing.
namespace verp::lockstep {

inline constexpr std::uint8_t kClockId = 201;
inline constexpr std::uint16_t kClockModel = 0x7603;  ///< ours, as in control_table.hpp
inline constexpr std::uint8_t kVersion = 1;
inline constexpr std::uint16_t kHelloAddress = 64;
inline constexpr std::uint16_t kAdvanceAddress = 96;
/// Register set_upright, one byte: 1 puts a limp, lying robot on its feet and holds it until it is
/// armed. Only the twin has it, for any client, in real time too. Result Fail: a servo has torque.
inline constexpr std::uint16_t kSetUprightAddress = 120;
inline constexpr std::size_t kMaxPollBytes = dxl::kMaxPacket;  ///< bytes in one answer
inline constexpr std::size_t kMaxClockPacket = 64;             ///< stuffing included

struct Hello {
  std::uint8_t version = kVersion;
  std::uint8_t reserved[3] = {};
  std::uint32_t core_version = 0;
  std::uint32_t params_size = 0;
  std::uint32_t params_crc = 0;  ///< CRC-32 of the Params bytes
  std::uint32_t record_size = 0;
  std::uint32_t state_size = 0;
  VERP_FIELDS(version, reserved, core_version, params_size, params_crc, record_size, state_size)
};
VERP_PACKED(Hello);

enum class Verdict : std::uint8_t {
  kAccepted = 0,
  kOtherLink = 1,    ///< another `version`
  kOtherCore = 2,    ///< the same inputs would give other bits
  kOtherLayout = 3,  ///< other sizes of Params, TickRecord or State
  kOtherRobot = 4,
  kNoLockstep = 5,  ///< the twin runs in real time
  kNoAnswer = 255,  ///< never sent: no answer came
};

struct HelloReply {
  std::uint8_t version = kVersion;
  Verdict verdict = Verdict::kAccepted;
  std::uint16_t reserved = 0;
  VERP_FIELDS(version, verdict, reserved)
};
VERP_PACKED(HelloReply);

struct Advance {
  std::uint8_t sequence = 0;  ///< one more with each poll, modulo 256
  std::uint8_t reserved = 0;
  std::uint16_t capacity = 0;    ///< bytes wanted, up to kMaxPollBytes
  std::uint32_t timeout_us = 0;  ///< as FrameBus::poll: since the last frame began
  std::uint16_t sent = 0;        ///< frame bytes since the last Advance
  std::uint16_t sent_crc = 0;    ///< their CRC-16 (dxl::crc16)
  VERP_FIELDS(sequence, reserved, capacity, timeout_us, sent, sent_crc)
};
VERP_PACKED(Advance);

enum AdvanceFlag : std::uint8_t {
  kStop = 1,          ///< the run is over; time stands still
  kFrameDamaged = 2,  ///< frames before this Advance arrived damaged
};

struct Advanced {
  std::uint64_t now_us = 0;   ///< bus time
  std::uint8_t sequence = 0;  ///< of the Advance that this answers
  std::uint8_t flags = 0;     ///< AdvanceFlag bits
  std::uint16_t size = 0;     ///< bus bytes in front of this packet
  std::uint16_t crc = 0;      ///< their CRC-16
  std::uint16_t reserved = 0;
  VERP_FIELDS(now_us, sequence, flags, size, crc, reserved)
};
VERP_PACKED(Advanced);

/// Extracts clock packets from a stream; passes the rest on in order. Holds back at most
/// kMaxClockPacket bytes that may start such a packet.
class ClockSieve {
 public:
  /// True: a clock packet is complete; packet() is valid until the next call. `pass(byte)` gets
  /// each other byte.
  template <class Pass>
  bool push(std::uint8_t byte, Pass&& pass) {
    if (complete_) forget();
    held_[size_++] = byte;
    while (size_ > 0) {
      const Look look = this->look();
      if (look == Look::kMore) return false;
      if (look == Look::kPacket) return true;
      pass(held_[0]);
      --size_;
      for (std::size_t i = 0; i < size_; ++i) held_[i] = held_[i + 1];
    }
    return false;
  }
  const dxl::Packet& packet() const { return parser_.packet(); }
  void forget() {
    complete_ = false;
    size_ = 0;
  }

 private:
  enum class Look { kMore, kDrop, kPacket };
  static constexpr std::uint8_t kHeader[] = {0xFF, 0xFF, 0xFD, 0x00, kClockId};
  static constexpr std::size_t kHeadless = 4;  ///< header without the id

  Look look() {
    for (std::size_t i = 0; i < sizeof kHeader && i < size_; ++i) {
      if (held_[i] != kHeader[i]) return Look::kDrop;
    }
    if (begins_again()) return Look::kDrop;
    if (size_ < dxl::kHeaderBytes) return Look::kMore;
    const std::size_t end = dxl::kHeaderBytes + dxl::get_u16(held_ + dxl::kHeaderBytes - 2);
    if (end < dxl::kInstructionBytes || end > kMaxClockPacket) return Look::kDrop;
    if (size_ < end) return Look::kMore;
    parser_.reset();
    for (std::size_t i = 0; i < end; ++i) complete_ = parser_.push(held_[i]);
    return complete_ ? Look::kPacket : Look::kDrop;
  }

  /// A header within a packet: the packet before it was cut short.
  bool begins_again() const {
    if (size_ < kHeadless + sizeof kHeader) return false;
    for (std::size_t i = 0; i < kHeadless; ++i) {
      if (held_[size_ - kHeadless + i] != kHeader[i]) return false;
    }
    return true;
  }

  dxl::Parser parser_;
  bool complete_ = false;
  std::size_t size_ = 0;
  std::uint8_t held_[kMaxClockPacket] = {};
};

}  // namespace verp::lockstep
