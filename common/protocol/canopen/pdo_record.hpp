#pragma once
#include <cstddef>
#include <cstdint>

#include "common/protocol/canopen/pdo.hpp"

/// A PDO's records (1400h, 1600h, 1800h, 1A00h and on), and when it is sent or takes effect (CiA
/// 301).
namespace verp::canopen {

enum class Direction : std::uint8_t { kReceive, kTransmit };

/// Transmission types. 1 to 240: with every n-th SYNC.
inline constexpr std::uint8_t kAcyclicSync = 0;  ///< with the next SYNC after a change
inline constexpr std::uint8_t kMaxCyclicSync = 240;
inline constexpr std::uint8_t kEventManufacturer = 254;
inline constexpr std::uint8_t kEventProfile = 255;
constexpr bool is_synchronous(std::uint8_t type) {
  return type <= kMaxCyclicSync;
}

inline constexpr std::uint32_t kPdoInvalid = 0x80000000;  ///< bit 31 of a COB-ID: PDO off
inline constexpr std::uint32_t kPdoNoRemote = 0x40000000;
inline constexpr std::uint32_t kPdoExtended = 0x20000000;

/// Mapping changes only in CiA 301's order: PDO off, subindex 0 to 0, entries, subindex 0 to their
/// number, PDO on. So no PDO uses a half-written mapping.
template <std::size_t kEntries = 8>
class PdoRecord {
 public:
  constexpr PdoRecord() = default;
  constexpr PdoRecord(Direction direction, std::uint32_t id, std::uint8_t type,
                      const PdoMapping<kEntries>& mapping)
      : direction_(direction), cob_id_(id | kPdoNoRemote), type_(type), mapping_(mapping) {}

  constexpr bool on() const { return (cob_id_ & kPdoInvalid) == 0; }
  /// Times switched on, modulo 256: each restarts the SYNC count.
  constexpr std::uint8_t times_on() const { return times_on_; }
  constexpr std::uint16_t id() const { return static_cast<std::uint16_t>(cob_id_ & 0x7FF); }
  constexpr std::uint8_t type() const { return type_; }
  constexpr std::uint8_t sync_start() const { return sync_start_; }
  constexpr std::uint16_t inhibit_100us() const { return inhibit_; }
  constexpr std::uint16_t event_timer_ms() const { return event_timer_; }
  constexpr const PdoMapping<kEntries>& mapping() const { return mapping_; }

  /// Subindex 0 is 5 (RPDO) or 6 (TPDO).
  constexpr Abort read_communication(std::uint8_t subindex, std::uint32_t& value) const {
    switch (subindex) {
      case 0:
        value = highest();
        return Abort::kNone;
      case 1:
        value = cob_id_;
        return Abort::kNone;
      case 2:
        value = type_;
        return Abort::kNone;
      case 3:
        value = inhibit_;
        return Abort::kNone;
      case 5:
        value = event_timer_;
        return Abort::kNone;
      case 6:
        if (direction_ == Direction::kReceive) return Abort::kNoSubindex;
        value = sync_start_;
        return Abort::kNone;
      default:
        return Abort::kNoSubindex;
    }
  }
  constexpr Abort write_communication(std::uint8_t subindex, std::uint32_t value) {
    switch (subindex) {
      case 0:
        return Abort::kReadOnly;
      case 1:
        return write_cob_id(value);
      case 2:
        if (!is_type(value)) return Abort::kValueRange;
        type_ = static_cast<std::uint8_t>(value);
        return Abort::kNone;
      case 3:
        if (on()) return Abort::kUnsupportedAccess;
        inhibit_ = static_cast<std::uint16_t>(value);
        return Abort::kNone;
      case 5:
        event_timer_ = static_cast<std::uint16_t>(value);
        return Abort::kNone;
      case 6:
        if (direction_ == Direction::kReceive) return Abort::kNoSubindex;
        if (on()) return Abort::kUnsupportedAccess;
        if (value > kMaxCyclicSync) return Abort::kValueRange;
        sync_start_ = static_cast<std::uint8_t>(value);
        return Abort::kNone;
      default:
        return Abort::kNoSubindex;
    }
  }

  constexpr Abort read_mapping(std::uint8_t subindex, std::uint32_t& value) const {
    if (subindex > kEntries) return Abort::kNoSubindex;
    value = subindex == 0 ? mapping_.count : mapping_.entries[subindex - 1].value();
    return Abort::kNone;
  }
  /// `mappable(at, bits)`: kNone, or the reason against it. Dummies are for RPDOs only.
  template <class Mappable>
  constexpr Abort write_mapping(std::uint8_t subindex, std::uint32_t value, Mappable&& mappable) {
    if (subindex > kEntries) return Abort::kNoSubindex;
    if (on()) return Abort::kUnsupportedAccess;
    if (subindex == 0) return write_count(value, mappable);
    if (mapping_.count != 0) return Abort::kUnsupportedAccess;
    const Mapped entry = Mapped::from(value);
    const Abort refused = value == 0 ? Abort::kNone : check(entry, mappable);
    if (refused == Abort::kNone) mapping_.entries[subindex - 1] = entry;
    return refused;
  }

