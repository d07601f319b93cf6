#pragma once
#include <cstdint>
#include <deque>
#include <map>
#include <random>

#include "host/twin/can/virtual_can.hpp"

namespace verp::test {

/// Shares of frames.
struct CanFaults {
  double lost = 0;            ///< to all nodes
  double missed = 0;          ///< by each receiver independently
  double doubled = 0;         ///< for all, as after an error in the last bit but one
  double heard_twice = 0;     ///< at each receiver independently
  double overtaken = 0;       ///< by one or two frames
  double late = 0;            ///< to the controller,
  std::uint32_t late_us = 0;  ///< by up to this
  std::uint32_t held_us = 0;  ///< all frames to the controller, as by a slow gateway
  double broken = 0;          ///< ended by an error frame and sent again; chip's wire only
  bool down = false;          ///< the controller's interface neither sends nor receives
};

struct CanDamage {
  std::uint32_t lost = 0, missed = 0, doubled = 0, overtaken = 0, late = 0, down = 0, broken = 0;
  std::uint32_t lost_answers = 0;
  std::uint32_t faults() const {
    return lost + missed + doubled + overtaken + late + down + broken;
  }
};

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
  /// When the node last received an order or heartbeat from the controller; 0: never.
  std::uint64_t ordered_us(std::uint8_t node) const {
    const auto found = ordered_us_.find(node);
    return found == ordered_us_.end() ? 0 : found->second;
  }

  bool passes(const CanFrame& frame, std::uint8_t receiver) override;
  void passed(std::uint64_t now_us) override;

 private:
  enum class Fate : std::uint8_t { kFine, kLost, kDoubled, kOvertaken };
  struct Held {
    CanFrame frame;
    std::uint8_t receiver;
    std::uint64_t due_us;
    std::uint32_t behind;  ///< delivered once so many frames have overtaken it; 0: no
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

class CanLine final : public hal::CanBus {
 public:
  CanLine(can::VirtualCan& bus, std::uint32_t seed) : trouble(bus, seed), bus_(bus) {
    bus.set_real_time(true);
  }

  bool send(const CanFrame& frame) override;
  bool poll(CanFrame& frame, std::uint32_t timeout_us) override;
  std::uint64_t now_us() override { return bus_.now_us(); }
  hal::CanErrors errors() const override { return bus_.errors(); }

  std::uint64_t time_us() const { return bus_.now_us(); }
  void wait_until(std::uint64_t time_us) { bus_.go_on_until(time_us); }

  CanTrouble trouble;

 private:
  can::VirtualCan& bus_;
};

}  // namespace verp::test
