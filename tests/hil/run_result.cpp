#include "tests/hil/run_result.hpp"

#include <numeric>

namespace verp::test {

using app::reg;

std::uint32_t Registers::missed_reports() const {
  return std::accumulate(errors.begin(), errors.begin() + dxl::controller::kDeviceBus, 0u);
}

Registers read_registers(OperatorDesk& desk) {
  Registers all;
  all.mode = desk.read<std::uint8_t>(reg("mode"));
  all.reset_cause = desk.read<std::uint8_t>(reg("reset_cause"));
  all.refused_joint = desk.read<std::uint8_t>(reg("joint_beyond"));
  all.tick = desk.counter("tick");
  all.faults = desk.counter("faults");
  all.fresh = desk.counter("joints_fresh");
  all.crc_errors = desk.counter("bus_crc_errors");
  all.timeouts = desk.counter("bus_timeouts");
  all.strays = desk.counter("bus_strays");
  all.noise = desk.counter("bus_noise");
  all.refused = desk.counter("bus_refused");
  all.bus_errors = desk.counter("bus_errors");
  all.overruns = desk.counter("overruns");
  all.misses = desk.counter("skipped_periods");
  all.state = desk.read<decltype(all.state)>(reg("device_state"));
  all.age = desk.read<decltype(all.age)>(reg("device_age"));
  all.errors = desk.read<decltype(all.errors)>(reg("device_errors"));
  return all;
}

}  // namespace verp::test
