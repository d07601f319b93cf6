#pragma once
#include <cstdint>
#include <deque>
#include <random>

#include "common/model/params.hpp"
#include "host/twin/can/node.hpp"

namespace verp::test {

class Intruder final : public can::Node {
 public:
  enum class Kind : std::uint8_t {
    kSilent,
    kUrgent,   ///< a third of the bus, at top priority
    kCrowd,    ///< nearly all of the bus, at top priority
    kFlood,    ///< more than the bus can carry
    kForeign,  ///< the robot's identifiers, foreign content
    kTwin,     ///< acts as a drive
    kSdo,      ///< unrequested responses
    kSync,
  };
  static constexpr std::uint8_t kId = 126;

  Intruder(const Params& params, std::uint32_t seed) : params_(params), random_(seed) {}

  Kind kind = Kind::kSilent;
  int joint = 0;
  std::uint32_t frames() const { return frames_; }

  std::uint8_t id() const override { return kId; }
  void hear(const CanFrame& frame, std::uint64_t now_us) override;
  void work(std::uint64_t now_us) override;
  bool say(CanFrame& frame, std::uint64_t now_us) override;
  void power_on() override {}
  void power_off() override {}

 private:
  std::uint32_t random(std::uint32_t most) { return static_cast<std::uint32_t>(random_() % most); }
  std::uint8_t random_node();
  void add(std::uint32_t id, std::uint8_t size);
  void babble(int frames);
  void pretend();
  void respond();

  const Params& params_;
  std::minstd_rand random_;
  std::deque<CanFrame> out_;
  std::uint8_t asked_ = 0;
  std::uint32_t frames_ = 0;
};

}  // namespace verp::test
