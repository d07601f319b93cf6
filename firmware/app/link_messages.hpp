#pragma once
#include <cstdint>

#include "common/base/fields.hpp"
#include "firmware/app/contracts.hpp"

/// The FrameBus of an emulated microcontroller: remote calls over a pair of byte streams (two FIFOs
/// that firmware opens by semihosting). The PC's end is host/bus/bus_server.hpp. All integers
/// little-endian, structs as laid out.
///
/// Controller to PC: any number of messages, each a MessageHeader and `size` payload bytes. Only
/// kHello and kPoll are answered, so a client appends everything else to one buffer and writes it
/// together with the next kPoll: each write or read is a semihosting call and costs an exit of the
/// emulator.
///
///     one tick:  write [kOutputs][kRecord of the last tick][kSend Fast Sync Read][kPoll]
///                read PollReply
///                write [kSend Sync Read][kPoll]
///                read PollReply
///                [kSend Sync Write][kSend Sync Write]
///
/// PC to controller: exactly one reply to each kHello and kPoll, always in one write. A PollReply
/// with its bytes stays under 4096 bytes, so a FIFO carries it whole and one read of kMaxReply
/// bytes returns all of it; a client still loops until `size` bytes are there. A HelloReply is
/// longer: read until complete.
namespace verp::link {

inline constexpr std::uint32_t kVersion = 2;
inline constexpr std::uint32_t kMaxPollBytes = 1024;  ///< most bytes one PollReply carries

enum class Kind : std::uint8_t {
  kHello = 'H',    ///< payload Hello; answered by HelloReply. First message, once
  kSend = 'S',     ///< payload: the bytes of one frame, as FrameBus::send
  kPoll = 'P',     ///< payload Poll; answered by PollReply, as FrameBus::poll
  kOutputs = 'O',  ///< payload: Outputs of the tick that the next kRecord ends
  kRecord = 'R',   ///< payload: TickRecord of the tick just finished
  kState = 'X',    ///< payload: State as the tick that the next kRecord ends left it (every
                   ///< HelloReply::state_every ticks, and when the fault bits change)
  kQuit = 'Q',     ///< payload: Quit, then text; the controller ends
};

struct MessageHeader {
  Kind kind = Kind::kPoll;
  std::uint8_t reserved = 0;
  std::uint16_t size = 0;  ///< payload bytes that follow
  VERP_FIELDS(kind, reserved, size)
};
VERP_PACKED(MessageHeader);

/// Sizes let the PC refuse a firmware whose structs are not its own, before a single tick.
struct Hello {
  std::uint32_t version = kVersion;
  std::uint32_t params_size = 0;
  std::uint32_t record_size = 0;
  std::uint32_t state_size = 0;
  VERP_FIELDS(version, params_size, record_size, state_size)
};
VERP_PACKED(Hello);

enum class HelloStatus : std::uint32_t { kReady = 0, kWrongVersion = 1, kWrongSizes = 2 };

/// Followed by params_size bytes of Params, then actions_size bytes of an action library, when
/// status is kReady.
struct HelloReply {
  HelloStatus status = HelloStatus::kReady;
  std::uint32_t params_size = 0;
  std::uint32_t ticks = 0;          ///< stop by yourself after so many ticks; 0: run until kStop
  std::uint32_t state_every = 125;  ///< send kState whenever tick % state_every == 0; 0: never
  std::uint32_t actions_size = 0;   ///< a multiple of 4; 0: the robot has none
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
  kStop = 1,        ///< the run is over: finish this tick, send kQuit
  kSendFailed = 2,  ///< a frame sent before this poll was refused by the bus
};

/// Followed by `size` bytes from the bus. The order is that of the current tick and repeated in
/// every reply: a client's OperatorLink returns the order of the latest reply.
struct PollReply {
  std::uint64_t now_us = 0;
  std::uint16_t size = 0;
  std::uint16_t flags = 0;  ///< PollFlag bits
  std::uint32_t reserved = 0;
  app::OperatorOrder order;
  VERP_FIELDS(now_us, size, flags, reserved, order)
};

/// Followed by size - 4 bytes of text: one line that says why.
struct Quit {
  std::uint32_t exit_code =
      0;  ///< as the verp program's: 0 good, 1 the run failed, 2 bad input, 3 link
  VERP_FIELDS(exit_code)
};
VERP_PACKED(Quit);

inline constexpr std::uint32_t kMaxReply = sizeof(PollReply) + kMaxPollBytes;
static_assert(packed_size<PollReply>() == sizeof(PollReply) && kMaxReply <= 4096);

}  // namespace verp::link
