#pragma once
#include <cstddef>
#include <cstdint>

#include "common/protocol/canopen/cob_id.hpp"
#include "common/protocol/canopen/dictionary.hpp"
#include "common/protocol/canopen/frame.hpp"

/// Network management and heartbeat, both sides (CiA 301). Bus time in microseconds.
namespace verp::canopen {

/// Values as in a heartbeat.
enum class NmtState : std::uint8_t {
  kInitialising = 0,  ///< the boot-up message
  kStopped = 4,
  kOperational = 5,
  kPreOperational = 127,
};

enum class NmtCommand : std::uint8_t {
  kStart = 1,
  kStop = 2,
  kEnterPreOperational = 128,
  kResetNode = 129,
  kResetCommunication = 130,
};

/// Node 0 addresses all nodes.
constexpr Frame nmt_frame(NmtCommand command, std::uint8_t node) {
  Frame frame = classic_frame(kNmtId, 2);
  frame.data[0] = static_cast<std::uint8_t>(command);
  frame.data[1] = node;
  return frame;
}

constexpr bool may_pdo(NmtState state) {
  return state == NmtState::kOperational;
}
/// For SDO, SYNC and EMCY.
constexpr bool may_sdo(NmtState state) {
  return state == NmtState::kOperational || state == NmtState::kPreOperational;
}

/// Object 1029h:1: reaction to a communication error.
enum class ErrorBehaviour : std::uint8_t { kPreOperational = 0, kStay = 1, kStop = 2 };

enum class NmtEvent : std::uint8_t { kNone, kState, kResetNode, kResetCommunication };

class NmtSlave {
 public:
  constexpr explicit NmtSlave(std::uint8_t node) : node_(node) {}

  constexpr NmtState state() const { return state_; }
  /// HeartbeatProducer sends the boot-up message.
  constexpr void initialised() {
    if (state_ == NmtState::kInitialising) state_ = NmtState::kPreOperational;
  }
  /// Communication error: leaves operational (1029h).
  constexpr NmtEvent fall_back(ErrorBehaviour behaviour) {
    if (state_ != NmtState::kOperational || behaviour == ErrorBehaviour::kStay) {
      return NmtEvent::kNone;
    }
    return enter(behaviour == ErrorBehaviour::kStop ? NmtState::kStopped
                                                    : NmtState::kPreOperational);
  }
  /// After a reset the node initialises and then calls initialised().
  constexpr NmtEvent receive(const Frame& frame) {
    if (!is_canopen(frame) || frame.id != kNmtId || frame.size != 2) return NmtEvent::kNone;
    if (frame.data[1] != 0 && frame.data[1] != node_) return NmtEvent::kNone;
    if (state_ == NmtState::kInitialising) return NmtEvent::kNone;
    switch (static_cast<NmtCommand>(frame.data[0])) {
      case NmtCommand::kStart:
        return enter(NmtState::kOperational);
      case NmtCommand::kStop:
        return enter(NmtState::kStopped);
      case NmtCommand::kEnterPreOperational:
        return enter(NmtState::kPreOperational);
      case NmtCommand::kResetNode:
        state_ = NmtState::kInitialising;
        return NmtEvent::kResetNode;
      case NmtCommand::kResetCommunication:
        state_ = NmtState::kInitialising;
        return NmtEvent::kResetCommunication;
    }
    return NmtEvent::kNone;
  }

 private:
  constexpr NmtEvent enter(NmtState next) {
    if (state_ == next) return NmtEvent::kNone;
    state_ = next;
    return NmtEvent::kState;
  }
  std::uint8_t node_;
  NmtState state_ = NmtState::kInitialising;
};

constexpr Frame heartbeat_frame(std::uint8_t node, NmtState state) {
  Frame frame = classic_frame(heartbeat_id(node), 1);
  frame.data[0] = static_cast<std::uint8_t>(state);
  return frame;
}
constexpr bool decode_heartbeat(const Frame& frame, std::uint8_t& node, NmtState& state) {
  if (!is_canopen(frame) || frame.size != 1) return false;
  const Connection connection = connection_of(frame.id);
  if (connection.service != Service::kHeartbeat) return false;
  node = connection.node;
  state = static_cast<NmtState>(frame.data[0] & 0x7F);  // the high bit is node guarding's toggle
  return true;
}

/// A boot-up message after each initialisation, then a heartbeat every 1017h milliseconds (0:
/// none). A late caller skips periods.
class HeartbeatProducer {
 public:
  constexpr explicit HeartbeatProducer(std::uint8_t node) : node_(node) {}

  /// Object 1017h. Starts a new period.
  constexpr void set_period_ms(std::uint16_t period_ms) {
    period_ms_ = period_ms;
    due_us_ = 0;
  }
  constexpr std::uint16_t period_ms() const { return period_ms_; }
  constexpr void restart() { booted_ = false; }

