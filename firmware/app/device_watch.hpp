#pragma once
#include <cstdint>

#include "common/control/state.hpp"
#include "common/io/io.hpp"
#include "common/math/convert.hpp"
#include "common/math/scalar.hpp"
#include "common/model/params.hpp"
#include "firmware/app/register_image.hpp"

namespace verp::app {

/// The register table's device arrays: state, rate, age and errors of each servo, sensor and bus,
/// by tick.
class DeviceWatch {
 public:
  DeviceWatch(const Params& params, RegisterImage& image);
  void heard() { ++packets_; }
  /// Error totals of the servo bus and of the operator's link.
  void bus_errors(std::uint32_t sum) { errors(table::kDeviceBus, sum); }
  void link_errors(std::uint32_t sum) { errors(table::kDeviceLink, sum); }

  void tick(const Inputs& inputs, const State& state, const Outputs& outputs);

 private:
  static constexpr std::uint16_t kOldest = 0xFFFF;
  struct Limits {
    std::int32_t stale, lost;
  };

  void name(int row, table::DeviceKind kind, std::uint8_t id);
  void errors(int row, std::uint32_t sum);
  Limits limits(float stale_s, float lost_s) const;

  /// For a device that should report in every tick.
  void sense(int row, bool fresh, bool faulty, const Limits& limits);

  /// True if a servo repeats one position although its goal has left it: an old value is repeated,
  /// or the joint is stuck.
  bool stands_still(int j, const Inputs& inputs, const Outputs& outputs);
  void mark_stale(int row);
  void watch(int row, std::uint16_t reports, bool faulty, const Limits& limits);
  void count_rates();

  struct Still {
    std::int32_t position_count = 0;
    std::int32_t goal_count = 0;
    std::uint8_t ticks = 0;  ///< ticks with the goal away, up to kPatience
  };

  const Params& params_;
  RegisterImage& image_;
  Still still_[kMaxJoints];
  std::uint16_t reports_[table::kDevices] = {};  ///< in the window
  std::uint32_t window_us_ = 0;
  std::uint32_t tick_ = 0;
  std::uint16_t elapsed_ = 1;
  std::uint16_t packets_ = 0;
  bool ticking_ = false;
};

}  // namespace verp::app
