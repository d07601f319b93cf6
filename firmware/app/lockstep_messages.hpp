#pragma once
#include <cstddef>
#include <cstdint>

#include "common/base/fields.hpp"
#include "common/protocol/dynamixel2.hpp"

/// The servo bus of a twin over a stream of bytes, in lockstep: a controller on a serial port, a
/// pseudo-terminal or a socket, and a PC whose simulated time stands still until the controller
/// asks for more. Everything on the stream is Dynamixel Protocol 2.0: the frames of the servo bus
/// as they are, and packets to and from the twin's clock, which is device 201. The controller's end
/// is lockstep_bus.hpp, the PC's host/bus/lockstep_server.hpp. All integers are little-endian;
/// byte offsets below count before stuffing.
///
/// Hello, once, and again until it is answered: a Write to address 64 of the clock.
///
///     FF FF FD 00  C9  length  03  40 00  Hello (24 bytes)                  CRC      controller
///     FF FF FD 00  C9  length  55  00     HelloReply (4)                    CRC      PC
///
/// A hello begins a session: the clock's answers to an earlier one are forgotten. Before the first,
/// a twin does not let its time go on by these rules (it may serve a master in real time). The
/// reply names the first thing on which both ends differ; the error field is then Data Range (4).
///
/// A controller that is not made of this project's core leaves all but `version` 0. It is as
/// welcome, unless somebody holds every tick of it against that core.
///
/// Advance, for each FrameBus::poll(): the frames sent since the last one, then a Write to address
/// 96 of the clock; back come the bytes that the bus brought, then the clock's status packet. A
/// tick of the control loop on the stream:
///
///     Sync Write goals, Sync Write torque (of the tick before), Sync Read positions   controller
///     FF FF FD 00  C9  length  03  60 00  Advance (12)                      CRC      controller
///     bytes of the bus: the servos' status packets                                   PC
///     FF FF FD 00  C9  length  55  00     Advanced (16)                     CRC      PC
///     Sync Read sensors, Advance; status packets, Advanced
///
/// A status packet that answers a Write carries data here, which other devices' don't. A clock that
/// was not greeted answers Advance with Access (7) and no data: the twin began anew, and so must
/// the controller.
///
/// Damage. Nothing of it is decided by the wall's clock; it only decides when to ask again.
///  - A frame that is damaged on its way is damaged on the bus: the servos don't understand it, and
///    the controller's timeout passes in simulated time. The twin sees by Advance's `sent` and
///    `sent_crc` that it happened, says so (kFrameDamaged) and counts it. A frame that vanishes
///    whole takes its time on the wire all the same.
///  - An Advance that is lost or damaged is sent again, alone and with the same sequence number, if
///    nothing came back for a while (50 ms, then longer, up to 1 s).
///  - An answer that is damaged (no good status packet, or Advanced's `size` and `crc` don't fit
///    the bytes before it) is asked for again in the same way, at once if a status packet came. The
///    twin keeps its last answer and gives it again; time goes on for a new number only. So the
///    controller gets exactly the bytes that the bus brought, and when.
///  - Answers to earlier numbers may still arrive; they are dropped with the bytes before them.
///  - A packet to the clock is found in any stream: its header cannot occur within another packet,
///    so a wrong length before it hides nothing.
namespace verp::lockstep {

inline constexpr std::uint8_t kClockId = 201;
inline constexpr std::uint16_t kClockModel = 0x7603;  ///< ours, as those in control_table.hpp
inline constexpr std::uint8_t kVersion = 1;           ///< of this page
inline constexpr std::uint16_t kHelloAddress = 64;
inline constexpr std::uint16_t kAdvanceAddress = 96;
/// Register set_upright, one byte: 1 sets a limp robot that lies on its feet, and holds it until it
/// is armed. Of the twin alone, for anybody, in real time too. Result Fail: a servo has torque.
inline constexpr std::uint16_t kSetUprightAddress = 120;
inline constexpr std::size_t kMaxPollBytes =
    dxl::kMaxPacket;                                ///< most bytes that one answer brings
inline constexpr std::size_t kMaxClockPacket = 64;  ///< stuffing included

struct Hello {
  std::uint8_t version = kVersion;
  std::uint8_t reserved[3] = {};
  std::uint32_t core_version = 0;
  std::uint32_t params_size = 0;
  std::uint32_t params_crc = 0;  ///< CRC-32 of the Params' bytes
  std::uint32_t record_size = 0;
  std::uint32_t state_size = 0;
  VERP_FIELDS(version, reserved, core_version, params_size, params_crc, record_size, state_size)
};
VERP_PACKED(Hello);

enum class Verdict : std::uint8_t {
  kAccepted = 0,
  kOtherLink = 1,    ///< another `version` of these messages
  kOtherCore = 2,    ///< another core: same inputs would not give the same bits
  kOtherLayout = 3,  ///< Params, TickRecord or State have other sizes
  kOtherRobot = 4,   ///< other Params
  kNoLockstep = 5,   ///< the twin runs in real time
  kNoAnswer = 255,   ///< never sent: nobody answered, and the controller stopped waiting
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
  std::uint16_t capacity = 0;    ///< bytes wanted at most, up to kMaxPollBytes
  std::uint32_t timeout_us = 0;  ///< as FrameBus::poll: since the last frame began on the wire
  std::uint16_t sent = 0;        ///< bytes of the frames sent since the last Advance
  std::uint16_t sent_crc = 0;    ///< their CRC-16, as dxl::crc16
  VERP_FIELDS(sequence, reserved, capacity, timeout_us, sent, sent_crc)
};
VERP_PACKED(Advance);

enum AdvanceFlag : std::uint8_t {
  kStop = 1,          ///< the run is over; time does not go on
  kFrameDamaged = 2,  ///< frames sent before this Advance did not arrive as they were sent
};

struct Advanced {
  std::uint64_t now_us = 0;   ///< bus time
  std::uint8_t sequence = 0;  ///< of the Advance that this answers
  std::uint8_t flags = 0;     ///< AdvanceFlag bits
  std::uint16_t size = 0;     ///< bytes of the bus in front of this packet
  std::uint16_t crc = 0;      ///< their CRC-16
  std::uint16_t reserved = 0;
  VERP_FIELDS(now_us, sequence, flags, size, crc, reserved)
};
VERP_PACKED(Advanced);

/// Takes the packets of the clock out of a stream and passes everything else on, in order. At most
/// kMaxClockPacket bytes are held back, and only while they may be the beginning of such a packet.
class ClockSieve {
 public:
  /// Takes a byte; true when a packet from or to the clock is complete: packet(), until the next
  /// call. `pass(byte)` gets each byte that belongs to none.
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
  /// Drops what it holds back.
  void forget() {
    complete_ = false;
    size_ = 0;
  }

 private:
  enum class Look { kMore, kDrop, kPacket };
  static constexpr std::uint8_t kHeader[] = {0xFF, 0xFF, 0xFD, 0x00, kClockId};
  static constexpr std::size_t kHeadless = 4;  ///< bytes of a header without the id

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

  /// A header within a packet: the one before it was cut short.
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
