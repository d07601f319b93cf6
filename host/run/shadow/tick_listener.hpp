#pragma once
#include <array>
#include <cstdint>
#include <deque>
#include <string>
#include <vector>

#include "common/base/can_frame.hpp"
#include "common/io/io.hpp"
#include "common/model/params.hpp"
#include "common/protocol/canopen/published_tick.hpp"
#include "firmware/app/can_nodes.hpp"

namespace verp::shadow {

/// A source's distinct values in one tick, latest first. The used one is unknown.
template <class Value>
using Said = std::vector<Value>;

struct SlowReport {
  std::uint8_t joint = 0;
  std::uint8_t temperature_c = 0;
  std::uint8_t error = 0;
  std::uint16_t voltage_tenth_v = 0;
  bool operator==(const SlowReport&) const = default;
};

struct HeardTick {
  std::uint16_t tick_low = 0;
  std::uint16_t flags = 0;  ///< Inputs' and canopen::published's
  std::uint32_t fresh = 0;
  std::uint64_t digest = 0;
  std::vector<canopen::published::Part> parts;
  std::array<Said<std::int32_t>, kMaxJoints> position;
  Said<std::array<std::int16_t, 3>> gyro, accel;
  std::array<Said<std::array<std::uint16_t, kFootSensors>>, kFeet> foot;
  Said<SlowReport> slow;
};

/// Reassembles a controller's ticks from its bus. It sends nothing.
class TickListener {
 public:
  explicit TickListener(const Params& params);

  void take(const CanFrame& frame);
  bool next(HeardTick& tick);
  std::uint64_t missed() const { return missed_; }
  /// True if the controller booted since the last call.
  bool take_boot();

 private:
  struct Round {
    HeardTick tick;
    bool has_digest = false;
    bool has_record = false;
    std::size_t parts_due = 0;
  };
  /// The pending request for slow telemetry.
  struct Asked {
    int joint = -1;
    std::uint16_t index = 0;
    SlowReport told;
  };

  void begin_round();
  void drop_oldest();
  void take_drive(int slot, unsigned number, const CanFrame& frame);
  void take_request(int joint, const CanFrame& frame);
  void take_response(int joint, const CanFrame& frame);
  void take_published(unsigned number, const CanFrame& frame);
  void close_if_whole();

  const Params& params_;
  app::CanNodes nodes_;
  std::deque<Round> rounds_;  ///< the last one is under way
  std::deque<HeardTick> ticks_;
  HeardTick early_;   ///< heard between two rounds
  bool told_ = true;  ///< of the newest round
  Asked asked_;
  Said<SlowReport> slow_;
  std::uint64_t missed_ = 0;
  bool booted_ = false;
};

/// Possible Inputs after `before`, likeliest first, at most `most`. Empty: a used value was not
/// heard; `lacking` names it.
std::vector<Inputs> readings(const HeardTick& tick, const Inputs& before, const Params& params,
                             std::size_t most, std::string& lacking);

}  // namespace verp::shadow