 private:
  static constexpr unsigned kMaxBits = 8 * (kEntries > 8 ? kMaxCanFdData : kMaxCanData);

  constexpr std::uint8_t highest() const { return direction_ == Direction::kReceive ? 5 : 6; }
  static constexpr bool is_type(std::uint32_t type) {
    return type <= kMaxCyclicSync || type == kEventManufacturer || type == kEventProfile;
  }
  constexpr Abort write_cob_id(std::uint32_t value) {
    if ((value & kPdoExtended) != 0 || (value & 0x1FFFF800) != 0) return Abort::kValueRange;
    const bool turned_on = (value & kPdoInvalid) == 0;
    if (turned_on && is_restricted(value & 0x7FF)) return Abort::kValueRange;
    // The identifier changes only while off.
    if (turned_on && on() && (value & 0x7FF) != id()) return Abort::kValueRange;
    if (turned_on && !on()) times_on_ = static_cast<std::uint8_t>(times_on_ + 1);
    cob_id_ = value;
    return Abort::kNone;
  }
  template <class Mappable>
  constexpr Abort check(Mapped entry, Mappable& mappable) const {
    if (const std::uint8_t dummy = dummy_bits(entry.at); dummy != 0) {
      const bool good = direction_ == Direction::kReceive && entry.bits == dummy;
      return good ? Abort::kNone : Abort::kNotMappable;
    }
    if (entry.bits == 0 || entry.bits > 64) return Abort::kNotMappable;
    return mappable(entry.at, entry.bits);
  }
  template <class Mappable>
  constexpr Abort write_count(std::uint32_t value, Mappable& mappable) {
    if (value > kEntries) return Abort::kPdoLength;
    unsigned bits = 0;
    for (unsigned i = 0; i < value; ++i) {
      const Abort refused = check(mapping_.entries[i], mappable);
      if (refused != Abort::kNone) return refused;
      bits += mapping_.entries[i].bits;
    }
    if (bits > kMaxBits) return Abort::kPdoLength;
    mapping_.count = static_cast<std::uint8_t>(value);
    return Abort::kNone;
  }

  Direction direction_ = Direction::kReceive;
  std::uint32_t cob_id_ = kPdoInvalid;
  std::uint8_t type_ = kEventManufacturer;
  std::uint8_t sync_start_ = 0;
  std::uint8_t times_on_ = 0;
  std::uint16_t inhibit_ = 0;
  std::uint16_t event_timer_ = 0;
  PdoMapping<kEntries> mapping_;
};

/// With a start value, and a counter in the SYNC, a synchronous TPDO first answers that SYNC, then
/// every n-th: groups of drives share the SYNCs.
class SyncSchedule {
 public:
  /// Call when the node became operational or the record was written.
  constexpr void restart() {
    left_ = 0;
    started_ = false;
  }
  /// True: send after this SYNC. `counter` 0: a SYNC without one. `event`: new data of an acyclic
  /// TPDO.
  constexpr bool on_sync(std::uint8_t type, std::uint8_t start, std::uint8_t counter, bool event) {
    if (type == kAcyclicSync) return event;
    if (type > kMaxCyclicSync) return false;
    if (!started_) {
      if (start != 0 && counter != 0) {
        if (counter != start) return false;
        started_ = true;
        left_ = type;
        return true;
      }
      started_ = true;
      left_ = type;
    }
    if (--left_ != 0) return false;
    left_ = type;
    return true;
  }

 private:
  std::uint8_t left_ = 0;
  bool started_ = false;
};

/// A synchronous RPDO waits for the next SYNC, others take effect at once. A later frame replaces a
/// waiting one.
class RpdoLatch {
 public:
  constexpr bool receive(std::uint8_t type, const Frame& frame) {
    if (!is_synchronous(type)) return true;
    waiting_ = true;
    frame_ = frame;
    return false;
  }
  /// True if `frame` takes effect now.
  constexpr bool on_sync(Frame& frame) {
    if (!waiting_) return false;
    waiting_ = false;
    frame = frame_;
    return true;
  }
  constexpr void clear() { waiting_ = false; }

 private:
  bool waiting_ = false;
  Frame frame_;
};

}  // namespace verp::canopen
