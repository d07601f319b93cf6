#pragma once
#include <cstdint>
#include <string>

#include "common/model/params.hpp"
#include "host/twin/sim/robot.hpp"

/// What supply and motors bore, for the words of a run that they ended.
namespace verp::session {

class Strain {
 public:
  /// Once a tick, with the controller's faults.
  void see(const sim::TwinRobot& robot, std::uint32_t faults);

  /// One of these faults is supply, heat or a servo's own error, and came before the robot fell.
  bool came_before_fall(std::uint32_t faults) const;
  /// Numbers behind these faults, e.g. "lowest 9.2 V, cut-out 9.6 V"; empty: they have none.
  std::string text(const Params& params, std::uint32_t faults) const;

 private:
  double lowest_v_ = 1e9, highest_v_ = 0, most_v_ = 0;
  double hottest_c_ = 0;
  std::size_t hottest_ = 0;  ///< joint
  bool before_fall_ = false;
};

}  // namespace verp::session
