#include "host/twin/bus/lockstep_server.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

namespace verp::bus {
namespace {

template <class Payload>
void append_status(std::vector<std::uint8_t>& answer, dxl::Error error, const Payload& payload) {
  std::uint8_t packet[lockstep::kMaxClockPacket];
  const std::size_t size = dxl::encode_status(
      packet, sizeof packet, lockstep::kClockId, static_cast<std::uint8_t>(error),
      reinterpret_cast<const std::uint8_t*>(&payload), sizeof payload);
  answer.insert(answer.end(), packet, packet + size);
}

void append_error(std::vector<std::uint8_t>& answer, dxl::Error error) {
  std::uint8_t packet[lockstep::kMaxClockPacket];
  const std::size_t size = dxl::encode_status(packet, sizeof packet, lockstep::kClockId,
                                              static_cast<std::uint8_t>(error), nullptr, 0);
  answer.insert(answer.end(), packet, packet + size);
}

template <class Payload>
bool payload_of(const dxl::Packet& packet, std::uint16_t address, Payload& payload) {
  if (packet.instruction != dxl::Instruction::kWrite || packet.size != 2 + sizeof payload ||
      dxl::get_u16(packet.parameters) != address) {
    return false;
  }
  std::memcpy(&payload, packet.parameters + 2, sizeof payload);
  return true;
}

}  // namespace

LockstepServer::LockstepServer(const Params& params, VirtualBus& bus, LockstepHooks hooks)
    : LockstepSession(params), bus_(bus), hooks_(std::move(hooks)) {}

void LockstepServer::take(std::span<const std::uint8_t> bytes, std::vector<std::uint8_t>& answer) {
  constexpr std::size_t kMostHeld =
      16 * hal::kMaxFrame;  // for a controller that never asks for time
  for (const std::uint8_t byte : bytes) {
    const bool complete = sieve_.push(byte, [this](std::uint8_t other) {
      if (frames_.size() < kMostHeld) frames_.push_back(other);
    });
    if (complete) handle(sieve_.packet(), answer);
  }
}

std::vector<std::uint8_t> LockstepServer::unannounced() {
  return greeted() ? std::vector<std::uint8_t>{} : std::exchange(frames_, {});
}

void LockstepServer::handle(const dxl::Packet& packet, std::vector<std::uint8_t>& answer) {
  lockstep::Hello greeting;
  lockstep::Advance request;
  if (packet.is_status()) return;
  if (payload_of(packet, lockstep::kHelloAddress, greeting)) return hello(greeting, answer);
  if (payload_of(packet, lockstep::kAdvanceAddress, request)) {
    if (greeted()) return advance(request, answer);
    frames_.clear();
    return append_error(answer, dxl::Error::kAccess);
  }
  std::uint8_t upright = 0;
  if (payload_of(packet, lockstep::kSetUprightAddress, upright)) {
    return append_error(answer, set_upright(upright));
  }
  if (packet.instruction != dxl::Instruction::kPing) {
    return append_error(answer, dxl::Error::kInstruction);
  }
  const std::uint8_t identity[3] = {lockstep::kClockModel & 0xFF, lockstep::kClockModel >> 8,
                                    lockstep::kVersion};
  append_status(answer, dxl::Error::kNone, identity);
}

dxl::Error LockstepServer::set_upright(std::uint8_t value) {
  if (value != 1) return dxl::Error::kDataRange;
  if (!hooks_.set_upright) return dxl::Error::kAccess;
  return hooks_.set_upright() ? dxl::Error::kNone : dxl::Error::kResultFail;
}

void LockstepServer::hello(const lockstep::Hello& hello, std::vector<std::uint8_t>& answer) {
  frames_.clear();
  const lockstep::Verdict verdict = meet(hello, hooks_).verdict;
  append_status(answer, greeted() ? dxl::Error::kNone : dxl::Error::kDataRange,
                lockstep::HelloReply{.verdict = verdict});
}

bool LockstepServer::send_frame(std::span<const std::uint8_t> frame, bool intact) {
  if (bus_.words().begins_tick(frame) && hooks_.tick_ends && !hooks_.tick_ends()) return false;
  bus_.send(frame.data(), frame.size());
  if (intact && hooks_.sent) hooks_.sent(frame);
  return true;
}

bool LockstepServer::send_frames(const lockstep::Advance& advance) {
  const bool intact = frames_.size() == advance.sent &&
                      dxl::crc16(frames_.data(), frames_.size()) == advance.sent_crc;
  if (!intact) note_damage(hooks_);
  // A lost frame still takes its time on the wire.
  if (frames_.empty()) frames_.resize(std::min<std::size_t>(advance.sent, hal::kMaxFrame));
  const bool ticking = bus_.ticking();
  const std::uint32_t tick = bus_.tick();
  for (std::span<const std::uint8_t> rest(frames_); !rest.empty();) {
    const std::size_t size = bus_.words().frame_size(rest);
    if (!send_frame(rest.first(size), intact)) {
      stopped_ = true;
      break;
    }
    rest = rest.subspan(size);
  }
  frames_.clear();
  return !stopped_ && bus_.ticking() && (!ticking || bus_.tick() != tick);
}

void LockstepServer::advance(const lockstep::Advance& advance, std::vector<std::uint8_t>& answer) {
  if (asks_again(advance.sequence)) {
    // The controller sends a repeat alone, so other frames with it are not its own.
    frames_.clear();
    answer.insert(answer.end(), last_.begin(), last_.end());
    return;
  }
  const std::uint32_t damaged = counters().damaged;
  lockstep::Advanced status{.sequence = advance.sequence};
  if (!stopped_ && send_frames(advance) && hooks_.tick_begins) hooks_.tick_begins(bus_.tick());
  last_.assign(std::min<std::size_t>(advance.capacity, lockstep::kMaxPollBytes), 0);
  last_.resize(stopped_ ? 0 : bus_.poll(last_.data(), last_.size(), advance.timeout_us));
  status.now_us = bus_.now_us();
  status.size = static_cast<std::uint16_t>(last_.size());
  status.crc = dxl::crc16(last_.data(), last_.size());
  if (stopped_) status.flags |= lockstep::kStop;
  if (counters().damaged != damaged) status.flags |= lockstep::kFrameDamaged;
  if (!stopped_ && hooks_.polled) hooks_.polled(last_, bus_.now_us());
  append_status(last_, dxl::Error::kNone, status);
  note_answer(advance.sequence);
  answer.insert(answer.end(), last_.begin(), last_.end());
}

}  // namespace verp::bus
