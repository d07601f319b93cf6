#pragma once
#include <cstddef>

#include "tests/hil/modes.hpp"
#include "tests/hil/run_result.hpp"

namespace verp::test {

inline bool was(const RunResult& result, Mode mode) {
  return (result.seen >> mode & 1u) != 0;
}
inline std::size_t row(const RunResult& result) {
  return static_cast<std::size_t>(result.joint);
}

void keeps_walking(const RunResult& result);
void walks_again(const RunResult& result);
void gone_briefly(const RunResult& result);
void let_go(const RunResult& result);
void gone_for_good(const RunResult& result);
void repeats(const RunResult& result);
void late(const RunResult& result);
void cut(const RunResult& result);
void reset(const RunResult& result);
void hot(const RunResult& result);
void sags(const RunResult& result);
void flutters(const RunResult& result);
void joint_beyond(const RunResult& result);
void low_voltage(const RunResult& result);
void overheated(const RunResult& result);
void imu_gone(const RunResult& result);
void imu_repeats(const RunResult& result);

}  // namespace verp::test
