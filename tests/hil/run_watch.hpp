#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <utility>

#include "common/io/io.hpp"
#include "common/model/params.hpp"
#include "host/sim/plant.hpp"

namespace verp::test {

/// What no run may show, whatever its bus and its fault: seen at the plant and in the controller's
/// ticks, beside the safe table.
class RunWatch {
 public:
  static constexpr int kNobody = -1;

  RunWatch(const Params& params, sim::Plant& plant) : params_(params), plant_(plant) {}

  /// The first thing that was against a promise; empty: nothing was.
  const std::string& violation() const { return violation_; }
  void fault(const std::string& what) {
    if (violation_.empty()) violation_ = what;
  }

  /// Where each servo stands when a tick is due, and where it is bound for: what it tells next lies
  /// between. A goal that was held up may reach it only with the next request.
  void note_positions(const Outputs& last);
  /// No position passes for fresh that is older than that, but of the joint that `repeats`.
  void watch_positions(const Inputs& inputs, int repeats);

  /// Whether a servo or the IMU was silent for stale_hold_s, ever.
  void watch_silence(const Inputs& inputs);
  bool stale() const { return stale_; }

  /// A limp robot's servos are limp, even those whose frames were lost. `cut`: nobody can reach
  /// them; `gone`: nor that one.
  void watch_torque(const Outputs& outputs, std::uint64_t now_us, bool cut, int gone);
  /// A robot that lies on the floor is limp soon, whatever its controller knows.
  void watch_fall(const Outputs& outputs, std::uint64_t now_us, bool lies);

 private:
  double seconds(std::uint64_t ticks) const {
    return 1e-6 * static_cast<double>(ticks * params_.period_us);
  }

  const Params& params_;
  sim::Plant& plant_;
  std::string violation_;
  std::array<std::pair<std::int32_t, std::int32_t>, kMaxJoints> tells_{};
  std::array<std::uint64_t, kMaxJoints + 1> silent_{};  ///< ticks; the last is the IMU's
  std::uint64_t limp_since_us_ = 0;
  std::uint64_t fallen_us_ = 0;  ///< when it was last seen upright
  bool stale_ = false;
};

}  // namespace verp::test
