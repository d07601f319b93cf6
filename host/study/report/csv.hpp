#pragma once
#include <string>
#include <vector>

#include "host/study/report/run_data.hpp"

namespace verp::report {

std::string samples_csv(const Run& run);
std::string asked_csv(const Run& run);
std::string bias_csv(const Run& run);
std::string torque_csv(const Run& run);
std::string sweep_csv(const Run& run);

/// A joint's mean and peak during the walk.
struct TorqueUse {
  double mean = 0, peak = 0;
};
std::vector<TorqueUse> torque_use(const Run& run);

/// Averaged over one cycle around each sample.
std::vector<double> speed_m_s(const Run& run);

/// Samples [first, last) of the last whole steady cycle; first == last: none.
struct Range {
  std::size_t first = 0, last = 0;
  bool empty() const { return first == last; }
};
Range last_steady_cycle(const Run& run);

}  // namespace verp::report