  /// False: no frame is due.
  constexpr bool next(std::uint64_t now_us, NmtState state, Frame& frame) {
    if (state == NmtState::kInitialising) {
      booted_ = false;
      return false;
    }
    const std::uint64_t period_us = std::uint64_t{period_ms_} * 1000;
    if (!booted_) {
      booted_ = true;
      due_us_ = now_us + period_us;
      frame = heartbeat_frame(node_, NmtState::kInitialising);
      return true;
    }
    if (period_ms_ == 0 || now_us < due_us_) return false;
    due_us_ = due_us_ + period_us > now_us ? due_us_ + period_us : now_us + period_us;
    frame = heartbeat_frame(node_, state);
    return true;
  }

 private:
  std::uint8_t node_;
  bool booted_ = false;
  std::uint16_t period_ms_ = 0;
  std::uint64_t due_us_ = 0;
};

enum class Life : std::uint8_t {
  kUnused,
  kUnknown,  ///< no heartbeat since boot-up: not watched
  kAlive,
  kLost,
};
enum class LifeEvent : std::uint8_t {
  kNone,
  kBooted,  ///< started or restarted
  kAlive,   ///< first heartbeat, or after a loss
  kState,   ///< another NMT state
};

/// Object 1016h: watched nodes, and how long each may be silent.
template <std::size_t kNodes>
class HeartbeatConsumer {
 public:
  /// `subindex` (1 to kNodes): node id in bits 16 to 23, milliseconds below; 0 in either disables
  /// it. No node may be watched twice.
  constexpr Abort write(std::uint8_t subindex, std::uint32_t value) {
    if (subindex < 1 || subindex > kNodes) return Abort::kNoSubindex;
    const auto node = static_cast<std::uint8_t>(value >> 16);
    const auto time_ms = static_cast<std::uint16_t>(value);
    const bool used = is_node(node) && time_ms != 0;
    for (std::size_t i = 0; used && i < kNodes; ++i) {
      const bool other = i + 1 != subindex && entries_[i].life != Life::kUnused;
      if (other && entries_[i].node == node) return Abort::kIncompatibleParameter;
    }
    entries_[subindex - 1] = {value, node, used ? Life::kUnknown : Life::kUnused};
    return Abort::kNone;
  }
  /// As written.
  constexpr std::uint32_t value(std::uint8_t subindex) const {
    return entries_[subindex - 1].value;
  }
  constexpr Life life(std::uint8_t subindex) const { return entries_[subindex - 1].life; }
  constexpr NmtState state(std::uint8_t subindex) const { return entries_[subindex - 1].state; }

  /// `subindex`: the node's entry.
  constexpr LifeEvent receive(const Frame& frame, std::uint64_t now_us, std::uint8_t& subindex) {
    std::uint8_t node = 0;
    NmtState state = NmtState::kInitialising;
    if (!decode_heartbeat(frame, node, state)) return LifeEvent::kNone;
    for (std::size_t i = 0; i < kNodes; ++i) {
      Watched& each = entries_[i];
      if (each.life == Life::kUnused || each.node != node) continue;
      subindex = static_cast<std::uint8_t>(i + 1);
      return note(each, state, now_us);
    }
    return LifeEvent::kNone;
  }

  /// True while a watched node is lost.
  constexpr bool lost() const {
    for (const Watched& each : entries_) {
      if (each.life == Life::kLost) return true;
    }
    return false;
  }
  /// Reports each loss once. Call until false.
  constexpr bool next_lost(std::uint64_t now_us, std::uint8_t& subindex) {
    for (std::size_t i = 0; i < kNodes; ++i) {
      Watched& each = entries_[i];
      const std::uint64_t time_us = (each.value & 0xFFFF) * std::uint64_t{1000};
      if (each.life != Life::kAlive || now_us < each.heard_us + time_us) continue;
      each.life = Life::kLost;
      subindex = static_cast<std::uint8_t>(i + 1);
      return true;
    }
    return false;
  }

 private:
  struct Watched {
    std::uint32_t value = 0;
    std::uint8_t node = 0;
    Life life = Life::kUnused;
    NmtState state = NmtState::kInitialising;
    std::uint64_t heard_us = 0;
  };
  constexpr LifeEvent note(Watched& entry, NmtState state, std::uint64_t now_us) {
    const bool changed = entry.state != state;
    const bool began = entry.life != Life::kAlive;
    entry.state = state;
    if (state == NmtState::kInitialising) {
      entry.life = Life::kUnknown;
      return LifeEvent::kBooted;
    }
    entry.heard_us = now_us;
    entry.life = Life::kAlive;
    if (began) return LifeEvent::kAlive;
    return changed ? LifeEvent::kState : LifeEvent::kNone;
  }
  Watched entries_[kNodes];
};

}  // namespace verp::canopen
