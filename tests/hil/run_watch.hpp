#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <utility>

#include "common/io/io.hpp"
#include "common/model/params.hpp"
#include "host/twin/sim/plant.hpp"

namespace verp::test {

class RunWatch {
 public:
  static constexpr int kNobody = -1;

  RunWatch(const Params& params, sim::Plant& plant) : params_(params), plant_(plant) {}

  const std::string& violation() const { return violation_; }
  void fault(const std::string& what) {
    if (violation_.empty()) violation_ = what;
  }

  /// Each servo's next report lies between its position and its goal when a tick is due. A delayed
  /// goal may come with the next request.
  void note_positions(const Outputs& last);
  /// Only the joint `repeats` may count as fresh with an older position.
  void watch_positions(const Inputs& inputs, int repeats);

  void watch_silence(const Inputs& inputs);
  bool stale() const { return stale_; }

  /// A limp robot's servos are limp. Exceptions: all if `cut`, and servo `gone`.
  void watch_torque(const Outputs& outputs, std::uint64_t now_us, bool cut, int gone);
  void watch_fall(const Outputs& outputs, std::uint64_t now_us, bool lies);

 private:
  double seconds(std::uint64_t ticks) const {
    return 1e-6 * static_cast<double>(ticks * params_.period_us);
  }

  const Params& params_;
  sim::Plant& plant_;
  std::string violation_;
  std::array<std::pair<std::int32_t, std::int32_t>, kMaxJoints> tells_{};
  std::array<std::uint64_t, kMaxJoints + 1> silent_{};  ///< ticks; the IMU's is last
  std::uint64_t limp_since_us_ = 0;
  std::uint64_t fallen_us_ = 0;
  bool stale_ = false;
};

}  // namespace verp::test
