#pragma once
#include <cstdint>

#include "common/base/fields.hpp"
#include "firmware/app/contracts.hpp"

/// The FrameBus of an emulated microcontroller: remote calls over two byte streams (FIFOs by
/// semihosting). The PC's end is host/twin/bus/bus_server.hpp. Little-endian, structs as laid out.
///
/// Controller to PC: MessageHeader and `size` payload bytes. Only kHello and kPoll get a reply. A
/// client buffers everything else until the next kPoll, because each semihosting call costs an exit
/// of the emulator.
///
///     one tick:  write [kOutputs][kRecord of the last tick][kSend Fast Sync Read][kPoll]
///                read PollReply
///                write [kSend Sync Read][kPoll]
///                read PollReply
///                [kSend Sync Write][kSend Sync Write]
///
/// PC to controller: each reply is one write. A PollReply with its bytes stays under 4096 bytes, so
/// a FIFO carries it whole; a client still loops until `size` bytes are there. A HelloReply is
/// longer.
namespace verp::link {

inline constexpr std::uint32_t kVersion = 2;
inline constexpr std::uint32_t kMaxPollBytes = 1024;  ///< bytes in one PollReply

enum class Kind : std::uint8_t {
  kHello = 'H',    ///< Hello; first, once; reply: HelloReply
  kSend = 'S',     ///< one frame
  kPoll = 'P',     ///< Poll; reply: PollReply
  kOutputs = 'O',  ///< Outputs of the next kRecord's tick
  kRecord = 'R',   ///< TickRecord of a finished tick
  kState = 'X',  ///< State after the next kRecord's tick (every HelloReply::state_every ticks, and
                 ///< when fault bits change)
  kQuit = 'Q',   ///< Quit, then text; the controller ends
};

struct MessageHeader {
  Kind kind = Kind::kPoll;
  std::uint8_t reserved = 0;
  std::uint16_t size = 0;  ///< payload bytes
  VERP_FIELDS(kind, reserved, size)
};
VERP_PACKED(MessageHeader);

/// The PC refuses a firmware whose structs have other sizes.
struct Hello {
  std::uint32_t version = kVersion;
  std::uint32_t params_size = 0;
  std::uint32_t record_size = 0;
  std::uint32_t state_size = 0;
  VERP_FIELDS(version, params_size, record_size, state_size)
};
VERP_PACKED(Hello);

enum class HelloStatus : std::uint32_t { kReady = 0, kWrongVersion = 1, kWrongSizes = 2 };

/// If status is kReady, params_size bytes of Params follow, then actions_size bytes of an action
/// library.
struct HelloReply {
  HelloStatus status = HelloStatus::kReady;
  std::uint32_t params_size = 0;
  std::uint32_t ticks = 0;          ///< stop after these; 0: run until kStop
  std::uint32_t state_every = 125;  ///< kState when tick % state_every == 0; 0: never
  std::uint32_t actions_size = 0;   ///< a multiple of 4; 0: no actions
  VERP_FIELDS(status, params_size, ticks, state_every, actions_size)
};
VERP_PACKED(HelloReply);

struct Poll {
  std::uint32_t timeout_us = 0;  ///< as FrameBus::poll
  std::uint16_t capacity = 0;    ///< at most kMaxPollBytes
  std::uint16_t reserved = 0;
  VERP_FIELDS(timeout_us, capacity, reserved)
};
VERP_PACKED(Poll);

enum PollFlag : std::uint16_t {
  kStop = 1,        ///< finish this tick, send kQuit
  kSendFailed = 2,  ///< the bus refused a frame sent before this poll
};

/// `size` bytes from the bus follow. Every reply repeats the current tick's order; OperatorLink
/// returns that of the latest.
struct PollReply {
  std::uint64_t now_us = 0;
  std::uint16_t size = 0;
  std::uint16_t flags = 0;  ///< PollFlag bits
  std::uint32_t reserved = 0;
  app::OperatorOrder order;
  VERP_FIELDS(now_us, size, flags, reserved, order)
};

/// size - 4 bytes of text follow: the reason, one line.
struct Quit {
  std::uint32_t exit_code = 0;  ///< 0 good, 1 run failed, 2 bad input, 3 link
  VERP_FIELDS(exit_code)
};
VERP_PACKED(Quit);

inline constexpr std::uint32_t kMaxReply = sizeof(PollReply) + kMaxPollBytes;
static_assert(packed_size<PollReply>() == sizeof(PollReply) && kMaxReply <= 4096);

}  // namespace verp::link
