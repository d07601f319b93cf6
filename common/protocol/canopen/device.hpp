#pragma once
#include <cstddef>
#include <cstdint>

#include "common/protocol/canopen/communication.hpp"
#include "common/protocol/canopen/sdo_servers.hpp"

/// A CANopen device: CiA 301's services around an application's objects.
///
///  - receive() takes each frame of the bus, next() returns frames to send until there are none;
///    neither waits. Call next() after each receive() and regularly: heartbeats are due by time.
///  - PDOs pass only in NMT state operational; SDO, SYNC and EMCY also in pre-operational.
namespace verp::canopen {

struct DeviceEvents {
  NmtEvent nmt = NmtEvent::kNone;
  bool sync = false;         ///< RPDOs took effect, TPDOs are made
  std::uint8_t counter = 0;  ///< that SYNC's
  bool put = false;          ///< an RPDO wrote objects
};

template <Application A, DeviceSize kSize = DeviceSize{}>
class Device {
 public:
  using Objects = CommunicationObjects<A, kSize>;

  Device(A& application, const Identity& identity, std::uint8_t node)
      : objects_(application, identity, node),
        application_(application),
        node_(node),
        nmt_(node),
        servers_(objects_, node) {}

  Objects& objects() { return objects_; }
  NmtState state() const { return nmt_.state(); }

  /// Also after a reset: boot-up message, then pre-operational. The caller sets defaults before a
  /// restart.
  void start() {
    servers_.reset();
    leave_operational();
    emergencies_ = 0;
    standing_ = 0;
    application_errors_ = 0;
    application_code_ = ErrorCode::kNoError;
    show_errors();
    objects_.producer.restart();
    nmt_.initialised();
  }

  DeviceEvents receive(const Frame& frame, std::uint64_t now_us) {
    DeviceEvents events;
    if (!is_canopen(frame) || nmt_.state() == NmtState::kInitialising) return events;
    events.nmt = nmt_.receive(frame);
    if (events.nmt != NmtEvent::kNone) {
      if (!may_pdo(nmt_.state())) leave_operational();
      if (!may_sdo(nmt_.state())) servers_.reset();
      return events;
    }
    std::uint8_t subindex = 0;
    if (objects_.consumer.receive(frame, now_us, subindex) == LifeEvent::kAlive) {
      settle(kMasterSilent);
    }
    if (!may_sdo(nmt_.state())) return events;
    take_sync(frame, events);
    take_rpdo(frame, events);
    servers_.receive(frame, now_us);
    if (!objects_.consumer.lost()) settle(kMasterSilent);  // 1016h was written anew
    return events;
  }

  /// False: there is no frame to send.
  bool next(Frame& frame, std::uint64_t now_us) {
    if (kSize.beats && objects_.producer.next(now_us, nmt_.state(), frame)) return true;
    if (!may_sdo(nmt_.state())) return false;
    if (emergencies_ > 0) {
      frame = encode_emcy(queue_[0]);
      --emergencies_;
      for (std::size_t i = 0; i < emergencies_; ++i) queue_[i] = queue_[i + 1];
      return true;
    }
    return next_tpdo(frame, now_us) || servers_.next(frame, now_us);
  }

  /// New data for TPDO `which` (from 0): an event-driven one goes out after its inhibit time, an
  /// acyclic one with the next SYNC.
  void trigger(std::size_t which) {
    if (which < kSize.tpdos) sending_[which].event = true;
  }
  /// TPDO `which` (from 0) if due, for objects that may change before next() reaches it.
  bool next_pdo(std::size_t which, Frame& frame, std::uint64_t now_us) {
    if (which >= kSize.tpdos || !may_pdo(nmt_.state()) || !objects_.tpdos[which].on()) return false;
    const auto& record = objects_.tpdos[which];
    Sending& each = sending_[which];
    if (each.due) {
      each.due = false;
      frame = each.frame;
      return true;
    }
    if (is_synchronous(record.type()) || !event_due(record, each, now_us)) return false;
    each.event = false;
    each.sent = true;
    each.sent_us = now_us;
    make(which, frame);
    return true;
  }
  /// Reports an error by EMCY, 1001h and 1003h; with over kErrorHistory waiting, by 1003h only.
  /// Code 0 (no error) leaves no entry there. `error_register`: the application's part of 1001h.
  void report(ErrorCode code, std::uint8_t error_register) {
    hold_error(code, error_register);
    tell(code);
  }
  /// Sets an error without an EMCY: one was sent already.
  void hold_error(ErrorCode code, std::uint8_t error_register) {
    application_code_ = code;
    application_errors_ =
        code == ErrorCode::kNoError ? error_register : error_register | kErrorGeneric;
    show_errors();
  }
  /// The error while 1001h is set: the application's before the communication's.
  ErrorCode standing_error() const {
    if (application_errors_ != 0) return application_code_;
    if ((standing_ & kMasterSilent) != 0) return ErrorCode::kHeartbeatLost;
    if ((standing_ & kSyncOdd) != 0) return ErrorCode::kSyncLength;
    return (standing_ & kPdoOdd) != 0 ? pdo_code_ : ErrorCode::kNoError;
  }
  /// True if a watched node (1016h) fell silent; acts by 1029h.
  bool heartbeat_lost(std::uint64_t now_us) {
    std::uint8_t subindex = 0;
    if (!objects_.consumer.next_lost(now_us, subindex)) return false;
    complain(kMasterSilent, ErrorCode::kHeartbeatLost);
    if (kSize.falls_back && nmt_.fall_back(objects_.error_behaviour) != NmtEvent::kNone) {
      leave_operational();
      if (!may_sdo(nmt_.state())) servers_.reset();
    }
    return true;
  }

