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

/// Everything that a source said while a tick lasted, each value once, the last one first: which of
/// several the controller took cannot be heard.
template <class Value>
using Said = std::vector<Value>;

struct SlowTold {
  std::uint8_t joint = 0;
  std::uint8_t temperature_c = 0;
  std::uint8_t error = 0;
  std::uint16_t voltage_tenth_v = 0;
  bool operator==(const SlowTold&) const = default;
};

/// One tick as it was heard on a CAN bus.
struct HeardTick {
  std::uint16_t tick_low = 0;
  std::uint16_t flags = 0;  ///< of Inputs, and canopen::published's
  std::uint32_t fresh = 0;
  std::uint64_t digest = 0;
  std::vector<canopen::published::Part> parts;
  std::array<Said<std::int32_t>, kMaxJoints> position;
  Said<std::array<std::int16_t, 3>> gyro, accel;
  std::array<Said<std::array<std::uint16_t, kFootSensors>>, kFeet> foot;
  Said<SlowTold> slow;
};

/// Finds the ticks of a controller in the frames of its bus. It sends nothing.
class TickListener {
 public:
  explicit TickListener(const Params& params);

  void take(const CanFrame& frame);
  /// The next tick of which the controller has told all; false if there is none.
  bool next(HeardTick& tick);
  /// Ticks of which a digest or a record was missed, until now.
  std::uint64_t missed() const { return missed_; }
  /// The controller booted since this was asked last.
  bool take_boot();

 private:
  struct Round {
    HeardTick tick;
    bool has_digest = false;
    bool has_record = false;
    std::size_t parts_due = 0;
  };
  /// What a request for slow telemetry asked, and what has come of it.
  struct Asked {
    int joint = -1;
    std::uint16_t index = 0;
    SlowTold told;
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
  std::deque<Round>
      rounds_;  ///< of which the controller has not told all; the last one is under way
  std::deque<HeardTick> ticks_;
  HeardTick early_;   ///< said when the round before had been told, and the next had not begun
  bool told_ = true;  ///< of the newest round
  Asked asked_;
  Said<SlowTold> slow_;
  std::uint64_t missed_ = 0;
  bool booted_ = false;
};

/// All Inputs that the tick may have had after one with `before`, the likeliest first, at most
/// `most`. None if something was not heard that the controller had: then `lacking` says what.
std::vector<Inputs> readings(const HeardTick& tick, const Inputs& before, const Params& params,
                             std::size_t most, std::string& lacking);

}  // namespace verp::shadow
