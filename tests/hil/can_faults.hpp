#pragma once
#include <cstdint>
#include <deque>
#include <map>
#include <random>

#include "host/can/virtual_can.hpp"

namespace verp::test {

/// What a bad CAN bus does, in shares of frames.
struct CanFaults {
  double lost = 0;         ///< nobody hears it
  double missed = 0;       ///< likewise, but each of those who hear by itself
  double doubled = 0;      ///< everybody hears it twice, as after an error in its last but one bit
  double heard_twice = 0;  ///< likewise, each by itself
  double overtaken = 0;    ///< comes behind the frame after it, or the one after that
  double late = 0;         ///< comes to the controller later,
  std::uint32_t late_us = 0;  ///< by up to so much
  std::uint32_t held_us = 0;  ///< all come to the controller so much later, as from a slow gateway
  double broken = 0;          ///< an error frame ends it, and it is sent again: a chip's wire only
  bool down = false;          ///< the controller's interface: it neither sends nor hears
};

/// What was done so far, and to what.
struct CanDamage {
  std::uint32_t lost = 0, missed = 0, doubled = 0, overtaken = 0, late = 0, down = 0, broken = 0;
  std::uint32_t lost_answers = 0;  ///< PDOs of the nodes that the controller does not hear
  std::uint32_t faults() const {
    return lost + missed + doubled + overtaken + late + down + broken;
  }
};

/// Does it to a VirtualCan. All chance comes from one seed.
class CanTrouble final : public can::Interference {
 public:
  CanTrouble(can::VirtualCan& bus, std::uint32_t seed) : bus_(bus), random_(seed) {
    bus.set_interference(this);
  }
  ~CanTrouble() override { bus_.set_interference(nullptr); }

  CanFaults faults;
  const CanDamage& damage() const { return damage_; }
  CanDamage& damage() { return damage_; }
  bool chance(double share) {
    return share > 0 && std::uniform_real_distribution<double>(0, 1)(random_) < share;
  }
  /// When a node heard an order or the heartbeat of the controller last; 0: never.
  std::uint64_t ordered_us(std::uint8_t node) const {
    const auto found = ordered_us_.find(node);
    return found == ordered_us_.end() ? 0 : found->second;
  }

  bool passes(const CanFrame& frame, std::uint8_t receiver) override;
  void passed(std::uint64_t now_us) override;

 private:
  /// What becomes of one frame for all who hear it.
  enum class Fate : std::uint8_t { kFine, kLost, kDoubled, kOvertaken };
  struct Held {
    CanFrame frame;
    std::uint8_t receiver;
    std::uint64_t due_us;
    std::uint32_t behind;  ///< it comes earlier when so many frames have overtaken it; 0: not
  };
  void decide();
  bool inbound(const CanFrame& frame);
  void hold(const CanFrame& frame, std::uint8_t receiver, std::uint64_t later_us,
            std::uint32_t behind = 0) {
    held_.push_back({frame, receiver, now_us_ + later_us, behind});
  }
  void note_heard(const CanFrame& frame, std::uint8_t receiver);

  can::VirtualCan& bus_;
  std::minstd_rand random_;
  CanDamage damage_;
  std::map<std::uint8_t, std::uint64_t> ordered_us_;
  std::deque<Held> held_;
  std::uint64_t now_us_ = 0;
  std::uint32_t behind_ = 0;
  Fate fate_ = Fate::kFine;
  bool decided_ = false;
};

/// The controller's end: a CanBus in bus time on a VirtualCan, which runs by a timer's clock here.
class CanLine {
 public:
  CanLine(can::VirtualCan& bus, std::uint32_t seed) : trouble(bus, seed), bus_(bus) {
    bus.set_real_time(true);
  }

  // CanBus
  bool send(const CanFrame& frame);
  bool poll(CanFrame& frame, std::uint32_t timeout_us);
  std::uint64_t now_us() const { return bus_.now_us(); }
  hal::CanErrors errors() const { return bus_.errors(); }

  std::uint64_t time_us() const { return now_us(); }
  /// Lets bus time go on while the controller does something else.
  void wait_until(std::uint64_t time_us) { bus_.go_on_until(time_us); }

  CanTrouble trouble;

 private:
  can::VirtualCan& bus_;
};
static_assert(hal::CanBus<CanLine>);

}  // namespace verp::test