 private:
  struct Sending {
    SyncSchedule schedule;
    std::uint8_t times_on = 0;  ///< PdoRecord's, when the schedule began
    bool event = false;
    bool due = false;  ///< a SYNC made `frame`
    Frame frame;
    std::uint64_t sent_us = 0;
    bool sent = false;
  };

  enum Cause : std::uint8_t { kSyncOdd = 1, kPdoOdd = 2, kMasterSilent = 4 };
  void show_errors() {
    std::uint8_t all = application_errors_;
    if (standing_ != 0) all |= kErrorCommunication;
    objects_.error_register = all == 0 ? all : static_cast<std::uint8_t>(all | kErrorGeneric);
  }
  void tell(ErrorCode code) {
    const auto number = static_cast<std::uint16_t>(code);
    show_errors();
    if (number != 0) objects_.history.push(number);
    if (emergencies_ < kErrorHistory) {
      queue_[emergencies_++] = {node_, number, objects_.error_register, {}};
    }
  }
  // One EMCY at an error's start and one at its end (CiA 301): a wrong SYNC comes a hundred times a
  // second.
  void complain(Cause cause, ErrorCode code) {
    if ((standing_ & cause) != 0) return;
    standing_ |= cause;
    tell(code);
  }
  void settle(Cause cause) {
    if ((standing_ & cause) == 0) return;
    standing_ &= static_cast<std::uint8_t>(~cause);
    tell(ErrorCode::kNoError);
  }
  void leave_operational() {
    for (Sending& each : sending_) each = Sending();
    for (RpdoLatch& each : latches_) each.clear();
  }

  void take_sync(const Frame& frame, DeviceEvents& events) {
    const SyncSeen seen = read_sync(frame, objects_.sync_overflow, events.counter);
    if (seen == SyncSeen::kNo) return;
    events.sync = true;
    seen == SyncSeen::kWrongLength ? complain(kSyncOdd, ErrorCode::kSyncLength) : settle(kSyncOdd);
    if (!may_pdo(nmt_.state())) return;
    for (std::size_t i = 0; i < kSize.tpdos; ++i) {
      const auto& record = objects_.tpdos[i];
      Sending& each = sending_[i];
      if (!record.on() || !is_synchronous(record.type())) continue;
      if (each.times_on != record.times_on()) each.schedule.restart();
      each.times_on = record.times_on();
      if (!each.schedule.on_sync(record.type(), record.sync_start(), events.counter, each.event)) {
        continue;
      }
      each.event = false;
      each.due = true;
      make(i, each.frame);  // values as at the SYNC
    }
    Frame applied;
    for (std::size_t i = 0; i < kSize.rpdos; ++i) {
      if (latches_[i].on_sync(applied)) put(i, applied, events);
    }
  }
  void take_rpdo(const Frame& frame, DeviceEvents& events) {
    if (!may_pdo(nmt_.state())) return;
    for (std::size_t i = 0; i < kSize.rpdos; ++i) {
      const auto& record = objects_.rpdos[i];
      if (!record.on() || record.id() != frame.id) continue;
      if (latches_[i].receive(record.type(), frame)) put(i, frame, events);
    }
  }
  void put(std::size_t which, const Frame& frame, DeviceEvents& events) {
    const PdoLength length =
        unpack_pdo(objects_.rpdos[which].mapping(), frame,
                   [&](Address at, unsigned bits, std::uint64_t value) {
                     events.put = true;
                     application_.put(at, static_cast<std::uint8_t>(bits), value);
                   });
    if (length == PdoLength::kRight) return settle(kPdoOdd);
    pdo_code_ = length == PdoLength::kTooShort ? ErrorCode::kPdoTooShort : ErrorCode::kPdoTooLong;
    complain(kPdoOdd, pdo_code_);
  }
  void make(std::size_t which, Frame& frame) {
    frame = Frame();
    frame.id = objects_.tpdos[which].id();
    frame.fd = kSize.entries > kMaxCanData;
    pack_pdo(objects_.tpdos[which].mapping(), frame, [this](Address at, unsigned bits) {
      return application_.get(at, static_cast<std::uint8_t>(bits));
    });
  }

  bool next_tpdo(Frame& frame, std::uint64_t now_us) {
    for (std::size_t i = 0; i < kSize.tpdos; ++i) {
      if (next_pdo(i, frame, now_us)) return true;
    }
    return false;
  }
  /// An event or the event timer, but never within the inhibit time.
  static bool event_due(const PdoRecord<kSize.entries>& record, const Sending& each,
                        std::uint64_t now_us) {
    const std::uint64_t timer_us = std::uint64_t{record.event_timer_ms()} * 1000;
    const std::uint64_t inhibit_us = std::uint64_t{record.inhibit_100us()} * 100;
    if (!each.sent) return each.event || timer_us != 0;
    if (now_us < each.sent_us + inhibit_us) return false;
    return each.event || (timer_us != 0 && now_us >= each.sent_us + timer_us);
  }

  Objects objects_;
  A& application_;
  std::uint8_t node_;
  NmtSlave nmt_;
  SdoServers<Objects, kSize.further_sdos> servers_;
  Sending sending_[kSize.tpdos];
  RpdoLatch latches_[kSize.rpdos];
  Emergency queue_[kErrorHistory + 1];
  std::size_t emergencies_ = 0;
  std::uint8_t standing_ = 0;            ///< Cause bits
  std::uint8_t application_errors_ = 0;  ///< the application's part of 1001h
  ErrorCode application_code_ = ErrorCode::kNoError;
  ErrorCode pdo_code_ = ErrorCode::kNoError;  ///< last PDO of a wrong length
};

}  // namespace verp::canopen
